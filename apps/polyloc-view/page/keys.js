// The keyboard: everything that the mouse can do.

import { layers } from './state.js';

const other = [
  ['← → ↑ ↓', 'move the robot by 0.1 m (Shift: 1 m, Alt: 1 cm)'],
  ['q e', 'turn it by 5° (Shift: 1°)'],
  ['w a s d with Ctrl', 'pan'],
  ['+ −', 'zoom'],
  ['0', 'whole map'],
  ['1 … 9', 'choose a hypothesis'],
  ['Enter', 'put the robot where the chosen hypothesis is'],
  ['d', 'plan where to drive so that wrong hypotheses fall; then drive, a step at a time (Shift: to the end)'],
  ['a', 'a step of the drive back'],
  ['i', 'drop an object before the robot'],
  ['w', 'push the wall before the robot 0.2 m away (Shift: nearer)'],
  ['u', 'tidy up: no objects, no moved walls'],
  ['y', 'next method'],
  ['m', 'controls'],
  ['t', 'light or dark'],
  ['j', 'save what is seen as SVG (Shift: PNG)'],
  ['space', 'play and stop the log'],
  [', .', 'scan before, next scan of the log'],
  ['n', 'next miss'],
  ['Esc', 'leave the log; end the drive; close'],
  ['?', 'these keys'],
];

export function fillHelp(dialog) {
  const title = document.createElement('h2');
  title.textContent = 'Keys';
  const list = document.createElement('dl');
  for (const [keys, words] of [...layers.map(([, name, key]) => [key, `show: ${name}`]), ...other]) {
    const term = document.createElement('dt'), meaning = document.createElement('dd');
    for (const key of keys.split(' ')) {
      const kbd = document.createElement('kbd');
      kbd.textContent = key;
      term.append(kbd, ' ');
    }
    meaning.textContent = words;
    list.append(term, meaning);
  }
  const close = document.createElement('button');
  close.textContent = 'close';
  close.addEventListener('click', () => dialog.close());
  dialog.append(title, list, close);
}

// act: what keys do, by name.
export function bindKeys(act) {
  addEventListener('keydown', (event) => {
    const target = event.target;
    const types = target.matches('input[type=number]') || target.matches('input[type=text]');
    const slides = target.matches('input[type=range], input[type=radio]') && event.key.startsWith('Arrow');
    if (types || slides || event.metaKey || document.querySelector('dialog[open]')) return;
    if (target.matches('button, input[type=checkbox]') && (event.key === ' ' || event.key === 'Enter')) return;
    const done = event.ctrlKey ? panned(event, act) : pressed(event, act);
    if (done) event.preventDefault();
  });
}

function panned(event, act) {
  const step = { w: [0, 60], a: [60, 0], s: [0, -60], d: [-60, 0] }[event.key.toLowerCase()];
  if (step) act.pan(...step);
  return Boolean(step);
}

function pressed(event, act) {
  const step = event.shiftKey ? 1 : event.altKey ? 0.01 : 0.1;
  const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
  if (arrow) return act.step(arrow[0] * step, arrow[1] * step), true;
  if (event.altKey) return false;
  if (/^[1-9]$/.test(event.key)) return act.choose(Number(event.key) - 1), true;
  const key = event.key.toLowerCase();
  const layer = layers.find((l) => l[2] === key);
  if (layer) return act.toggle(layer[0]), true;
  const turn = { q: 1, e: -1 }[key];
  if (turn) return act.turn(turn * (event.shiftKey ? 1 : 5)), true;
  const name = {
    '+': 'zoomIn', '=': 'zoomIn', '-': 'zoomOut', 0: 'fit', enter: 'adopt', i: 'drop', u: 'tidy', y: 'nextMethod',
    m: 'panel', t: 'theme', ' ': 'play', ',': 'before', '.': 'next', n: 'nextMiss', escape: 'leave', '?': 'help',
    j: event.shiftKey ? 'savePng' : 'saveSvg', d: event.shiftKey ? 'driveToTheEnd' : 'drive', a: 'driveBack',
    w: event.shiftKey ? 'pullWall' : 'pushWall',
  }[key];
  if (!name) return false;
  act[name]();
  return true;
}
