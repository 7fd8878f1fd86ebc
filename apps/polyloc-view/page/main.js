// polyloc-view's page: ties state, map, hand, panel and server together.

import * as api from './api.js';
import { Camera } from './camera.js';
import { drawGallery } from './gallery.js';
import { inside, radians, shiftedWalls, wrapped } from './geometry.js';
import { Hand } from './hand.js';
import { bindKeys, fillHelp } from './keys.js';
import { LogPlayer } from './log.js';
import { bindPanel, bindRadio, chooseTool, chosenTool, hint, showAnswer } from './panel.js';
import { CanvasPen } from './pens.js';
import { drawPolar } from './polar.js';
import { jsonText, offer, svgText } from './saving.js';
import { colours, drawScene } from './scene.js';
import { addressOf, change, defaults, fromAddress, layers, onChange, pack, shows, state, toggle, unpack } from './state.js';
import { Tour } from './tour.js';
import { Travel } from './travel.js';

const $ = (id) => document.getElementById(id);
const canvas = $('map');
const camera = new Camera(1, 1);
const data = { map: null, answer: null, compare: null, view: null, leaf: null, cells: null };
const stats = { answers: 0, times: [] };
let health = null;
let wallDrag = null; // a wall that is being moved

const pose = () => ({ x: state.x, y: state.y, phi: radians(state.deg) });

// In a log the robot is where the answer says, not in the hand.
const inLog = () => state.row >= 0 && player.count > 0;

// In a drive it is where its steps have led to.
const inDrive = () => state.step >= 0 && !inLog();
const robot = () => (inDrive() && state.step > 0 && data.answer?.drive?.pose) || pose();

function scene() {
  const walls = unpack(state.walls);
  if (wallDrag) walls.push(wallDrag);
  return {
    map: data.map,
    pose: inLog() ? null : robot(),
    scan: data.answer?.scan ?? null,
    polygon: data.answer?.polygon ?? null,
    result: data.answer?.result ?? null,
    chosen: state.sel,
    compare: data.compare,
    view: shows('view') || shows('skeleton') ? data.view : null,
    leaf: data.leaf,
    cells: data.cells,
    changes: { discs: unpack(state.discs), walls },
    prior: inDrive() && state.step > 0 ? {} : priorOf(),
    drive: (inDrive() && data.answer?.drive) || null,
    path: player.count ? { truth: player.path, dots: player.dots(), here: inLog() ? data.answer?.truth : null } : null,
  };
}

// Where the switches look from: the hand, or the chosen answer to a scan of the log.
function standpoint() {
  return (inLog() && data.answer?.result?.hypotheses[state.sel]) || robot();
}

function priorOf() {
  const prior = {};
  // What a compass would say: the truth of the log, else what is set by hand.
  const truth = inLog() && data.answer?.row === state.row ? data.answer.truth : null;
  const at = truth ?? pose();
  if (state.compass) prior.compass = { heading: at.phi, tolerance: radians(state.ctol) };
  if (state.near) prior.near = { x: at.x, y: at.y, radius: state.nearr };
  return prior;
}

// ---------------------------------------------------------------- drawing

let isDrawAsked = false;
function draw() {
  $('polar-box').hidden = !shows('polar');
  $('gallery').hidden = !shows('gallery');
  if (isDrawAsked) return;
  isDrawAsked = true;
  requestAnimationFrame(() => {
    isDrawAsked = false;
    const ratio = devicePixelRatio || 1;
    const context = canvas.getContext('2d');
    const colour = colours();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = colour('--ground');
    context.fillRect(0, 0, camera.width, camera.height);
    const seen = scene();
    drawScene(new CanvasPen(context, camera), seen, shows, colour, camera.zoom);
    drawScaleBar(context, colour);
    if (data.map) stats.firstPicture ??= performance.now();
    if (shows('polar')) drawPolar($('polar'), $('polar-caption'), seen, colour, shows('bands'));
    if (shows('gallery')) drawGallery($('gallery'), seen, colour, choose);
  });
}

function drawScaleBar(context, colour) {
  const goal = 110 / camera.zoom, power = 10 ** Math.floor(Math.log10(goal));
  const length = [5, 2, 1].map((n) => n * power).find((n) => n <= goal) ?? power;
  const x = camera.width - 20 - length * camera.zoom, y = camera.height - 18;
  context.fillStyle = colour('--soft');
  context.fillRect(x, y, length * camera.zoom, 3);
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  context.textAlign = 'center';
  context.fillText(length >= 1 ? `${length} m` : `${+(100 * length).toFixed(1)} cm`, x + (length * camera.zoom) / 2, y - 8);
  context.textAlign = 'start';
}

function resize() {
  const box = canvas.getBoundingClientRect();
  const ratio = devicePixelRatio || 1;
  if (!box.width || !box.height) return;
  const was = [camera.width, camera.height];
  [camera.width, camera.height] = [box.width, box.height];
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round(box.height * ratio);
  if (data.map && (was[0] <= 1 || isFitted)) fit();
  draw();
}

// ---------------------------------------------------------------- the map

// Lines as fine as half a pixel, of a few levels; a coarse one is there at once.
const levels = new Map();
let wantedLevel = null;
const levelOf = (tolerance) => (tolerance < 0.003 ? 0 : 4 ** Math.floor(Math.log(tolerance) / Math.log(4)));

async function needLevel(tolerance) {
  const level = levelOf(tolerance);
  if (level === wantedLevel) return;
  wantedLevel = level;
  if (!levels.has(level)) levels.set(level, api.get(`map?tolerance=${level}`));
  try {
    const map = await levels.get(level);
    if (level !== wantedLevel) return;
    data.map = map;
    draw();
  } catch (error) {
    levels.delete(level);
    wantedLevel = null;
    lost(error);
  }
}

function viewChanged() {
  isFitted = false;
  if (data.map) needLevel(0.5 / camera.zoom);
  change({ cx: camera.cx, cy: camera.cy, zoom: camera.zoom });
  draw();
}

// Until somebody pans or zooms, the whole map stays in sight, however the window changes.
let isFitted = true;

function fit() {
  camera.fit(data.map.bounds, Math.min(64, camera.width / 12));
  isFitted = true;
  if (data.map) needLevel(0.5 / camera.zoom);
  change({ cx: null, cy: null, zoom: null });
  draw();
}

function fitOrRestore() {
  if (state.zoom > 0 && state.cx !== null && state.cy !== null) {
    Object.assign(camera, { cx: state.cx, cy: state.cy, zoom: state.zoom });
    viewChanged();
  } else {
    fit();
  }
}

// A place to begin with: the free one nearest to the middle of the map, on a lattice.
function startingPlace(map) {
  const [x0, y0, x1, y1] = map.bounds;
  const mx = (x0 + x1) / 2, my = (y0 + y1) / 2;
  let best = [mx, my], least = Infinity;
  const n = 41;
  for (let i = 1; i < n; ++i) {
    for (let j = 1; j < n; ++j) {
      const x = x0 + ((x1 - x0) * i) / n, y = y0 + ((y1 - y0) * j) / n;
      const off = Math.hypot(x - mx, y - my);
      if (off < least && inside(map.free, x, y)) [best, least] = [[x, y], off];
    }
  }
  return best;
}

// ---------------------------------------------------------------- answers

function simulationOf() {
  return {
    pose: pose(),
    laser: {
      beams: state.beams, fov: radians(state.fov), sigma: state.sigma / 100, max_range: state.range,
      dropout: state.dropout / 100, short_beams: state.short / 100, seed: state.seed,
    },
    changes: {
      discs: unpack(state.discs).map(([x, y, radius]) => ({ x, y, radius })),
      moved: unpack(state.walls).concat(wallDrag ? [wallDrag] : []).map(([x, y, dx, dy]) => ({ x, y, dx, dy })),
    },
    search: searchOf(),
  };
}

function driveOf() {
  const { search, ...simulation } = simulationOf();
  return { ...simulation, prior: search.prior, robot: { radius: state.radius / 100, strategy: state.strategy } };
}

function searchOf() {
  return {
    prior: priorOf(),
    options: { method: state.method, max_hypotheses: state.most, regions: shows('regions') && state.method === 'certified', time_budget_ms: 5000 },
  };
}

// The answer to the scan in the hand, or to the row of the log.
async function question() {
  if (inDrive()) return travel.question(driveOf());
  if (!inLog()) return api.post('answer', 'simulate', simulationOf());
  if (state.compass || state.near) {
    // The prior asks for the truth of this row, which comes with it.
    const { truth } = await api.post('row', 'scan', { row: state.row }) ?? {};
    data.answer = { ...data.answer, row: state.row, truth };
  }
  return api.post('answer', 'scan', { row: state.row, search: searchOf() });
}

// One question at a time while answers come fast; a slow one is given up for the newer.
const kPatience = 250; // ms
let asked = null;
let isStale = false;

function ask() {
  if (!data.map) return;
  if (asked && performance.now() - asked.since < kPatience) {
    isStale = true;
    return;
  }
  isStale = false;
  const mine = { since: performance.now() };
  asked = mine;
  answerOnce().catch(failed).finally(() => {
    if (asked !== mine) return;
    asked = null;
    if (isStale) ask();
  });
  setTimeout(() => asked === mine && isStale && ask(), kPatience + 5);
}

async function answerOnce() {
  const answer = await question();
  if (!answer) return;
  counted();
  found();
  data.answer = answer;
  if (answer.row !== undefined) player.answered(answer);
  if (answer.drive) travel.answered(answer);
  if (state.sel >= answer.result.hypotheses.length) change({ sel: 0 });
  show();
  draw();
  await details();
}

function show() {
  const result = data.answer?.result;
  showAnswer(result, state.sel, choose, data.answer?.drive?.plan?.falls);
  $('travel-plan').hidden = inDrive() || inLog() || result?.status !== 'ambiguous';
  // Where the robot stands is not in the hand then.
  for (const key of ['x', 'y', 'deg']) document.querySelector(`[data-key="${key}"]`).disabled = inLog() || state.step > 0;
}

// What the switches need beside the answer itself.
async function details() {
  const jobs = [];
  if (shows('predicted') || shows('polar')) jobs.push(compare());
  else data.compare = null;
  if (shows('view') || shows('skeleton')) {
    jobs.push(at('view', 'view', standpoint()));
  }
  if (shows('bands')) jobs.push(at('leaf', 'leaf', standpoint()));
  if ((shows('cells') || shows('segments')) && !data.cells) jobs.push(loadCells());
  await Promise.all(jobs);
  draw();
}

async function compare() {
  const { scan, result } = data.answer ?? {};
  if (!scan) return;
  const chosen = result.hypotheses[state.sel];
  const place = chosen ?? robot();
  const answer = await api.post('compare', 'compare', { ...scan, pose: { x: place.x, y: place.y, phi: place.phi } });
  if (answer) data.compare = { ...answer, pose: place, title: chosen ? `hypothesis ${state.sel + 1}` : 'the robot' };
}

async function at(name, path, point) {
  try {
    const answer = await api.post(name, path, { x: point.x, y: point.y });
    if (answer) data[name] = answer;
  } catch (error) {
    if (error.code !== 'not_free') throw error;
    data[name] = null;
  }
}

async function loadCells() {
  try {
    hint('cutting the map into visibility cells…', 0);
    data.cells = await api.get('cells');
    const limited = data.cells.range === null ? '' : `, of sight limited to ${data.cells.range.toFixed(2)} m`;
    hint(`${data.cells.count} visibility cells${limited}`);
  } catch (error) {
    hint(error.message, 8000);
    data.cells = { cells: [], segments: [] };
  }
}

function failed(error) {
  if (error instanceof api.ApiFailure && error.status >= 400) {
    data.answer = { scan: data.answer?.scan ?? null, result: null };
    if (inDrive()) travel.failed();
    show();
    hint(error.message, 6000);
    draw();
  } else {
    lost(error);
  }
}

function counted() {
  const now = performance.now();
  stats.answers += 1;
  stats.times.push(now);
  while (stats.times[0] < now - 1000) stats.times.shift();
}

// ---------------------------------------------------------------- the server

let isLost = false;
function lost(error) {
  if (isLost) return;
  isLost = true;
  console.info(`polyloc-view: ${error.message}`);
  $('lost').hidden = false;
  setTimeout(look, 500);
}

function found() {
  if (!isLost) return;
  isLost = false;
  $('lost').hidden = true;
}

// Looks whether the server is there and what its index is about; slowly once all is well.
let lookTimer = 0;
async function look() {
  clearTimeout(lookTimer);
  let pause = 5000;
  try {
    const now = await api.get('health');
    const wasLost = isLost;
    found();
    if (health && now.map_hash !== health.map_hash) return location.reload();
    health = now;
    const building = now.state === 'indexing';
    $('connection').textContent = building ? `index ${(100 * now.progress).toFixed(0)} %` : now.state === 'failed' ? now.error : '';
    if (building) pause = 300;
    if (wasLost) ask();
  } catch (error) {
    lost(error);
    pause = 1000;
  }
  if (!document.hidden) lookTimer = setTimeout(look, pause);
}

// ---------------------------------------------------------------- what people do

function choose(i) {
  if (i < (data.answer?.result?.hypotheses.length ?? 0)) change({ sel: i });
}

function setTheme(dark) {
  document.documentElement.classList.toggle('dark', dark);
  draw();
}

function tidy() {
  change({ discs: '', walls: '' });
}

function drop(x, y) {
  change({ discs: pack([...unpack(state.discs), [x, y, 0.3]]) });
}

function dragWall(from, to, isDone) {
  const moved = [from[0], from[1], to[0] - from[0], to[1] - from[1]];
  if (isDone) {
    wallDrag = null;
    if (Math.hypot(moved[2], moved[3]) > 0.02) change({ walls: pack([...unpack(state.walls), moved]) });
    chooseTool('robot');
  } else {
    wallDrag = moved;
  }
  ask();
  draw();
}

function shiftWall(by) {
  if (!data.answer?.scan || inLog() || inDrive()) return;
  change({ walls: pack(shiftedWalls(unpack(state.walls), data.answer.scan, pose(), by)) });
}

const act = {
  pose: () => (inLog() || state.step > 0 ? null : { x: state.x, y: state.y, deg: state.deg }),
  move: (x, y) => !inLog() && change({ x, y }),
  turn: (deg) => !inLog() && change({ deg }),
  pan: viewChanged,
  zoomed: viewChanged,
  drop,
  dragWall,
  tool: chosenTool,
};

const keys = {
  step: (dx, dy) => !inLog() && change({ x: state.x + dx, y: state.y + dy }),
  turn: (deg) => !inLog() && change({ deg: wrapped(state.deg + deg) }),
  pan: (dx, dy) => (camera.pan(dx, dy), viewChanged()),
  zoomIn: () => (camera.zoomAt(camera.width / 2, camera.height / 2, 1.25), viewChanged()),
  zoomOut: () => (camera.zoomAt(camera.width / 2, camera.height / 2, 0.8), viewChanged()),
  fit,
  choose,
  toggle,
  adopt: () => {
    const h = data.answer?.result?.hypotheses[state.sel];
    if (h) change({ x: h.x, y: h.y, deg: wrapped((h.phi * 180) / Math.PI), row: -1 });
  },
  drop: () => drop(state.x + 0.8 * Math.cos(radians(state.deg)), state.y + 0.8 * Math.sin(radians(state.deg))),
  pushWall: () => shiftWall(0.2),
  pullWall: () => shiftWall(-0.2),
  tidy,
  drive: () => travel.go(),
  driveBack: () => travel.back(),
  driveToTheEnd: () => travel.toggle(),
  nextMethod: () => {
    const all = ['certified', 'cells', 'exact'];
    change({ method: all[(all.indexOf(state.method) + 1) % all.length] });
  },
  panel: () => {
    const isClosed = $('panel').classList.toggle('closed');
    $('panel-button').setAttribute('aria-expanded', String(!isClosed));
    resize();
  },
  theme: () => setTheme(!document.documentElement.classList.contains('dark')),
  help: () => $('help').showModal(),
  saveSvg: () => offer('polyloc-view.svg', svgText(scene(), camera, shows, colours()), 'image/svg+xml'),
  savePng: () => canvas.toBlob((blob) => offer('polyloc-view.png', blob)),
  play: () => player.toggle(),
  before: () => player.step(-1),
  next: () => player.step(1),
  nextMiss: () => player.nextMiss().catch(failed),
  leave: () => (tour.isOpen ? tour.end() : inDrive() ? travel.leave() : player.leave()),
};

const kScanKeys = ['x', 'y', 'deg', 'beams', 'fov', 'range', 'sigma', 'short', 'dropout', 'seed', 'compass', 'ctol', 'near', 'nearr', 'most', 'method', 'discs', 'walls', 'row', 'step', 'radius', 'strategy'];
// What an outcome in the log depends on.
const kSearchKeys = ['compass', 'ctol', 'near', 'nearr', 'most', 'method'];

onChange((changed) => {
  // What is changed on the way begins another drive.
  if (state.step > 0 && !changed.includes('step') && changed.some((key) => kScanKeys.includes(key))) change({ step: 0 });
  if (changed.some((key) => kSearchKeys.includes(key))) player.forget();
  if (changed.includes('row')) player.show();
  if (changed.includes('row') || changed.includes('step')) travel.show();
  if (changed.some((key) => kScanKeys.includes(key))) ask();
  else if (changed.includes('show')) {
    const needsRegions = shows('regions') && !data.answer?.result?.regions;
    if (needsRegions) ask();
    else details().catch(failed);
  } else if (changed.includes('sel')) {
    show();
    details().catch(failed);
  }
  draw();
});

const player = new LogPlayer({
  row: () => state.row,
  setRow: (row) => change({ row, sel: 0 }),
  search: searchOf,
  hint: (words) => hint(words),
});

const travel = new Travel({
  step: () => (inLog() ? -1 : state.step),
  setStep: (step) => change({ step, sel: 0 }),
  may: () => (inLog() ? 'A scan of the log is not simulated: leave the log (Esc) to drive.' : ''),
  hint: (words) => hint(words),
});

const tour = new Tour({
  set: (part) => {
    change({ ...part, row: -1, step: -1, compass: false, near: false, discs: '', walls: '', short: 0, dropout: 0 });
    fit();
  },
});

// ---------------------------------------------------------------- the beginning

async function begin() {
  Object.assign(state, fromAddress(location.hash));
  const dark = matchMedia('(prefers-color-scheme: dark)');
  setTheme(dark.matches);
  dark.addEventListener('change', () => setTheme(dark.matches));
  bindPanel();
  bindRadio('tool', () => 'robot', (tool) => {
    if (tool === 'wall') hint('Drag from a wall to where it shall stand.');
    if (tool === 'disc') hint('Click where an object of 60 cm shall stand.');
  });
  fillHelp($('help'));
  bindKeys(keys);
  new Hand(canvas, camera, act);
  const buttons = {
    fit, theme: keys.theme, 'help-button': keys.help, 'panel-button': keys.panel, tidy,
    'tour-button': () => startTour(),
    'save-svg': keys.saveSvg, 'save-png': keys.savePng,
    'save-json': () => offer('polyloc-view.json', jsonText({ ...state }, scene()), 'application/json'),
    'copy-link': async () => {
      const link = `${location.href.split('#')[0]}#${addressOf(state)}`;
      history.replaceState(null, '', link);
      await navigator.clipboard?.writeText(link).then(() => hint('link copied'), () => hint('the address bar holds the link'));
    },
  };
  for (const [id, press] of Object.entries(buttons)) $(id).addEventListener('click', press);
  new ResizeObserver(resize).observe(canvas);
  addEventListener('visibilitychange', () => {
    if (!document.hidden) return look();
    player.stop(); // nobody looks
    travel.stop();
  });
  addEventListener('hashchange', () => {
    change({ ...defaults, ...fromAddress(location.hash) });
    if (data.map) fitOrRestore();
  });
  setInterval(() => {
    const rate = stats.times.filter((t) => t > performance.now() - 1000).length;
    const map = data.map ? `${data.map.area_m2.toFixed(0)} m² · ${data.map.vertices} vertices · map ${data.map.map_hash}` : '';
    $('counts').textContent = `${map}${rate > 1 ? ` · ${rate} answers/s` : ''}`;
  }, 500);
  look();
  await firstMap();
  resize();
  await player.begin();
  if (!Object.hasOwn(fromAddress(location.hash), 'x')) {
    const [x, y] = startingPlace(data.map);
    change({ x, y });
  }
  fitOrRestore();
  ask();
  if (data.map.name === 'niches.wkt' && !Tour.wasSeen() && !location.hash) startTour();
}

function startTour() {
  if (data.map.name !== 'niches.wkt') {
    hint('The tour goes with the niches map: start polyloc-view without a map.', 6000);
    return;
  }
  tour.go(0);
}

async function firstMap() {
  for (;;) {
    try {
      data.map = await api.get('map?pixels=1500'); // replaced by what the zoom asks for
      $('map-name').textContent = data.map.name;
      document.title = `${data.map.name} · polyloc-view`;
      return;
    } catch (error) {
      lost(error);
      await new Promise((resolve) => setTimeout(resolve, 1000));
    }
  }
}

// For tests and the curious: what is shown, in the console.
globalThis.polyloc = { state, data, stats, camera, layers, change, look: viewChanged, isBusy: () => Boolean(asked) || isStale };

begin();
