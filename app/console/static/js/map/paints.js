/** How streets, water and green are painted: quietly, so that the plan stands out. */

const BASE_ZOOM = 15;

/** How the width of lines grows from zoom to zoom, below and above the base zoom. */
const [GROWTH_BELOW, GROWTH_ABOVE] = [1.3, 1.5];

const LEAST_WIDTH = 0.5;
const EDGE = 0.8; // pixels on each side of a street
const EDGES_FROM = 14;

/**
 * Areas in their order: kind and `[light, dark]`.
 *
 * @type {[string, string[]][]}
 */
const AREAS = [
  ['sea', ['#c5dcec', '#14324a']], ['green', ['#dbe9d2', '#1c3227']],
  ['sand', ['#f1e8cf', '#2b2a22']], ['water', ['#c5dcec', '#14324a']],
  ['square', ['#ebe9e6', '#1f262e']], ['building', ['#e2deda', '#252f39']]];

/**
 * Lines in their order: kind, pixels at the base zoom, `[light, dark]`, and those of its edges.
 *
 * @type {[string, number, string[], string[]?][]}
 */
const LINES = [
  ['border', 1, ['#c3bfc9', '#4a5260']],
  ['stream', 0.8, ['#b4d2e8', '#1d4260']],
  ['river', 2, ['#c5dcec', '#14324a']],
  ['path', 0.7, ['#cfc7bb', '#303a43']],
  ['service', 1.1, ['#ffffff', '#35414d'], ['#d9d6d1', '#1a2129']],
  ['street', 2.2, ['#ffffff', '#3d4a57'], ['#d3d0ca', '#1a2129']],
  ['main', 3.2, ['#ffffff', '#475563'], ['#cbc7c0', '#1a2129']],
  ['primary', 3.8, ['#fdf0cf', '#546474'], ['#d9c795', '#1a2129']],
  ['motorway', 4.6, ['#f9dda8', '#627486'], ['#d3b06c', '#1a2129']],
  ['tram', 0.7, ['#c3bfc6', '#3a424b']],
  ['rail', 1.3, ['#b3b0b6', '#3f4750']]];

const LINE_WIDTHS = Object.fromEntries(LINES.map(([kind, width]) => [kind, width]));

/** Return how wide lines of a kind are at a zoom, in pixels. */
export function widthOf(kind, zoom) {
  const growth = zoom < BASE_ZOOM ? GROWTH_BELOW : GROWTH_ABOVE;
  return Math.max(LINE_WIDTHS[kind] * growth ** (zoom - BASE_ZOOM), LEAST_WIDTH);
}

/**
 * Paint what a tile shows.
 *
 * @param shapes a path for each kind
 * @param options `zoom`, `pixel`, which is the length of one as the context measures, and `dark`
 */
export function paint(context, shapes, { zoom, pixel, dark }) {
  const tint = Number(dark);
  context.lineJoin = 'round';
  context.lineCap = 'round';
  for (const [kind, colours] of AREAS) {
    context.fillStyle = colours[tint];
    if (shapes[kind]) context.fill(shapes[kind]);
  }
  const stroke = (kind, width, colour) => {
    context.lineWidth = width * pixel;
    context.strokeStyle = colour;
    context.stroke(shapes[kind]);
  };
  const lines = LINES.filter(([kind]) => shapes[kind]);
  for (const [kind, , , edges] of zoom >= EDGES_FROM ? lines : []) {
    if (edges) stroke(kind, widthOf(kind, zoom) + 2 * EDGE, edges[tint]);
  }
  for (const [kind, , colours] of lines) stroke(kind, widthOf(kind, zoom), colours[tint]);
}

/** Return a path for each kind of a tile's content (see `app/maps/streets/cutting.py`). */
export function shapesOf(content) {
  return Object.fromEntries(
    Object.entries(content).map(([kind, lines]) => [kind, pathOf(lines)]));
}

function pathOf(lines) {
  const path = new Path2D();
  for (const line of lines) {
    let [x, y] = line;
    path.moveTo(x, y);
    for (let index = 2; index < line.length; index += 2) {
      x += line[index];
      y += line[index + 1];
      path.lineTo(x, y);
    }
  }
  return path;
}
