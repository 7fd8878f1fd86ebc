// What is drawn of the map and the answers, with either pen. A scene:
// {map, pose, scan, result, chosen, compare, view, leaf, cells, polygon, changes, prior, path, drive}
// and what of it is to be shown.

import { frameOf, hitPoints, beamChains, placed, predictedChain } from './geometry.js';

export function colours() {
  const style = getComputedStyle(document.documentElement);
  return (name) => style.getPropertyValue(name).trim();
}

export function drawMap(pen, map, colour, width = 1.6) {
  pen.chains(map.free, { fill: colour('--free'), closed: true });
  pen.chains(map.beyond, { stroke: colour('--beyond'), width });
  pen.chains(map.open, { stroke: colour('--open'), width: 1.2, dash: [5, 4] });
  pen.chains(map.walls, { stroke: colour('--wall'), width });
}

function drawCells(pen, cells, shows, colour) {
  if (shows('cells')) pen.chains(cells.cells, { stroke: colour('--cell'), width: 0.7, alpha: 0.75, closed: true });
  if (shows('segments')) pen.chains(cells.segments, { stroke: colour('--segment'), width: 1, alpha: 0.9 });
}

function drawView(pen, view, shows, colour) {
  if (shows('view')) {
    pen.chains([view.polygon], { fill: colour('--view'), alpha: 0.16, stroke: colour('--view'), strokeAlpha: 1, width: 1.2, closed: true });
  }
  if (shows('skeleton') && view.skeleton) {
    const colourOf = colour('--skeleton');
    const lines = view.skeleton.edges.map((edge) => edge.line);
    pen.chains(lines, { stroke: colourOf, width: 4, alpha: 0.75 });
    pen.dots(view.skeleton.vertices, 4.5, { fill: colourOf });
  }
}

function drawRegions(pen, regions, colour) {
  const chains = regions.map((region) => region.polygon.flat());
  pen.chains(chains, { fill: colour('--region'), alpha: 0.4, stroke: colour('--region'), strokeAlpha: 1, width: 0.7, closed: true });
}

function drawLeaf(pen, leaf, colour) {
  pen.chains([leaf.polygon], { stroke: colour('--region'), width: 2, fill: colour('--region'), alpha: 0.3, strokeAlpha: 1, closed: true });
  const [sx, sy] = middleOf(leaf.polygon);
  const step = leaf.bin_width;
  const near = [], wall = [];
  for (let b = 0; b < leaf.near.length; ++b) {
    const far = leaf.wall[b] ?? leaf.near[b];
    const mid = (b + 1) * step; // the window of two bins
    near.push(sx + leaf.near[b] * Math.cos(mid), sy + leaf.near[b] * Math.sin(mid));
    wall.push(sx + far * Math.cos(mid), sy + far * Math.sin(mid));
  }
  pen.chains([wall, near], { fill: colour('--region'), alpha: 0.16, stroke: colour('--region'), strokeAlpha: 0.8, width: 1, closed: true });
}

function middleOf(flat) {
  let x = 0, y = 0;
  for (let i = 0; i < flat.length; i += 2) { x += flat[i]; y += flat[i + 1]; }
  return [(2 * x) / flat.length, (2 * y) / flat.length];
}

export function drawArrow(pen, pose, length, style) {
  const c = Math.cos(pose.phi), s = Math.sin(pose.phi);
  const at = (along, aside) => [pose.x + along * c - aside * s, pose.y + along * s + aside * c];
  const l = length;
  pen.chains([[...at(l, 0), ...at(-0.62 * l, 0.58 * l), ...at(-0.28 * l, 0), ...at(-0.62 * l, -0.58 * l)]], { ...style, closed: true });
}

// How far above a hypothesis its words stand, to its right [pixels]: below where the handle of a robot
// upon it, which looks to phi, would lie on them.
export const riseOfWords = (phi) => (phi !== null && Math.cos(phi - 0.61) > 0.766 ? -18 : 16);

function drawHypotheses(pen, scene, colour, scale) {
  const { hypotheses } = scene.result;
  for (let i = hypotheses.length - 1; i >= 0; --i) {
    const h = hypotheses[i];
    const first = i === 0;
    const own = colour(first ? '--best' : '--rival');
    const [a, b, angle] = ellipseOf(h.covariance);
    pen.ellipse(h.x, h.y, 3 * a, 3 * b, angle, { stroke: own, width: 1.2, fill: own, alpha: 0.18, strokeAlpha: 1 });
    const alpha = first ? 1 : 0.45 + 0.55 * Math.min(1, h.weight * 2);
    // The robot in the hand stands on the right one: it must be seen around it.
    const off = scene.pose ? Math.hypot(h.x - scene.pose.x, h.y - scene.pose.y) * scale : Infinity;
    const size = off < 20 ? 30 : first ? 18 : 14;
    const chosen = i === scene.chosen && hypotheses.length > 1;
    drawArrow(pen, h, size / scale, { fill: own, alpha, stroke: colour(chosen ? '--ink' : '--free'), strokeAlpha: 1, width: chosen ? 1.5 : 1 });
    const up = riseOfWords(off < 20 ? scene.pose.phi : null);
    if (i < 12 && (i === scene.chosen || h.weight >= 0.005)) pen.text(h.x, h.y, 20, up, `${i + 1} · ${(100 * h.weight).toFixed(h.weight < 0.1 ? 1 : 0)} %`, { fill: own, size: 12, halo: colour('--free') });
  }
}

// Half axes of one standard deviation and the angle of the greater.
export function ellipseOf(covariance) {
  const [a, b, d] = [covariance[0][0], covariance[0][1], covariance[1][1]];
  const mean = (a + d) / 2, off = Math.hypot((a - d) / 2, b);
  return [Math.sqrt(Math.max(mean + off, 0)), Math.sqrt(Math.max(mean - off, 0)), 0.5 * Math.atan2(2 * b, a - d)];
}

function drawScan(pen, scan, pose, shows, colour, alpha = 1) {
  const frame = frameOf(scan, pose);
  if (shows('beams')) {
    pen.chains(beamChains(scan, frame, 'h'), { stroke: colour('--scan'), width: 0.6, alpha: 0.35 * alpha });
    pen.chains(beamChains(scan, frame, 'n'), { stroke: colour('--soft'), width: 0.5, alpha: 0.15 * alpha });
  }
  if (shows('scan')) pen.dots(hitPoints(scan, frame), 2, { fill: colour('--scan'), alpha });
}

const flat = (points) => points.flatMap(({ x, y }) => [x, y]);

// The safe set, with what was driven.
function drawSafe(pen, drive, colour) {
  const safe = placed(drive.safe, drive.pose);
  pen.chains(safe, { fill: colour('--safe'), alpha: 0.2, stroke: colour('--safe'), strokeAlpha: 0.7, width: 1, closed: true });
  if (drive.way.length < 4) return;
  pen.chains([drive.way], { stroke: colour('--robot'), width: 2, alpha: 0.8 });
  pen.dots(flat(drive.stops), 3.5, { fill: colour('--robot'), stroke: colour('--free'), width: 1 });
}

// Those that fell, fainter with each step since, and crossed out.
function drawFallen(pen, drive, colour, scale) {
  const own = colour('--fallen');
  for (const h of drive.fallen) {
    const age = drive.step - h.step;
    const alpha = Math.max(0.8 ** (age + 1), 0.3);
    const arm = 8 / scale;
    drawArrow(pen, h, 14 / scale, { fill: own, alpha: 0.6 * alpha });
    pen.chains([[h.x - arm, h.y - arm, h.x + arm, h.y + arm], [h.x - arm, h.y + arm, h.x + arm, h.y - arm]], { stroke: own, width: 1.8, alpha });
  }
}

// The plan where the robot truly is, and as it lies if another hypothesis is right.
function drawPlan(pen, drive, hypotheses, colour, scale) {
  const { plan, pose } = drive;
  if (plan?.status !== 'go') return;
  const way = flat(plan.way), path = flat(plan.path), own = colour('--plan');
  const atStake = new Set(plan.falls.map((one) => one.hypothesis));
  hypotheses.slice(0, 40).forEach((h, i) => {
    if (Math.hypot(h.x - pose.x, h.y - pose.y) > 0.5) {
      pen.chains(placed([path], h), { stroke: own, width: 1, dash: [3, 4], alpha: 0.55 });
    }
    if (atStake.has(i)) pen.ellipse(h.x, h.y, 22 / scale, 22 / scale, 0, { stroke: own, width: 1.5, dash: [4, 4] });
  });
  const [goal] = placed([[plan.goal.x, plan.goal.y]], pose);
  const [stop] = placed([[plan.waypoint.x, plan.waypoint.y]], pose);
  pen.chains(placed([path], pose), { stroke: own, width: 1.8, dash: [6, 5] });
  pen.chains(placed([way], pose), { stroke: own, width: 4 });
  pen.dots(stop, 10, { fill: colour('--free'), alpha: 0.85, stroke: own, strokeAlpha: 1, width: 3 });
  const arm = 7 / scale, [gx, gy] = goal;
  pen.chains([[gx - arm, gy, gx, gy - arm, gx + arm, gy, gx, gy + arm]], { fill: own, stroke: colour('--free'), width: 1.5, closed: true });
}

function drawChanges(pen, changes, colour) {
  const own = colour('--object');
  for (const [x, y, r] of changes.discs) pen.ellipse(x, y, r, r, 0, { fill: own, alpha: 0.5, stroke: own, strokeAlpha: 1, width: 1.5 });
  for (const [x, y, dx, dy] of changes.walls) {
    pen.chains([[x, y, x + dx, y + dy]], { stroke: own, width: 2, dash: [3, 4] });
    pen.dots([x + dx, y + dy], 5, { fill: own });
  }
}

function drawPrior(pen, scene, colour) {
  const { near, compass } = scene.prior;
  const own = colour('--accent');
  if (near) pen.ellipse(near.x, near.y, near.radius, near.radius, 0, { stroke: own, width: 1.3, dash: [8, 5] });
  if (compass && scene.pose) {
    const { x, y } = scene.pose, r = 46 / scene.scale;
    const wedge = [x, y];
    for (let k = 0; k <= 24; ++k) {
      const angle = compass.heading + compass.tolerance * (k / 12 - 1);
      wedge.push(x + r * Math.cos(angle), y + r * Math.sin(angle));
    }
    pen.chains([wedge], { fill: own, alpha: 0.2, stroke: own, strokeAlpha: 0.8, width: 1, closed: true });
  }
}

// A vacuum cleaner as seen from above, with the handle it is turned by, unless it drives.
function drawRobot(pen, scene, colour) {
  const { pose, scale } = scene;
  const own = colour('--robot');
  const r = Math.max(0.18, 11 / scale);
  const c = Math.cos(pose.phi), s = Math.sin(pose.phi);
  const reach = handleReach(scale);
  const isInHand = !(scene.drive?.step > 0);
  if (isInHand) pen.chains([[pose.x, pose.y, pose.x + reach * c, pose.y + reach * s]], { stroke: own, width: 2 });
  pen.ellipse(pose.x, pose.y, r, r, 0, { fill: own, stroke: colour('--free'), width: 2 });
  drawArrow(pen, pose, 0.62 * r, { fill: colour('--free') });
  if (isInHand) pen.dots([pose.x + reach * c, pose.y + reach * s], 6.5, { fill: colour('--free'), stroke: own, width: 2.5 });
}

export const handleReach = (scale) => Math.max(0.18, 11 / scale) + 26 / scale;

function drawPath(pen, scene, colour) {
  const { path } = scene;
  if (!path) return;
  if (path.truth.length) pen.chains([path.truth], { stroke: colour('--truth'), width: 1.5, alpha: 0.6 });
  const kinds = { right: '--truth', unique: '--truth', wrong: '--miss', no_match: '--miss', ambiguous: '--doubt', too_few_beams: '--soft' };
  for (const [kind, name] of Object.entries(kinds)) {
    if (path.dots[kind]?.length) pen.dots(path.dots[kind], 3.2, { fill: colour(name), alpha: 0.85 });
  }
  if (path.here) drawArrow(pen, path.here, 12 / scene.scale, { stroke: colour('--truth'), width: 2.4 });
}

export function drawScene(pen, scene, shows, colour, scale) {
  scene = { ...scene, scale };
  if (scene.map) drawMap(pen, scene.map, colour);
  if (scene.cells && (shows('cells') || shows('segments'))) drawCells(pen, scene.cells, shows, colour);
  if (scene.view) drawView(pen, scene.view, shows, colour);
  if (scene.leaf && shows('bands')) drawLeaf(pen, scene.leaf, colour);
  if (scene.result?.regions && shows('regions')) drawRegions(pen, scene.result.regions, colour);
  drawPath(pen, scene, colour);
  drawPrior(pen, scene, colour);
  drawChanges(pen, scene.changes, colour);
  if (scene.drive) drawSafe(pen, scene.drive, colour);
  if (scene.drive && shows('hypotheses')) drawFallen(pen, scene.drive, colour, scale);
  const chosen = scene.result?.hypotheses[scene.chosen];
  const at = scene.pose ?? chosen;
  if (scene.scan && at) drawScan(pen, scene.scan, at, shows, colour);
  if (scene.compare && shows('predicted')) {
    const chain = predictedChain(scene.scan, frameOf(scene.scan, scene.compare.pose), scene.compare.wall);
    pen.dots(chain, 1.6, { fill: colour('--predicted') });
    // Where the chosen pose is not that of the hand, the scan as it would lie there.
    pen.dots(hitPoints(scene.scan, frameOf(scene.scan, scene.compare.pose)), 1.3, { fill: colour('--measured'), alpha: 0.6 });
  }
  if (scene.result && shows('hypotheses')) drawHypotheses(pen, scene, colour, scale);
  if (scene.drive) drawPlan(pen, scene.drive, shows('hypotheses') ? scene.result.hypotheses : [], colour, scale);
  if (scene.pose) drawRobot(pen, scene, colour);
}
