// The piece of the plane that a picture shows: metres to pixels, y up.

export class Camera {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.cx = 0;
    this.cy = 0;
    this.zoom = 50; // pixels per metre
  }
  toScreen(x, y) {
    return [this.width / 2 + (x - this.cx) * this.zoom, this.height / 2 - (y - this.cy) * this.zoom];
  }
  toMap(px, py) {
    return [this.cx + (px - this.width / 2) / this.zoom, this.cy - (py - this.height / 2) / this.zoom];
  }
  fit([x0, y0, x1, y1], margin = 40) {
    this.cx = (x0 + x1) / 2;
    this.cy = (y0 + y1) / 2;
    const wide = Math.max(this.width - 2 * margin, 20) / Math.max(x1 - x0, 0.1);
    const high = Math.max(this.height - 2 * margin, 20) / Math.max(y1 - y0, 0.1);
    this.zoom = Math.min(wide, high);
  }
  zoomAt(px, py, factor) {
    const [x, y] = this.toMap(px, py);
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.05), 5000);
    this.cx = x - (px - this.width / 2) / this.zoom;
    this.cy = y + (py - this.height / 2) / this.zoom;
  }
  pan(dx, dy) {
    this.cx -= dx / this.zoom;
    this.cy += dy / this.zoom;
  }
  sees(x, y, margin = 0) {
    const [px, py] = this.toScreen(x, y);
    return px > -margin && py > -margin && px < this.width + margin && py < this.height + margin;
  }
}
