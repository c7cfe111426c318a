/** Streets, water and green under the plan, drawn from an extract that the service has. */

import { getTile } from '../api.js';
import { leaflet } from '../libraries.js';
import { paint, shapesOf } from './paints.js';

const L = leaflet();

const TILE_PIXELS = 512;
const STEPS = 4096; // in which tiles count, along each side
const LAST_ZOOM = 14; // tiles of this zoom are enlarged
const USUAL_ZOOM = 1; // by how much the map's zoom is more than that of tiles so large
const SHARPNESS = 1.25; // what zooming between two whole zooms enlarges by
const MOST_SHARPNESS = 2;

/** A layer of the streets of one extract, `{name, bounds}` as the service configures it. */
export const StreetsLayer = L.GridLayer.extend({
  options: { tileSize: TILE_PIXELS, minZoom: 5, maxZoom: 22 },

  initialize({ name, bounds: [west, south, east, north] }, options) {
    const bounds = [
      [south, west],
      [north, east],
    ];
    L.setOptions(this, { ...options, bounds });
    this.name = name;
    this.dark = false;
    this.shapes = new Map();
  },

  /** Draw in light or dark. */
  setDark(dark) {
    if (dark === this.dark) return;
    this.dark = dark;
    this.redraw();
  },

  createTile({ x, y, z }, done) {
    const canvas = document.createElement('canvas');
    const sharpness = Math.min(window.devicePixelRatio * SHARPNESS, MOST_SHARPNESS);
    canvas.width = Math.round(TILE_PIXELS * sharpness);
    canvas.height = canvas.width;
    const deeper = Math.max(z - USUAL_ZOOM - LAST_ZOOM, 0);
    const [column, row] = [x >> deeper, y >> deeper];
    this._shapes(z - USUAL_ZOOM - deeper, column, row).then(
      (shapes) => {
        const context = canvas.getContext('2d');
        const [left, top] = [x - (column << deeper), y - (row << deeper)];
        const scale = (canvas.width * 2 ** deeper) / STEPS;
        context.setTransform(scale, 0, 0, scale, -left * canvas.width, -top * canvas.width);
        paint(context, shapes, { zoom: z, pixel: sharpness / scale, dark: this.dark });
        done(null, canvas);
      },
      (error) => done(error, canvas),
    );
    return canvas;
  },

  /** Return what a tile of the extract shows, which is fetched once. */
  _shapes(zoom, x, y) {
    const place = `${zoom}/${x}/${y}`;
    if (!this.shapes.has(place)) {
      this.shapes.set(place, getTile(`${this.name}/${place}`).then(shapesOf));
    }
    return this.shapes.get(place);
  },
});
