/**
 * Flights around no-fly areas, as the planner measures them: straight where nothing is in the way,
 * else by the quickest way along corners of areas. Points are `[x, y]` in metres, y northwards.
 */

import { distance } from './geometry.js';

/** How near to an edge, in metres, still counts as on it. */
const TOUCH_M = 0.01;

/** The air that flights of one airspeed move through. */
export class Airspace {
  /**
   * @param rings no-fly areas, each a list of corners
   * @param wind `{speed_kmh, direction_deg}`, where it comes from, clockwise from north
   * @param airspeedKmh speed of the drones
   */
  constructor(rings, wind, airspeedKmh) {
    this.rings = rings;
    const direction = ((wind?.direction_deg ?? 0) * Math.PI) / 180;
    const speed = (wind?.speed_kmh ?? 0) / 3.6;
    this.wind = [-speed * Math.sin(direction), -speed * Math.cos(direction)];
    this.airspeed = airspeedKmh / 3.6;
    this.corners = rings.flatMap(convexCorners);
    this.visible = new Map();
  }

  /** Return the seconds of a straight flight, infinite against too strong a wind. */
  duration(from, to) {
    const length = distance(from, to);
    if (length === 0) return 0;
    const way = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    const across = this.wind[0] * way[1] - this.wind[1] * way[0];
    if (Math.abs(across) >= this.airspeed) return Infinity;
    const along = this.wind[0] * way[0] + this.wind[1] * way[1];
    const ground = along + Math.sqrt(this.airspeed ** 2 - across ** 2);
    return ground > 0 ? length / ground : Infinity;
  }

  /** Tell whether a straight flight would cut an area. */
  blocks(from, to) {
    return this.rings.some((ring) => cuts(ring, from, to));
  }

  /** Return the corners that a flight passes, both ends included; straight if there is no way. */
  flight(from, to) {
    if (!this.blocks(from, to)) return [from, to];
    const nodes = [from, to, ...this.corners];
    const best = nodes.map(() => Infinity);
    const before = nodes.map(() => -1);
    const open = new Set([0]);
    best[0] = 0;
    while (open.size) {
      const node = [...open].reduce((first, other) => (best[other] < best[first] ? other : first));
      open.delete(node);
      if (node === 1) break;
      for (const next of this.#seenFrom(nodes, node)) {
        const time = best[node] + this.duration(nodes[node], nodes[next]);
        if (time < best[next]) {
          [best[next], before[next]] = [time, node];
          open.add(next);
        }
      }
    }
    return before[1] < 0 ? [from, to] : trace(nodes, before);
  }

  /** Return the indices of the nodes that a straight flight from one reaches. */
  #seenFrom(nodes, node) {
    const sees = (other) => other !== node && !this.blocks(nodes[node], nodes[other]);
    const indices = [...nodes.keys()];
    if (node < 2) return indices.filter(sees);
    if (!this.visible.has(node)) this.visible.set(node, indices.slice(2).filter(sees));
    return sees(1) ? [1, ...this.visible.get(node)] : this.visible.get(node);
  }
}

function trace(nodes, before) {
  const points = [];
  for (let node = 1; node >= 0; node = before[node]) points.unshift(nodes[node]);
  return points;
}

/** Return the corners of an area where shortest ways may bend. */
function convexCorners(ring) {
  const corners = openRing(ring);
  const orientation = Math.sign(signedArea(corners));
  return corners.filter((corner, index) => {
    const before = corners[(index + corners.length - 1) % corners.length];
    const after = corners[(index + 1) % corners.length];
    const turn =
      (corner[0] - before[0]) * (after[1] - corner[1]) -
      (corner[1] - before[1]) * (after[0] - corner[0]);
    return turn * orientation > 0;
  });
}

function openRing(ring) {
  const [first, last] = [ring[0], ring[ring.length - 1]];
  return first[0] === last[0] && first[1] === last[1] ? ring.slice(0, -1) : ring;
}

function signedArea(ring) {
  return (
    ring.reduce((sum, [x, y], index) => {
      const [nextX, nextY] = ring[(index + 1) % ring.length];
      return sum + x * nextY - nextX * y;
    }, 0) / 2
  );
}

/** Tell whether a segment passes through the inside of an area; touching its edge is allowed. */
function cuts(ring, from, to) {
  const shares = [0, 1];
  ring.forEach((corner, index) => {
    const share = crossing(from, to, corner, ring[(index + 1) % ring.length]);
    if (share !== null) shares.push(share);
  });
  shares.sort((first, second) => first - second);
  return shares.some((share, index) => {
    if (index === 0) return false;
    const middle = (shares[index - 1] + share) / 2;
    const point = [from[0] + (to[0] - from[0]) * middle, from[1] + (to[1] - from[1]) * middle];
    return share - shares[index - 1] > 1e-12 && isInside(ring, point);
  });
}

/** Return how far along a segment it meets an edge, 0 to 1, or null. */
function crossing(from, to, start, end) {
  const way = [to[0] - from[0], to[1] - from[1]];
  const edge = [end[0] - start[0], end[1] - start[1]];
  const cross = way[0] * edge[1] - way[1] * edge[0];
  if (cross === 0) return null;
  const offset = [start[0] - from[0], start[1] - from[1]];
  const share = (offset[0] * edge[1] - offset[1] * edge[0]) / cross;
  const along = (offset[0] * way[1] - offset[1] * way[0]) / cross;
  return share > 0 && share < 1 && along >= 0 && along <= 1 ? share : null;
}

/** Tell whether a point lies inside an area, further than a hair from its edge. */
export function isInside(ring, point) {
  let inside = false;
  for (let index = 0; index < ring.length; index += 1) {
    const [start, end] = [ring[index], ring[(index + 1) % ring.length]];
    if (distanceToEdge(point, start, end) < TOUCH_M) return false;
    if (start[1] > point[1] !== end[1] > point[1]) {
      const x = start[0] + ((point[1] - start[1]) / (end[1] - start[1])) * (end[0] - start[0]);
      if (point[0] < x) inside = !inside;
    }
  }
  return inside;
}

function distanceToEdge(point, start, end) {
  const edge = [end[0] - start[0], end[1] - start[1]];
  const square = edge[0] ** 2 + edge[1] ** 2;
  const along =
    square === 0 ? 0 : ((point[0] - start[0]) * edge[0] + (point[1] - start[1]) * edge[1]) / square;
  const share = Math.min(Math.max(along, 0), 1);
  return distance(point, [start[0] + edge[0] * share, start[1] + edge[1] * share]);
}
