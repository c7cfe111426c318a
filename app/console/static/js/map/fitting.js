/** Bringing a whole plan into view, its ways included, with nothing below what lies on the map. */

import { boundsOf } from '../core/geometry.js';
import { leaflet } from '../libraries.js';
import { latLng } from './layers.js';

const L = leaflet();
const EDGE = 36; // pixels around it
const CLEAR = { x: 40, y: 16 }; // pixels around what lies on the map: half a label and more

/** What lies on the map and hides what is below it. */
const OVER = '.draw-bar button, .map-tools, .leaflet-control, .map-legend, .map-title';

/** What may lie over a part of it, and reaches beyond it. */
const BESIDE = '.panel, .details';

/** Show all of some lines of places `[x, y]`, single places among them, no closer than `most`. */
export function fitWhole(map, lines, most = Infinity) {
  const whole = boundsOf(lines.flat());
  if (!whole) return;
  const [west, south, east, north] = whole;
  const bounds = L.latLngBounds([[south, west], [north, east]]);
  const views = paddingsFor(map).map((padding) => viewOf(map, bounds, padding, most));
  // The closest first; where two are as close, that which leaves the plan in the middle.
  views.sort((one, other) => other.zoom - one.zoom || one.padded - other.padded);
  const flat = flattened(map, lines);
  const over = overOn(map);
  const best = views.find((view) => isClear(map, flat, view, over)) ?? views[0];
  map.setView(best.center, best.zoom, { animate: false });
}

/** Tell whether all of some lines is in view, and nothing lies on it, or none of what is large. */
export function isSeen(map, lines, isLarge = false) {
  const view = { center: map.getCenter(), zoom: map.getZoom() };
  return isClear(map, flattened(map, lines), view, overOn(map, isLarge));
}

/** Return lines in pixels of zoom 0, of which those of any zoom are multiples. */
function flattened(map, lines) {
  return lines.map((line) => line.map((place) => map.project(latLng(place), 0)));
}

/** Return the view `{center, zoom, padded}` of a region with room `[left, top, right, bottom]`. */
function viewOf(map, bounds, [left, top, right, bottom], most) {
  const room = L.point(left + right, top + bottom);
  const zoom = Math.min(map.getBoundsZoom(bounds, false, room), most);
  const [start, end] = [bounds.getSouthWest(), bounds.getNorthEast()].map((corner) =>
    map.project(corner, zoom));
  const middle = start.add(end).add([right - left, bottom - top]).divideBy(2);
  return { zoom, center: map.unproject(middle, zoom), padded: left + top + right + bottom };
}

/** Tell whether lines would be seen whole in a view, with nothing on them. */
function isClear(map, flat, { center, zoom }, over) {
  const size = map.getSize();
  const factor = map.getZoomScale(zoom, 0);
  const corner = map.project(center, zoom).subtract(size.divideBy(2));
  const inside = L.bounds([0, 0], size);
  return flat.every((line) => {
    const points = line.map((point) => point.multiplyBy(factor).subtract(corner));
    return points.every((point) => inside.contains(point))
      && over.every((box) => !touches(points, box));
  });
}

function touches(points, box) {
  return points.some((point, index) =>
    index ? L.LineUtil.clipSegment(points[index - 1], point, box) : box.contains(point));
}

/** Return where something lies on a map, in pixels from its corner. */
export function overOn(map, isLarge = false, clear = CLEAR) {
  const frame = map.getContainer().getBoundingClientRect();
  const over = isLarge ? [] : map.getContainer().parentElement.querySelectorAll(OVER);
  return [...over, ...document.querySelectorAll(BESIDE)]
    .map((element) => ({
      aside: element.matches(BESIDE) ? clear.y : clear.x, box: element.getBoundingClientRect() }))
    .filter(({ box: { width, height } }) => width && height)
    .filter(({ box: { left, top, right, bottom } }) => right > frame.left && left < frame.right
      && bottom > frame.top && top < frame.bottom)
    .map(({ aside, box: { left, top, right, bottom } }) => L.bounds(
      [left - frame.left - aside, top - frame.top - clear.y],
      [right - frame.left + aside, bottom - frame.top + clear.y]));
}

/**
 * Return the paddings, from the left on, that keep clear of nothing, or of all by some side.
 *
 * @returns {Bounds[]}
 */
function paddingsFor(map) {
  const size = map.getSize();
  /** @type {number[][]} */
  let paddings = [[EDGE, EDGE, EDGE, EDGE]];
  for (const { min, max } of overOn(map)) {
    const sides = [max.x, max.y, size.x - min.x, size.y - min.y];
    // The nearer of left and right, and of top and bottom.
    const near = [sides[0] < sides[2] ? 0 : 2, sides[1] < sides[3] ? 1 : 3];
    paddings = paddings.flatMap((padding) => [
      padding,
      ...near.map((side) =>
        padding.map((edge, index) => (index === side ? Math.max(edge, sides[side]) : edge)))]);
    paddings = [...new Map(paddings.map((padding) => [String(padding), padding])).values()];
  }
  return /** @type {Bounds[]} */ (paddings);
}
