// The polar functions of what is measured and what is predicted: range over bearing, as the paper
// draws them, with their distance.

export function drawPolar(canvas, caption, scene, colour, withBands) {
  const ratio = devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const c = canvas.getContext('2d');
  c.scale(ratio, ratio);
  const { scan, compare, leaf } = scene;
  if (!scan) return;

  const left = 30, low = height - 18, wide = width - left - 6, high = low - 8;
  const most = greatestRange(scan, compare);
  const px = (bearing) => left + ((wrap(bearing) + Math.PI) / (2 * Math.PI)) * wide;
  const py = (range) => low - Math.min(range / most, 1) * high;

  c.font = '11px system-ui, "DejaVu Sans", sans-serif';
  c.strokeStyle = colour('--line');
  c.fillStyle = colour('--soft');
  c.lineWidth = 1;
  c.textBaseline = 'middle';
  for (let k = 0; k <= 4; ++k) {
    const range = (most * k) / 4;
    c.beginPath();
    c.moveTo(left, py(range));
    c.lineTo(left + wide, py(range));
    c.stroke();
    c.fillText(range.toFixed(most < 8 ? 1 : 0), 4, py(range));
  }
  c.textAlign = 'center';
  for (const deg of [-180, -90, 0, 90, 180]) {
    c.fillText(`${deg}°`, Math.min(Math.max(left + ((deg + 180) / 360) * wide, left + 8), left + wide - 14), low + 10);
  }
  c.textAlign = 'start';

  if (withBands && leaf && compare) drawBands(c, leaf, compare.pose.phi, px, py, colour('--region'), most, wide);
  if (compare) drawPredicted(c, scan, compare.wall, px, py, colour('--predicted'), wide);
  c.fillStyle = colour('--measured');
  for (let i = 0; i < scan.ranges.length; ++i) {
    if (scan.kinds[i] !== 'h') continue;
    c.beginPath();
    c.arc(px(scan.bearings[i]), py(scan.ranges[i]), 1.7, 0, 7);
    c.fill();
  }
  caption.textContent = words(compare);
}

const wrap = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));

function greatestRange(scan, compare) {
  let most = 1;
  for (let i = 0; i < scan.ranges.length; ++i) if (scan.kinds[i] === 'h') most = Math.max(most, scan.ranges[i]);
  for (const w of compare?.wall ?? []) if (w !== null && w < 1.5 * most) most = Math.max(most, w);
  return most * 1.06;
}

function drawPredicted(c, scan, wall, px, py, colour, wide) {
  const order = [...scan.bearings.keys()].sort((a, b) => wrap(scan.bearings[a]) - wrap(scan.bearings[b]));
  c.strokeStyle = colour;
  c.lineWidth = 1.5;
  c.beginPath();
  let before = null;
  for (const i of order) {
    const x = px(scan.bearings[i]);
    const joins = before !== null && x - before < wide / 12;
    if (wall[i] === null) {
      before = null;
      continue;
    }
    if (joins) c.lineTo(x, py(wall[i]));
    else c.moveTo(x, py(wall[i]));
    before = x;
  }
  c.stroke();
}

// Nothing that is seen from anywhere in the leaf lies outside the band.
function drawBands(c, leaf, heading, px, py, colour, most, wide) {
  c.fillStyle = colour;
  c.globalAlpha = 0.25;
  const width = (leaf.bin_width / (2 * Math.PI)) * wide;
  for (let b = 0; b < leaf.near.length; ++b) {
    const x = px((b + 0.5) * leaf.bin_width - heading);
    const top = py(leaf.wall[b] ?? most), bottom = py(leaf.near[b]);
    c.fillRect(x, top, width + 0.5, Math.max(bottom - top, 1));
  }
  c.globalAlpha = 1;
}

function words(compare) {
  if (!compare) return 'No pose to hold the scan against.';
  let text = `Measured (dots) and predicted (line) at ${compare.title}: mean cost ${(100 * compare.mean_cost).toFixed(1)} cm a beam`;
  if (compare.polar) {
    const { distance, best_distance: best, rotation } = compare.polar;
    text += `; polar distance ${distance.toFixed(2)} m√rad, least under rotation ${best.toFixed(2)} (turned by ${((rotation * 180) / Math.PI).toFixed(0)}°)`;
  }
  return `${text}.`;
}
