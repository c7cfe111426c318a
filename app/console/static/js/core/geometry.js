/** Points `[x, y]` on a plane in metres, lines of them, and arcs for flights. */

import { standsOf } from './stands.js';
import { placeOf } from './places.js';
import { visitsOf } from './visits.js';

const EARTH_RADIUS_M = 6371008.8;
const RADIANS = Math.PI / 180;

/**
 * Return functions between a request's coordinates and a plane in metres.
 *
 * Geographic coordinates are projected around their centre, which is exact enough to draw by.
 *
 * @returns {{toPlane: (place: Point) => Point, fromPlane: (place: Point) => Point}}
 */
export function planeOf(request) {
  if (request.coordinate_system !== 'geographic') {
    const unit = request.planar_unit ?? 1;
    return {
      toPlane: ([x, y]) => [x * unit, y * unit],
      fromPlane: ([x, y]) => [x / unit, y / unit],
    };
  }
  const all = [...request.depots, ...standsOf(request), ...visitsOf(request)];
  const places = all.map(placeOf).filter(Boolean);
  const [west, south, east, north] = boundsOf(places) ?? [0, 0, 0, 0];
  const origin = [(west + east) / 2, (south + north) / 2];
  const perDegree = EARTH_RADIUS_M * RADIANS;
  const shrink = Math.max(Math.cos(origin[1] * RADIANS), 1e-3);
  return {
    toPlane: ([lon, lat]) => [
      (lon - origin[0]) * perDegree * shrink,
      (lat - origin[1]) * perDegree],
    fromPlane: ([x, y]) => [x / perDegree / shrink + origin[0], y / perDegree + origin[1]],
  };
}

/**
 * Return the bounds of points, null of none.
 *
 * @param {Point[]} points
 * @returns {Bounds | null}
 */
export function boundsOf(points) {
  if (points.length === 0) return null;
  /** @type {Bounds} */
  const bounds = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) {
    bounds[0] = Math.min(bounds[0], x);
    bounds[1] = Math.min(bounds[1], y);
    bounds[2] = Math.max(bounds[2], x);
    bounds[3] = Math.max(bounds[3], y);
  }
  return bounds;
}

/** Tell whether a point lies inside a ring of corners. */
export function isInside(ring, [x, y]) {
  return ring.filter(([fromX, fromY], index) => {
    const [toX, toY] = ring[(index + 1) % ring.length];
    return fromY > y !== toY > y && x < fromX + ((y - fromY) / (toY - fromY)) * (toX - fromX);
  }).length % 2 === 1;
}

/** Return the distance of two points. */
export function distance([ax, ay], [bx, by]) {
  return Math.hypot(bx - ax, by - ay);
}

/** Return how far a point is from a line of points; infinite from none. */
export function distanceToLine(point, points) {
  let least = points.length === 1 ? distance(point, points[0]) : Infinity;
  for (let index = 1; index < points.length; index += 1) {
    least = Math.min(least, distanceToStretch(point, points[index - 1], points[index]));
  }
  return least;
}

function distanceToStretch([x, y], from, to) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = dx * dx + dy * dy;
  const share = length ? ((x - from[0]) * dx + (y - from[1]) * dy) / length : 0;
  const within = Math.min(Math.max(share, 0), 1);
  return Math.hypot(from[0] + within * dx - x, from[1] + within * dy - y);
}

/** Return which of some lines is nearest to a point, nearer than `most`; -1 if none is. */
export function nearestLine(point, lines, most = Infinity) {
  let [nearest, least] = [-1, most];
  lines.forEach((line, index) => {
    const length = distanceToLine(point, line);
    if (length < least) [nearest, least] = [index, length];
  });
  return nearest;
}

/** Return the length of a line of points. */
export function lengthOf(points) {
  let length = 0;
  for (let index = 1; index < points.length; index += 1) {
    length += distance(points[index - 1], points[index]);
  }
  return length;
}

/** Return the point that lies a share, 0 to 1, of the way along a line of points. */
export function pointAlong(points, share) {
  let left = lengthOf(points) * Math.min(Math.max(share, 0), 1);
  for (let index = 1; index < points.length; index += 1) {
    const [from, to] = [points[index - 1], points[index]];
    const step = distance(from, to);
    if (left <= step && step > 0) {
      const part = left / step;
      return [from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part];
    }
    left -= step;
  }
  return points[points.length - 1];
}
