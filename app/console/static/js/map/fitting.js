/** Bringing a whole plan into view, its ways included, with nothing below what lies on the map. */

import { boundsOf } from '../core/geometry.js';
import { leaflet } from '../libraries.js';
import { latLng } from './layers.js';

const L = leaflet();
const EDGE = 36; // pixels around it
const CLEAR = 10; // pixels around what lies on the map

/** What lies on the map and hides what is below it. */
const OVER = '.draw-bar > button, .map-tools, .leaflet-control, .map-legend, .map-title';

/** Show all of some lines of places `[x, y]`, single places among them. */
export function fitWhole(map, lines) {
  const whole = boundsOf(lines.flat());
  if (!whole) return;
  const [west, south, east, north] = whole;
  const bounds = L.latLngBounds([[south, west], [north, east]]);
  const show = ([left, top, right, bottom]) =>
    map.fitBounds(bounds, {
      paddingTopLeft: [left, top],
      paddingBottomRight: [right, bottom],
      animate: false,
    });
  const paddings = paddingsFor(map).map((padding) => ({
    padding,
    zoom: zoomFor(map, bounds, padding),
  }));
  // The closest first; where two are as close, that which leaves the plan in the middle.
  paddings.sort((one, other) => other.zoom - one.zoom || sum(one.padding) - sum(other.padding));
  for (const { padding } of paddings) {
    show(padding);
    if (isSeen(map, lines)) return;
  }
}

/** Tell whether all of some lines is in view, and nothing lies on it. */
export function isSeen(map, lines) {
  const { x, y } = map.getSize();
  const inside = L.bounds([0, 0], [x, y]);
  const over = overOn(map);
  return lines.every((line) => {
    const points = line.map((place) => map.latLngToContainerPoint(latLng(place)));
    return points.every((point) => inside.contains(point))
      && over.every((box) => !touches(points, box));
  });
}

function touches(points, box) {
  return points.some((point, index) =>
    index ? L.LineUtil.clipSegment(points[index - 1], point, box) : box.contains(point));
}

/** Return where something lies on a map, in pixels from its corner. */
function overOn(map) {
  const frame = map.getContainer().getBoundingClientRect();
  return [...map.getContainer().parentElement.querySelectorAll(OVER)]
    .map((element) => element.getBoundingClientRect())
    .filter(({ width, height }) => width && height)
    .map(({ left, top, right, bottom }) => L.bounds(
      [left - frame.left - CLEAR, top - frame.top - CLEAR],
      [right - frame.left + CLEAR, bottom - frame.top + CLEAR],
    ));
}

/** Return the paddings, from the left on, that keep clear of nothing, or of all by some side. */
function paddingsFor(map) {
  const size = map.getSize();
  let paddings = [[EDGE, EDGE, EDGE, EDGE]];
  for (const { min, max } of overOn(map)) {
    const sides = [max.x, max.y, size.x - min.x, size.y - min.y];
    // The nearer of left and right, and of top and bottom.
    const near = [sides[0] < sides[2] ? 0 : 2, sides[1] < sides[3] ? 1 : 3];
    paddings = paddings.flatMap((padding) => [
      padding,
      ...near.map((side) =>
        padding.map((edge, index) => (index === side ? Math.max(edge, sides[side]) : edge))),
    ]);
    paddings = [...new Map(paddings.map((padding) => [String(padding), padding])).values()];
  }
  return paddings;
}

function zoomFor(map, bounds, [left, top, right, bottom]) {
  return map.getBoundsZoom(bounds, false, L.point(left + right, top + bottom));
}

function sum(numbers) {
  return numbers.reduce((whole, number) => whole + number, 0);
}
