// Two pens that draw the same: on a canvas, and as SVG. Places in metres of the map, widths and
// sizes of signs in pixels. Chains are flat: [x, y, x, y, ...].
//
// A style: {fill, stroke, width, dash, alpha, closed}.

export class CanvasPen {
  constructor(context, camera) {
    this.context = context;
    this.camera = camera;
  }
  chains(chains, style) {
    const { context: c, camera } = this;
    const zoom = camera.zoom;
    const left = camera.width / 2 - camera.cx * zoom;
    const low = camera.height / 2 + camera.cy * zoom;
    c.beginPath();
    for (const chain of chains) {
      if (chain.length < 4) continue;
      c.moveTo(left + chain[0] * zoom, low - chain[1] * zoom);
      for (let i = 2; i < chain.length; i += 2) c.lineTo(left + chain[i] * zoom, low - chain[i + 1] * zoom);
      if (style.closed) c.closePath();
    }
    this.finish(style);
  }
  dots(points, radius, style) {
    const { context: c, camera } = this;
    c.beginPath();
    for (let i = 0; i < points.length; i += 2) {
      const [px, py] = camera.toScreen(points[i], points[i + 1]);
      c.moveTo(px + radius, py);
      c.arc(px, py, radius, 0, 2 * Math.PI);
    }
    this.finish(style);
  }
  // Half axes in metres, turned by an angle; three standard deviations may be less than a pixel.
  ellipse(x, y, a, b, angle, style) {
    const { context: c, camera } = this;
    const [px, py] = camera.toScreen(x, y);
    c.beginPath();
    c.ellipse(px, py, Math.max(a * camera.zoom, 1.5), Math.max(b * camera.zoom, 1.5), -angle, 0, 2 * Math.PI);
    this.finish(style);
  }
  text(x, y, right, up, words, style) {
    const { context: c } = this;
    const [px, py] = this.camera.toScreen(x, y);
    c.font = `${style.size ?? 12}px system-ui, "DejaVu Sans", sans-serif`;
    c.textBaseline = 'middle';
    if (style.halo) {
      c.lineWidth = 3;
      c.lineJoin = 'round';
      c.strokeStyle = style.halo;
      c.strokeText(words, px + right, py - up);
    }
    c.fillStyle = style.fill;
    c.fillText(words, px + right, py - up);
  }
  finish(style) {
    const { context: c } = this;
    c.globalAlpha = style.alpha ?? 1;
    if (style.fill) {
      c.fillStyle = style.fill;
      c.fill('evenodd');
    }
    if (style.stroke) {
      c.globalAlpha = style.strokeAlpha ?? style.alpha ?? 1;
      c.strokeStyle = style.stroke;
      c.lineWidth = style.width ?? 1;
      c.lineJoin = 'round';
      c.lineCap = 'round';
      c.setLineDash(style.dash ?? []);
      c.stroke();
      c.setLineDash([]);
    }
    c.globalAlpha = 1;
  }
}

const escaped = (text) => String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/"/g, '&quot;');

export class SvgPen {
  constructor(camera) {
    this.camera = camera;
    this.parts = [];
  }
  at(x, y) {
    const [px, py] = this.camera.toScreen(x, y);
    return `${px.toFixed(2)} ${py.toFixed(2)}`;
  }
  attributes(style) {
    const words = [`fill="${style.fill ?? 'none'}"`];
    if (style.fill) words.push('fill-rule="evenodd"');
    if (style.fill && style.alpha !== undefined) words.push(`fill-opacity="${style.alpha}"`);
    if (style.stroke) {
      words.push(`stroke="${style.stroke}" stroke-width="${style.width ?? 1}" stroke-linejoin="round" stroke-linecap="round"`);
      const alpha = style.strokeAlpha ?? style.alpha;
      if (alpha !== undefined) words.push(`stroke-opacity="${alpha}"`);
      if (style.dash) words.push(`stroke-dasharray="${style.dash.join(' ')}"`);
    }
    return words.join(' ');
  }
  chains(chains, style) {
    let path = '';
    for (const chain of chains) {
      if (chain.length < 4) continue;
      path += `M${this.at(chain[0], chain[1])}`;
      for (let i = 2; i < chain.length; i += 2) path += `L${this.at(chain[i], chain[i + 1])}`;
      if (style.closed) path += 'Z';
    }
    if (path) this.parts.push(`<path d="${path}" ${this.attributes(style)}/>`);
  }
  dots(points, radius, style) {
    const words = this.attributes(style);
    for (let i = 0; i < points.length; i += 2) {
      const [px, py] = this.camera.toScreen(points[i], points[i + 1]);
      this.parts.push(`<circle cx="${px.toFixed(2)}" cy="${py.toFixed(2)}" r="${radius}" ${words}/>`);
    }
  }
  ellipse(x, y, a, b, angle, style) {
    const [px, py] = this.camera.toScreen(x, y);
    const turn = ((-angle * 180) / Math.PI).toFixed(2);
    const rx = Math.max(a * this.camera.zoom, 1.5).toFixed(2);
    const ry = Math.max(b * this.camera.zoom, 1.5).toFixed(2);
    this.parts.push(
      `<ellipse rx="${rx}" ry="${ry}" transform="translate(${px.toFixed(2)} ${py.toFixed(2)}) rotate(${turn})" ${this.attributes(style)}/>`);
  }
  text(x, y, right, up, words, style) {
    const [px, py] = this.camera.toScreen(x, y);
    const halo = style.halo ? ` stroke="${style.halo}" stroke-width="3" paint-order="stroke"` : '';
    this.parts.push(
      `<text x="${(px + right).toFixed(2)}" y="${(py - up).toFixed(2)}" font-size="${style.size ?? 12}" dominant-baseline="middle" fill="${style.fill}"${halo}>${escaped(words)}</text>`);
  }
  // The whole file.
  document(ground) {
    const { width, height } = this.camera;
    return `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, DejaVu Sans, sans-serif">\n<rect width="100%" height="100%" fill="${ground}"/>\n${this.parts.join('\n')}\n</svg>\n`;
  }
}
