/** Streets, water and green under the plan, drawn from an extract that the service has. */

import { getTile } from '../api.js';
import { leaflet } from '../libraries.js';
import { paint, shapesOf } from './paints.js';

const L = leaflet();

const TILE_PIXELS = 512;
const STEPS = 4096; // in which tiles count, along each side
const ZOOMS = Array.from({ length: 15 }, (_, zoom) => zoom); // of tiles; the last is enlarged
const USUAL_ZOOM = 1; // by how much the map's zoom is more than that of tiles so large
const SHARPNESS = 1.25; // what zooming between two whole zooms enlarges by
const MOST_SHARPNESS = 2;

/**
 * A layer of the streets of one extract, `{name, bounds}` as the service configures it.
 *
 * Of tiles there may be some `zooms` alone.
 */
export const StreetsLayer = L.GridLayer.extend({
  options: { tileSize: TILE_PIXELS, minZoom: 5, maxZoom: 22, zooms: ZOOMS },

  initialize({ name, bounds: [west, south, east, north] }, options) {
    const bounds = [
      [south, west],
      [north, east]];
    L.setOptions(this, { ...options, bounds });
    this.name = name;
    this.dark = false;
    this.shapes = new Map(); // what tiles show, and their names, by their place
    this.names = new Map();
    this.tiles = new Map(); // `{repaint, zoom, place}` by the canvas of a tile that is there
    this.on('tileunload', ({ tile }) => this.tiles.delete(tile));
  },

  /** Draw in light or dark; tiles stay, since asking anew for them shows nothing meanwhile. */
  setDark(dark) {
    if (dark === this.dark) return;
    this.dark = dark;
    this.tiles.forEach(({ repaint }) => repaint());
  },

  createTile({ x, y, z }, done) {
    const canvas = document.createElement('canvas');
    const sharpness = Math.min(window.devicePixelRatio * SHARPNESS, MOST_SHARPNESS);
    canvas.width = Math.round(TILE_PIXELS * sharpness);
    canvas.height = canvas.width;
    const zoom = z - USUAL_ZOOM;
    const deeper = zoom - this.options.zooms.findLast((there) => there <= zoom);
    const [column, row] = [x >> deeper, y >> deeper];
    const [left, top] = [x - (column << deeper), y - (row << deeper)];
    const scale = (canvas.width * 2 ** deeper) / STEPS;
    const place = `${zoom - deeper}/${column}/${row}`;
    let shapes = {};
    const repaint = () => {
      const context = canvas.getContext('2d');
      context.resetTransform();
      context.clearRect(0, 0, canvas.width, canvas.height);
      context.setTransform(scale, 0, 0, scale, -left * canvas.width, -top * canvas.width);
      paint(context, shapes, { zoom: z, pixel: sharpness / scale, dark: this.dark });
    };
    this.tiles.set(canvas, { repaint, zoom: z, place });
    this._shapes(place).then(
      (found) => {
        shapes = found;
        repaint();
        done(null, canvas);
        this.fire('named');
      },
      (error) => done(error, canvas));
    return canvas;
  },

  /** Return the names of what is on the map: `{zoom, column, row, names}` of each tile. */
  named() {
    const places = new Set();
    for (const { zoom, place } of this.tiles.values()) {
      if (zoom === this._tileZoom) places.add(place);
    }
    return [...places].flatMap((place) => {
      const [zoom, column, row] = place.split('/').map(Number);
      const names = this.names.get(place) ?? [];
      return names.length ? [{ zoom, column, row, names }] : [];
    });
  },

  /** Return what a tile of the extract shows, which is fetched once. */
  _shapes(place) {
    if (!this.shapes.has(place)) {
      const fetched = getTile(`${this.name}/${place}`).then(({ names = [], ...content }) => {
        this.names.set(place, names);
        return shapesOf(content);
      });
      // Who comes by again asks again.
      fetched.catch(() => this.shapes.delete(place));
      this.shapes.set(place, fetched);
    }
    return this.shapes.get(place);
  },
});
