// What the page shows, in one flat object that the address holds: a view is shared by its link.

export const layers = [
  ['scan', 'scan', 's', '--scan'],
  ['beams', 'beams', 'f', '--scan'],
  ['predicted', 'predicted', 'p', '--predicted'],
  ['hypotheses', 'hypotheses', 'h', '--rival'],
  ['polar', 'polar plot', 'o', '--measured'],
  ['gallery', 'side by side', 'k', '--rival'],
  ['cells', 'visibility cells', 'c', '--cell'],
  ['segments', 'critical segments', 'x', '--segment'],
  ['view', 'visibility polygon', 'v', '--view'],
  ['skeleton', 'skeleton', 'g', '--skeleton'],
  ['regions', 'regions not excluded', 'r', '--region'],
  ['bands', 'bands of the leaf', 'b', '--region'],
];

export const defaults = {
  x: 0, y: 0, deg: 0,
  beams: 360, fov: 360, range: 20, sigma: 3, short: 0, dropout: 0, seed: 1,
  compass: false, ctol: 10, near: false, nearr: 5, most: 20, method: 'certified',
  show: 'scan,hypotheses', discs: '', walls: '', sel: 0, row: -1,
  step: -1, radius: 25, strategy: 'greedy',
  cx: null, cy: null, zoom: null,
};

export const state = { ...defaults };
const listeners = [];

export const shows = (layer) => state.show.split(',').includes(layer);

export function toggle(layer) {
  const on = new Set(state.show.split(',').filter(Boolean));
  if (!on.delete(layer)) on.add(layer);
  change({ show: layers.map((l) => l[0]).filter((l) => on.has(l)).join(',') });
}

// Lists of numbers in the address: "1,2,0.3;4,5,0.3".
export const unpack = (text) => text.split(';').filter(Boolean).map((item) => item.split(',').map(Number));
export const pack = (items) => items.map((item) => item.map((n) => +n.toFixed(3)).join(',')).join(';');

export function onChange(listener) {
  listeners.push(listener);
}

export function change(patch) {
  const changed = Object.keys(patch).filter((key) => state[key] !== patch[key]);
  if (!changed.length) return;
  Object.assign(state, patch);
  listeners.forEach((listener) => listener(changed));
  remember();
}

let timer = 0;
function remember() {
  clearTimeout(timer);
  timer = setTimeout(() => history.replaceState(null, '', `#${addressOf(state)}`), 200);
}

export function addressOf(from) {
  const words = new URLSearchParams();
  for (const [key, usual] of Object.entries(defaults)) {
    const value = from[key];
    if (value === usual || value === null) continue;
    words.set(key, typeof value === 'number' ? String(+value.toFixed(4)) : String(value));
  }
  return words.toString();
}

// What an address says; what it says wrongly counts as not said.
export function fromAddress(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  const found = {};
  for (const [key, usual] of Object.entries(defaults)) {
    if (!words.has(key)) continue;
    const text = words.get(key);
    if (typeof usual === 'boolean') found[key] = text === 'true';
    else if (typeof usual === 'string') found[key] = text;
    else if (Number.isFinite(Number(text))) found[key] = Number(text);
  }
  return found;
}
