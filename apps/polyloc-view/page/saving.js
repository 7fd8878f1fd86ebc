// What is seen, to take away: SVG and PNG of the map's part, JSON of the state and the answer.

import { SvgPen } from './pens.js';
import { drawScene } from './scene.js';

export function svgText(scene, camera, shows, colour) {
  const pen = new SvgPen(camera);
  drawScene(pen, scene, shows, colour, camera.zoom);
  return pen.document(colour('--ground'));
}

export function jsonText(state, scene) {
  const { scan, result, compare, leaf, view, polygon, drive } = scene;
  return `${JSON.stringify({ state, scan, polygon, result, compare, view, leaf, drive }, null, 1)}\n`;
}

export function offer(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
