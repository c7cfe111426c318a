/**
 * Where names of streets are written: along straight stretches, without touching each other, and
 * beside their street where the plan's lines or marks are on it.
 */

const REPEAT = 360; // pixels from a name along its street to the same name again
const SAME = 220; // pixels that the same names keep from each other wherever they are
export const GAP = 8; // pixels around a name
const BEND = 2.5; // pixels that a street may leave the straight line of its name by
const TRIES = [0, -0.5, 0.5, -1, 1, -1.5, 1.5]; // widths of a name that it may be moved along
const SIDES = [0, -1, 1]; // of a street
const BESIDE = 15; // pixels from a street to the middle of a name beside it
const CLEAR = 9; // pixels from the middle of a name to what it keeps clear of
const CELL = 64; // pixels

/**
 * Return where names stand: `{text, x, y, angle, kind, width}`, angles from -90 to 90 degrees in
 * radians.
 *
 * @param ways `{text, kind, line, width}`, lines in pixels, those that matter most first
 * @param frame `[left, top, right, bottom]` that is seen
 * @param kept points `[x, y]` that are kept clear
 */
export function placeNames(ways, frame, kept = []) {
  const taken = new Taken(kept);
  const placed = [];
  for (const { text, kind, line, width } of ways) {
    const stations = along(line);
    const length = stations[stations.length - 1];
    const times = Math.floor(Math.max(length / REPEAT, 1));
    for (let time = 0; length >= width + GAP && time < times; time += 1) {
      const middle = ((time + 0.5) * length) / times;
      const place = firstFree(line, stations, middle, width, (spot) =>
        isWithin(spot, width, frame) && taken.isFree(text, spot, width));
      if (place) {
        taken.take(text, place, width);
        placed.push({ text, kind, width, ...place });
      }
    }
  }
  return placed;
}

/** Return how far along a line each of its points is. */
function along(line) {
  let sum = 0;
  return line.map(([x, y], index) => {
    if (index) sum += Math.hypot(x - line[index - 1][0], y - line[index - 1][1]);
    return sum;
  });
}

/** Return the place nearest to a point of the line where a name fits, or null. */
function firstFree(line, stations, middle, width, isFree) {
  const length = stations[stations.length - 1];
  const spots = TRIES.flatMap((shift) => {
    const start = middle + (shift - 0.5) * width;
    if (start < 0 || start + width > length) return [];
    return spotOf(line, stations, start, start + width) ?? [];
  });
  for (const side of SIDES) {
    for (const spot of spots) {
      const beside = aside(spot, side * BESIDE);
      if (isFree(beside)) return beside;
    }
  }
  return null;
}

function aside({ x, y, angle }, far) {
  return { x: x - Math.sin(angle) * far, y: y + Math.cos(angle) * far, angle };
}

/** Return the middle and angle of a stretch of a line, or null if it isn't straight. */
function spotOf(line, stations, from, until) {
  const [[x, y], [endX, endY]] = [pointAt(line, stations, from), pointAt(line, stations, until)];
  const chord = Math.hypot(endX - x, endY - y);
  const isStraight = line.every((point, index) =>
    stations[index] <= from || stations[index] >= until
      || Math.abs((endX - x) * (point[1] - y) - (endY - y) * (point[0] - x)) <= BEND * chord);
  if (!isStraight || chord < 0.95 * (until - from)) return null;
  const angle = Math.atan2(endY - y, endX - x);
  const upright = Math.abs(angle) > Math.PI / 2 ? angle - Math.sign(angle) * Math.PI : angle;
  return { x: (x + endX) / 2, y: (y + endY) / 2, angle: upright };
}

/** Return the point of a line so far along it. */
function pointAt(line, stations, station) {
  let low = 0;
  let high = stations.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (stations[middle] <= station) low = middle;
    else high = middle;
  }
  const [[x, y], [nextX, nextY]] = [line[low], line[high]];
  const share = (station - stations[low]) / (stations[high] - stations[low] || 1);
  return [x + (nextX - x) * share, y + (nextY - y) * share];
}

function isWithin({ x, y }, width, [left, top, right, bottom]) {
  const half = width / 2;
  return x > left - half && x < right + half && y > top - half && y < bottom + half;
}

/** What has been written, as points along each name, and what is kept clear. */
class Taken {
  constructor(kept) {
    this.kept = new Cells();
    kept.forEach((point) => this.kept.add(point));
    this.written = new Cells();
    this.middles = new Map(); // by text
  }

  isFree(text, spot, width) {
    const others = this.middles.get(text) ?? [];
    return others.every(({ x, y }) => Math.hypot(x - spot.x, y - spot.y) > SAME)
      && pointsOf(spot, width).every((point) =>
        !this.kept.hasNear(point, CLEAR) && !this.written.hasNear(point, 2 * GAP));
  }

  take(text, spot, width) {
    if (!this.middles.has(text)) this.middles.set(text, []);
    this.middles.get(text).push(spot);
    pointsOf(spot, width).forEach((point) => this.written.add(point));
  }
}

/** Points, found by where they are. */
class Cells {
  constructor() {
    this.cells = new Map();
  }

  /** @param {Point} point */
  add([x, y]) {
    const key = `${Math.floor(x / CELL)}/${Math.floor(y / CELL)}`;
    if (!this.cells.has(key)) this.cells.set(key, []);
    this.cells.get(key).push([x, y]);
  }

  /**
   * Tell whether there is a point at most so far, less than a cell, from another.
   *
   * @param {Point} point
   * @param {number} far
   */
  hasNear([x, y], far) {
    const [left, right] = [x - far, x + far].map((edge) => Math.floor(edge / CELL));
    const [top, bottom] = [y - far, y + far].map((edge) => Math.floor(edge / CELL));
    for (let column = left; column <= right; column += 1) {
      for (let row = top; row <= bottom; row += 1) {
        const inside = this.cells.get(`${column}/${row}`) ?? [];
        if (inside.some(([otherX, otherY]) => Math.hypot(x - otherX, y - otherY) <= far))
          return true;
      }
    }
    return false;
  }
}

/** @returns {Point[]} */
function pointsOf({ x, y, angle }, width) {
  const count = Math.max(Math.ceil(width / GAP), 1);
  return Array.from({ length: count + 1 }, (_, index) => {
    const far = (index / count - 0.5) * width;
    return [x + Math.cos(angle) * far, y + Math.sin(angle) * far];
  });
}
