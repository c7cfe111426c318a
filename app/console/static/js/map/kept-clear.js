/** What names on the map keep clear of: the plan, and what lies over the map. */

import { overOn } from './fitting.js';

const STEP = 8; // pixels from point to point of a line
const AROUND = [-12, 0, 12]; // pixels around a label
const STRIDE = 12; // pixels from point to point of an edge
const BESIDE = 7; // pixels from the middle of a name to its edges
const ABOVE = 17; // pixels from a place to the label of its trip

/** Return points of the map where a view draws lines, marks and labels, and of `names` there. */
export function pointsOn({ map, entries, labels, numbers }, names = []) {
  const points = [];
  for (const { layer, base } of entries) {
    if (layer.getLatLng) points.push(pointAt(map, layer));
    else if (base.opacity) addLine(layer, points);
  }
  for (const group of [labels, numbers]) {
    group.eachLayer((label) => {
      const [x, y] = pointAt(map, label);
      const above = label.options.icon.options.className.includes('trip-mark') ? ABOVE : 0;
      points.push(...AROUND.map((aside) => [x + aside, y - above]));
    });
  }
  for (const { x, y, width } of names) {
    points.push(...upTo(x - width / 2, x + width / 2).flatMap((along) => [
      [along, y - BESIDE], [along, y + BESIDE]]));
  }
  return [...points, ...edgesOver(map)];
}

function upTo(from, to) {
  return Array.from({ length: Math.ceil((to - from) / STRIDE) }, (_, step) => from + step * STRIDE);
}

/** Return points along the edges of what lies over a map. */
function edgesOver(map) {
  const { x: left, y: top } = map.containerPointToLayerPoint([0, 0]);
  return overOn(map, false, { x: 0, y: 0 }).flatMap(({ min, max }) => [
    ...upTo(min.y, max.y).flatMap((y) => [[min.x, y], [max.x, y]]),
    ...upTo(min.x, max.x).flatMap((x) => [[x, min.y], [x, max.y]]),
  ]).map(([x, y]) => [x + left, y + top]);
}

function pointAt(map, layer) {
  const { x, y } = map.latLngToLayerPoint(layer.getLatLng());
  return [x, y];
}

/** Add points along what of a line is near the part of the map that is seen. In place. */
function addLine(layer, points) {
  // Clipped already as the line is drawn; nothing else tells its points in pixels.
  for (const part of layer._parts ?? []) {
    for (let index = 1; index < part.length; index += 1) {
      const [from, to] = [part[index - 1], part[index]];
      const steps = Math.ceil(from.distanceTo(to) / STEP);
      for (let step = 0; step < steps; step += 1) {
        const share = step / steps;
        points.push([from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share]);
      }
    }
  }
}
