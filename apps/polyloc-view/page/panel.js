// The controls beside the map: each is bound to a part of the state by its data-key.

import { change, layers, onChange, shows, state, toggle } from './state.js';

const $ = (id) => document.getElementById(id);

export function bindPanel() {
  for (const input of document.querySelectorAll('[data-key]')) {
    const key = input.dataset.key;
    const output = input.parentElement.querySelector('output');
    const unit = output?.textContent ?? '';
    const show = () => {
      if (input.type === 'checkbox') input.checked = state[key];
      else if (document.activeElement !== input || input.type === 'range') input.value = +state[key].toFixed(3);
      if (output) output.textContent = `${+state[key].toFixed(2)}${unit}`;
    };
    input.addEventListener('input', () => {
      if (input.type === 'checkbox') change({ [key]: input.checked });
      else if (input.value !== '' && Number.isFinite(input.valueAsNumber)) change({ [key]: input.valueAsNumber });
    });
    onChange((keys) => keys.includes(key) && show());
    show();
  }
  bindRadio('method', () => state.method, (method) => change({ method }));
  bindRadio('strategy', () => state.strategy, (strategy) => change({ strategy }));
  for (const name of ['method', 'strategy']) onChange((keys) => keys.includes(name) && tick(name, state[name]));
  addLayers();
}

function tick(name, value) {
  for (const radio of document.getElementsByName(name)) radio.checked = radio.value === value;
}

export function bindRadio(name, value, take) {
  tick(name, value());
  for (const radio of document.getElementsByName(name)) {
    radio.addEventListener('change', () => radio.checked && take(radio.value));
  }
}

export const chosenTool = () => document.querySelector('[name=tool]:checked').value;
export const chooseTool = (tool) => tick('tool', tool);

function addLayers() {
  const box = $('layers');
  for (const [layer, words, key, colour] of layers) {
    const label = document.createElement('label');
    const input = document.createElement('input');
    input.type = 'checkbox';
    input.dataset.layer = layer;
    input.checked = shows(layer);
    input.addEventListener('change', () => toggle(layer));
    const swatch = document.createElement('i');
    swatch.style.background = `var(${colour})`;
    const letter = document.createElement('kbd');
    letter.textContent = key;
    label.append(input, swatch, words, letter);
    box.append(label);
    onChange((keys) => keys.includes('show') && (input.checked = shows(layer)));
  }
}

// Status, match, time, and the list of hypotheses.
// falls: of the hypotheses that a plan is to tell apart, by how much, see the API.
export function showAnswer(result, chosen, choose, falls = []) {
  const pill = $('status'), numbers = $('numbers'), list = $('hypotheses');
  pill.className = `pill ${result?.status ?? ''}`;
  pill.textContent = result ? result.status.replace(/_/g, ' ') : '…';
  if (!result) {
    numbers.textContent = '';
    list.replaceChildren();
    return;
  }
  const { hypotheses: all, match, ms } = result;
  numbers.innerHTML = '';
  const say = (bold, rest) => {
    const b = document.createElement('b');
    b.textContent = bold;
    numbers.append(b, rest);
  };
  say(`${all.length}`, all.length === 1 ? ' pose · ' : ' poses · ');
  if (state.method !== 'exact') {
    numbers.append('match ');
    say(`${(100 * match).toFixed(0)} %`, ' · ');
  }
  say(ms < 10 ? ms.toFixed(1) : ms.toFixed(0), ' ms');
  showHypotheses(list, all, chosen, choose, new Set(falls.map((one) => one.hypothesis)));
  const certificate = result.certificate;
  $('certificate').textContent = certificate
    ? `${certificate.complete ? 'Proven' : 'Proven so far'}: no pose elsewhere costs ${(100 * certificate.cost).toFixed(1)} cm a beam or less, but for ${certificate.regions} regions not excluded.`
    : '';
}

function showHypotheses(list, all, chosen, choose, atStake) {
  while (list.children.length > all.length) list.lastChild.remove();
  all.forEach((h, i) => {
    if (!list.children[i]) {
      const item = document.createElement('li'), button = document.createElement('button');
      button.append(document.createElement('span'), document.createElement('span'), document.createElement('span'), document.createElement('i'));
      button.children[0].className = 'rank';
      button.addEventListener('click', () => choose(i));
      item.append(button);
      list.append(item);
    }
    const button = list.children[i].firstChild;
    button.setAttribute('aria-pressed', String(i === chosen));
    button.classList.toggle('at-stake', atStake.has(i));
    button.title = atStake.has(i) ? 'The scan at the goal tells it from others: it falls if one of those is right' : '';
    button.children[0].textContent = i + 1;
    button.children[1].textContent = `${h.x.toFixed(2)}, ${h.y.toFixed(2)}, ${((h.phi * 180) / Math.PI).toFixed(1)}°`;
    button.children[2].textContent = `${(100 * h.weight).toFixed(1)} %`;
    button.children[3].style.width = `${100 * h.weight}%`;
  });
}

let hintTimer = 0;
export function hint(words, ms = 3500) {
  const box = $('hint');
  box.textContent = words;
  box.hidden = !words;
  clearTimeout(hintTimer);
  if (ms) hintTimer = setTimeout(() => (box.hidden = true), ms);
}
