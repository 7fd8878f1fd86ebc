// From scans to points of the map.

// The beams' origin in the map, and the robot's heading.
export function frameOf(scan, pose) {
  const c = Math.cos(pose.phi), s = Math.sin(pose.phi);
  const { x, y } = scan.sensor;
  return { x: pose.x + c * x - s * y, y: pose.y + s * x + c * y, phi: pose.phi };
}

function ends(scan, frame, keep) {
  const points = [];
  const { bearings, ranges, kinds } = scan;
  for (let i = 0; i < ranges.length; ++i) {
    if (!keep(kinds[i])) continue;
    const angle = frame.phi + bearings[i];
    points.push(frame.x + ranges[i] * Math.cos(angle), frame.y + ranges[i] * Math.sin(angle));
  }
  return points;
}

export const hitPoints = (scan, frame) => ends(scan, frame, (kind) => kind === 'h');

export function beamChains(scan, frame, wanted) {
  const points = ends(scan, frame, (kind) => kind === wanted);
  const chains = [];
  for (let i = 0; i < points.length; i += 2) chains.push([frame.x, frame.y, points[i], points[i + 1]]);
  return chains;
}

// Where the beams would end by the map.
export function predictedChain(scan, frame, wall) {
  const points = [];
  for (let i = 0; i < wall.length; ++i) {
    if (wall[i] === null) continue;
    const angle = frame.phi + scan.bearings[i];
    points.push(frame.x + wall[i] * Math.cos(angle), frame.y + wall[i] * Math.sin(angle));
  }
  return points;
}

export const radians = (degrees) => (degrees * Math.PI) / 180;
export const degrees = (angle) => (angle * 180) / Math.PI;
// In [-180, 180).
export const wrapped = (deg) => ((((deg + 180) % 360) + 360) % 360) - 180;

// Flat chains of the robot's frame, as they lie in the map if it stands at a pose.
export function placed(chains, pose) {
  const c = Math.cos(pose.phi), s = Math.sin(pose.phi);
  return chains.map((chain) => {
    const moved = new Array(chain.length);
    for (let i = 0; i < chain.length; i += 2) {
      moved[i] = pose.x + c * chain[i] - s * chain[i + 1];
      moved[i + 1] = pose.y + s * chain[i] + c * chain[i + 1];
    }
    return moved;
  });
}

// Whether a point lies in rings of flat chains, by the even-odd rule.
export function inside(rings, x, y) {
  let is = false;
  for (const ring of rings) {
    for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2) {
      const [xi, yi, xj, yj] = [ring[i], ring[i + 1], ring[j], ring[j + 1]];
      if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) is = !is;
    }
  }
  return is;
}

// Moved walls [x, y, dx, dy], with that moved on which the beam straight ahead meets, along it.
export function shiftedWalls(walls, scan, pose, by) {
  let ahead = -1;
  scan.bearings.forEach((bearing, i) => {
    const isNearer = ahead < 0 || Math.cos(bearing) > Math.cos(scan.bearings[ahead]);
    if (scan.kinds[i] === 'h' && isNearer) ahead = i;
  });
  if (ahead < 0) return walls;
  const frame = frameOf(scan, pose), angle = frame.phi + scan.bearings[ahead];
  const c = Math.cos(angle), s = Math.sin(angle);
  const x = frame.x + scan.ranges[ahead] * c, y = frame.y + scan.ranges[ahead] * s;
  // One that was moved before: noise may show it some centimetres off.
  const before = walls.find(([wx, wy, dx, dy]) => Math.hypot(wx + dx - x, wy + dy - y) < 0.15);
  if (!before) return [...walls, [x, y, by * c, by * s]];
  const [wx, wy, dx, dy] = before;
  return walls.map((wall) => (wall === before ? [wx, wy, dx + by * c, dy + by * s] : wall));
}
