// Mouse, touch and pen on the map: take the robot and drag it, turn it by its handle or the wheel,
// pan, zoom, pinch, drop things.

import { handleReach } from './scene.js';
import { degrees, radians, wrapped } from './geometry.js';

const kGrip = 18; // pixels around what is taken
const kTap = 5; // pixels that a tap may move

export class Hand {
  // act: {pose(), move(x, y), turn(deg), pan(), zoomed(), drop(x, y), dragWall(from, to, done), tool(), canMove()}
  constructor(canvas, camera, act) {
    this.canvas = canvas;
    this.camera = camera;
    this.act = act;
    this.pointers = new Map();
    this.mode = null;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.moved(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', (event) => this.up(event));
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
  }
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
  grips([px, py]) {
    const pose = this.act.pose();
    if (!pose) return null;
    const reach = handleReach(this.camera.zoom), phi = radians(pose.deg);
    const [hx, hy] = this.camera.toScreen(pose.x + reach * Math.cos(phi), pose.y + reach * Math.sin(phi));
    if (Math.hypot(px - hx, py - hy) < kGrip) return 'turn';
    const [rx, ry] = this.camera.toScreen(pose.x, pose.y);
    return Math.hypot(px - rx, py - ry) < Math.max(kGrip, 0.18 * this.camera.zoom) ? 'move' : null;
  }
  down(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.place(event);
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size === 2) {
      this.mode = 'pinch';
      return;
    }
    this.start = at;
    this.last = at;
    this.travelled = 0;
    const tool = this.act.tool();
    if (tool === 'wall') this.mode = 'wall';
    else this.mode = this.grips(at) ?? 'pan';
    if (this.mode === 'move') {
      const pose = this.act.pose(), [x, y] = this.camera.toMap(...at);
      this.offset = [pose.x - x, pose.y - y];
    }
  }
  moved(event) {
    const at = this.place(event);
    if (!this.pointers.has(event.pointerId)) {
      this.canvas.style.cursor = this.grips(at) ? 'grab' : '';
      return;
    }
    const before = this.pointers.get(event.pointerId);
    this.pointers.set(event.pointerId, at);
    if (this.mode === 'pinch') return this.pinch(event.pointerId, before, at);
    this.travelled += Math.hypot(at[0] - this.last[0], at[1] - this.last[1]);
    const [x, y] = this.camera.toMap(...at);
    if (this.mode === 'move') this.act.move(x + this.offset[0], y + this.offset[1]);
    else if (this.mode === 'turn') {
      const pose = this.act.pose();
      this.act.turn(degrees(Math.atan2(y - pose.y, x - pose.x)));
    } else if (this.mode === 'wall') this.act.dragWall(this.camera.toMap(...this.start), [x, y], false);
    else if (this.mode === 'pan' && this.travelled > kTap) {
      this.camera.pan(at[0] - this.last[0], at[1] - this.last[1]);
      this.act.pan();
    }
    this.last = at;
  }
  pinch(id, before, at) {
    const other = [...this.pointers].find(([key]) => key !== id)?.[1];
    if (!other) return;
    const was = Math.hypot(before[0] - other[0], before[1] - other[1]);
    const is = Math.hypot(at[0] - other[0], at[1] - other[1]);
    this.camera.pan((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
    if (was > 1) this.camera.zoomAt((at[0] + other[0]) / 2, (at[1] + other[1]) / 2, is / was);
    this.act.zoomed();
  }
  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    const [x, y] = this.camera.toMap(...this.place(event));
    if (this.mode === 'wall') this.act.dragWall(this.camera.toMap(...this.start), [x, y], true);
    else if (this.mode === 'pan' && this.travelled <= kTap && event.type === 'pointerup') {
      if (this.act.tool() === 'disc') this.act.drop(x, y);
      else this.act.move(x, y);
    }
    if (this.pointers.size === 0) this.mode = null;
  }
  wheel(event) {
    event.preventDefault();
    const at = this.place(event);
    const amount = event.deltaMode === 1 ? event.deltaY * 30 : event.deltaY;
    if (this.grips(at) || event.shiftKey) {
      const pose = this.act.pose();
      if (pose) this.act.turn(wrapped(pose.deg - Math.sign(amount || event.deltaX) * 3));
      return;
    }
    this.camera.zoomAt(...at, Math.exp(-amount * (event.ctrlKey ? 0.01 : 0.0015)));
    this.act.zoomed();
  }
}
