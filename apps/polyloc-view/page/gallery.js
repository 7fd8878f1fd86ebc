// The best hypotheses side by side: the surroundings of each with the scan laid into them.

import { Camera } from './camera.js';
import { CanvasPen } from './pens.js';
import { drawMap, drawArrow } from './scene.js';
import { frameOf, hitPoints } from './geometry.js';

const kMost = 6;

export function drawGallery(box, scene, colour, choose) {
  const hypotheses = (scene.scan && scene.result?.hypotheses.slice(0, kMost)) || [];
  while (box.children.length > hypotheses.length) box.lastChild.remove();
  hypotheses.forEach((h, i) => {
    if (!box.children[i]) {
      const button = document.createElement('button');
      button.append(document.createElement('canvas'), document.createElement('span'));
      button.addEventListener('click', () => choose(i));
      box.append(button);
    }
    const button = box.children[i];
    button.setAttribute('aria-pressed', String(i === scene.chosen));
    button.lastChild.textContent = `${i + 1} · ${(100 * h.weight).toFixed(1)} % · ${(100 * h.cost).toFixed(1)} cm`;
    drawOne(button.firstChild, scene, h, colour, i === 0);
  });
}

function drawOne(canvas, scene, pose, colour, first) {
  const ratio = devicePixelRatio || 1;
  const camera = new Camera(canvas.clientWidth || 168, canvas.clientHeight || 128);
  canvas.width = camera.width * ratio;
  canvas.height = camera.height * ratio;
  const c = canvas.getContext('2d');
  c.scale(ratio, ratio);
  c.fillStyle = colour('--ground');
  c.fillRect(0, 0, camera.width, camera.height);
  const hits = hitPoints(scene.scan, frameOf(scene.scan, pose));
  camera.fit(boundsOf(hits, pose), 10);
  const pen = new CanvasPen(c, camera);
  if (scene.map) drawMap(pen, scene.map, colour, 1.2);
  pen.dots(hits, 1.2, { fill: colour('--scan') });
  drawArrow(pen, pose, 9 / camera.zoom, { fill: colour(first ? '--best' : '--rival') });
}

// What nearly all beams see: single far ones would make all else small.
function boundsOf(points, pose) {
  const ranges = [];
  for (let i = 0; i < points.length; i += 2) ranges.push(Math.hypot(points[i] - pose.x, points[i + 1] - pose.y));
  ranges.sort((a, b) => a - b);
  const reach = 1.5 * (ranges[Math.floor(0.95 * ranges.length)] ?? 2);
  const box = [pose.x - 1, pose.y - 1, pose.x + 1, pose.y + 1];
  for (let i = 0; i < points.length; i += 2) {
    const [x, y] = [points[i], points[i + 1]];
    if (Math.hypot(x - pose.x, y - pose.y) > reach) continue;
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  }
  return box;
}
