/** Names of streets over their tiles, drawn for the whole map, so that no tile cuts them. */

import { GAP, placeNames } from '../core/street-labels.js';
import { leaflet } from '../libraries.js';
import { pointsOn } from './kept-clear.js';

const L = leaflet();
const PANE = 'street-names';
const ABOVE_STREETS = 250; // and below the plan
const MOST_SHARPNESS = 2;

/** Kinds in the order in which they are written: font, `[light, dark]`, and from which zoom. */
const KINDS = {
  stop: ['500 11px', ['#2b3540', '#d5dde5'], 0],
  place: ['600 12px', ['#59636e', '#aebac6'], 3],
  motorway: ['600 11.5px', ['#6b4d12', '#d8c08d'], 12.5],
  primary: ['600 11.5px', ['#4d5763', '#b8c4d0'], 13],
  main: ['500 11px', ['#4d5763', '#aebac6'], 14],
  street: ['500 11px', ['#59636e', '#9fabb7'], 14.5],
  path: ['italic 10.5px', ['#626b75', '#93a0ac'], 16],
  service: ['10.5px', ['#626b75', '#93a0ac'], 16],
};
const ORDER = Object.keys(KINDS);
const HALO = ['#ffffffe6', '#141a21e6'];
const HALO_WIDTH = 3;
const MOST_STOPS = 60; // that are named
const LONGEST = 26; // characters of a stop's name

/** A layer that names the streets of a `StreetsLayer` that is on the map. */
export const StreetNames = L.Renderer.extend({
  options: { pane: PANE, padding: 0.3 },

  /** @param keptClear returns the points of the map that names keep clear of */
  initialize(streets, keptClear) {
    L.Renderer.prototype.initialize.call(this, {});
    Object.assign(this, { streets, keptClear });
    this.dark = false;
    this.widths = new Map();
  },

  beforeAdd(map) {
    if (!map.getPane(PANE)) {
      const pane = map.createPane(PANE);
      pane.style.zIndex = ABOVE_STREETS;
      pane.style.pointerEvents = 'none';
    }
  },

  onAdd(map) {
    L.Renderer.prototype.onAdd.call(this, map);
    this.streets.on('named', this._drawSoon, this);
    map.on('drawn', this._drawSoon, this);
  },

  onRemove() {
    this.streets.off('named', this._drawSoon, this);
    this._map.off('drawn', this._drawSoon, this);
    L.Renderer.prototype.onRemove.call(this);
  },

  /** Write in light or dark. */
  setDark(dark) {
    this.dark = dark;
    if (this._map) this._drawSoon();
  },

  _initContainer() {
    this._container = document.createElement('canvas');
  },

  _destroyContainer() {
    cancelAnimationFrame(this.frame);
    this._container.remove();
    this._container = null;
  },

  _updatePaths() {},

  _update() {
    if (this._map._animatingZoom && this._bounds) return;
    L.Renderer.prototype._update.call(this);
    this._drawSoon();
  },

  /** Draw once before the next frame, when tiles and the plan are where they belong. */
  _drawSoon() {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this._map && this._draw());
  },

  _draw() {
    const { min, max } = this._bounds;
    const { x: width, y: height } = this._bounds.getSize();
    const sharpness = Math.min(window.devicePixelRatio || 1, MOST_SHARPNESS);
    const canvas = this._container;
    L.DomUtil.setPosition(canvas, min);
    Object.assign(canvas, { width: width * sharpness, height: height * sharpness });
    Object.assign(canvas.style, { width: `${width}px`, height: `${height}px` });
    const context = canvas.getContext('2d');
    this.family = getComputedStyle(this._map.getContainer()).fontFamily;
    const frame = [min.x, min.y, max.x, max.y];
    const ways = this._ways(context);
    this.placed = placeNames(ways, frame, ways.length ? this.keptClear() : []);
    context.setTransform(sharpness, 0, 0, sharpness, 0, 0);
    context.translate(-min.x, -min.y);
    Object.assign(context, { textAlign: 'center', textBaseline: 'middle', lineJoin: 'round' });
    for (const name of this.placed) this._write(context, name);
  },

  _write(context, { text, kind, x, y, angle }) {
    const [font, colours] = KINDS[kind];
    context.save();
    context.translate(x, y);
    context.rotate(angle);
    context.font = `${font} ${this.family}`;
    context.lineWidth = HALO_WIDTH;
    context.strokeStyle = HALO[Number(this.dark)];
    context.strokeText(text, 0, 0);
    context.fillStyle = colours[Number(this.dark)];
    context.fillText(text, 0, 0);
    context.restore();
  },

  /** Return the lines that may be named, those that matter most first, see `placeNames`. */
  _ways(context) {
    const zoom = this._map.getZoom();
    const origin = this._map.getPixelOrigin();
    const whole = this._map.options.crs.scale(zoom);
    const ways = this.streets.named().flatMap(({ zoom: depth, column, row, names }) =>
      names
        .filter(([kind]) => zoom >= KINDS[kind]?.[2])
        .flatMap(([kind, text, ...lines]) => lines.map((steps) => {
          const width = this._widthOf(context, kind, text);
          const line = pixelsOf(steps, whole / 2 ** depth, [column, row], origin);
          return { kind, text, width, line: line.length > 1 ? line : across(line[0], width) };
        })));
    const length = ({ line }) => line.length && Math.hypot(
      line[line.length - 1][0] - line[0][0], line[line.length - 1][1] - line[0][1]);
    return ways
      .map((way) => ({ ...way, length: length(way) }))
      .sort((one, other) => ORDER.indexOf(one.kind) - ORDER.indexOf(other.kind)
        || other.length - one.length);
  },

  _widthOf(context, kind, text) {
    const key = `${kind}/${text}`;
    if (!this.widths.has(key)) {
      context.font = `${KINDS[kind][0]} ${this.family}`;
      this.widths.set(key, context.measureText(text).width);
    }
    return this.widths.get(key);
  },
});

/** A layer that names the stops of a `MapView`, where they are few enough to be read. */
export const StopNames = StreetNames.extend({
  initialize(view) {
    StreetNames.prototype.initialize.call(this, new L.Evented(), () => pointsOn(view));
    this.view = view;
  },

  _ways(context) {
    const bounds = this._map.getBounds();
    const seen = this.view.entries.filter(({ layer, key }) =>
      key[0] === 'c' && bounds.contains(layer.getLatLng()));
    if (seen.length > MOST_STOPS) return [];
    return seen.map(({ key, layer }) => {
      const text = key.slice(2, 2 + LONGEST);
      const width = this._widthOf(context, 'stop', text);
      const { x, y } = this._map.latLngToLayerPoint(layer.getLatLng());
      return { kind: 'stop', text, width, line: across([x, y], width) };
    });
  },
});

/** Return the line that the name of a single place is written along. */
function across([x, y], width) {
  const half = width / 2 + GAP;
  return [[x - half, y], [x + half, y]];
}

/** Return a line of a tile in pixels of the map; see `app/maps/streets/cutting.py`. */
function pixelsOf(steps, size, [column, row], origin) {
  const points = [];
  let [x, y] = [0, 0];
  for (let index = 0; index < steps.length; index += 2) {
    x += steps[index];
    y += steps[index + 1];
    points.push([
      (column + x / 4096) * size - origin.x,
      (row + y / 4096) * size - origin.y]);
  }
  return points;
}
