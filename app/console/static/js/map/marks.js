/** How customers look on the map. */

import { leaflet } from '../libraries.js';

const L = leaflet();
const BETWEEN = 160; // pixels between chevrons
const ROOM = 0.6; // a stretch of the rest of those has one
const CHEVRON = 5; // pixels
const MOST_DISCS = 2000; // pictures kept

const discs = new Map();

/** A customer as a disc, copied from a picture of its style, as there may be thousands. */
export const Disc = L.CircleMarker.extend({
  _updatePath() {
    const renderer = this._renderer;
    if (!renderer._drawing || this._empty()) return;
    const { x, y } = this._point;
    const half = halfOf(this.options);
    // Lines leave theirs behind; how strong a disc is, its picture has.
    renderer._ctx.globalAlpha = 1;
    renderer._ctx.drawImage(discOf(this.options), x - half, y - half, 2 * half, 2 * half);
  },
});

/** A customer that nobody serves: a cross, so that it is told by shape too. */
export const Cross = L.CircleMarker.extend({
  _updatePath() {
    const renderer = this._renderer;
    if (!renderer._drawing || this._empty()) return;
    const { _ctx: context } = renderer;
    const { x, y } = this._point;
    const size = this._radius * 0.75;
    context.beginPath();
    context.moveTo(x - size, y - size);
    context.lineTo(x + size, y + size);
    context.moveTo(x + size, y - size);
    context.lineTo(x - size, y + size);
    renderer._fillStroke(context, this);
  },
});

/** A way whose direction small chevrons tell, where its stretches have room for them. */
export const Way = L.Polyline.extend({
  _updatePath() {
    L.Polyline.prototype._updatePath.call(this);
    const { _ctx: context, _drawing: isDrawing } = this._renderer;
    if (!isDrawing || !this._parts.length) return;
    Object.assign(context, {
      globalAlpha: this.options.opacity, strokeStyle: this.options.color, lineWidth: 2,
    });
    context.setLineDash([]);
    context.beginPath();
    for (const part of this._parts) pointAlong(context, part);
    context.stroke();
  },
});

/** Add chevrons to a path, one at the middle of a stretch that is long enough, or several. */
function pointAlong(context, part) {
  for (let index = 1; index < part.length; index += 1) {
    const [from, to] = [part[index - 1], part[index]];
    const length = from.distanceTo(to);
    const count = Math.floor(length / BETWEEN + ROOM);
    const [x, y] = [(to.x - from.x) / length, (to.y - from.y) / length];
    for (let at = 1; at <= count; at += 1) {
      const far = ((at - 0.5) * length) / count + CHEVRON / 2;
      const tip = { x: from.x + x * far, y: from.y + y * far };
      context.moveTo(tip.x - CHEVRON * (x + y * 0.8), tip.y - CHEVRON * (y - x * 0.8));
      context.lineTo(tip.x, tip.y);
      context.lineTo(tip.x - CHEVRON * (x - y * 0.8), tip.y - CHEVRON * (y + x * 0.8));
    }
  }
}

/** Return half of the side of a disc's picture in pixels, whole ones so that it stays sharp. */
function halfOf({ radius, weight }) {
  return Math.ceil(radius + weight / 2) + 1;
}

/** Return the picture of a disc. */
function discOf(style) {
  const { radius, weight, color, opacity, fillColor, fillOpacity } = style;
  const key = [radius, weight, color, opacity, fillColor, fillOpacity].join();
  if (!discs.has(key)) {
    if (discs.size >= MOST_DISCS) discs.clear();
    discs.set(key, drawnDisc(style));
  }
  return discs.get(key);
}

function drawnDisc(style) {
  const half = halfOf(style);
  const scale = Math.ceil(window.devicePixelRatio || 1);
  const picture = document.createElement('canvas');
  picture.width = 2 * half * scale;
  picture.height = picture.width;
  const context = picture.getContext('2d');
  context.scale(scale, scale);
  context.beginPath();
  context.arc(half, half, style.radius, 0, 2 * Math.PI);
  context.globalAlpha = style.fillOpacity;
  context.fillStyle = style.fillColor;
  context.fill();
  context.globalAlpha = style.opacity;
  context.strokeStyle = style.color;
  context.lineWidth = style.weight;
  context.stroke();
  return picture;
}
