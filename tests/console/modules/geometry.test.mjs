import assert from 'node:assert/strict';
import test from 'node:test';
import { Airspace } from '../../../app/console/static/js/core/detour.js';
import {
  distanceToLine,
  lengthOf,
  nearestLine,
  planeOf,
  pointAlong,
} from '../../../app/console/static/js/core/geometry.js';

const SQUARE = [
  [10, -10],
  [30, -10],
  [30, 10],
  [10, 10],
];
const calm = (rings) => new Airspace(rings, { speed_kmh: 0 }, 60);

test('a clear flight is straight', () => {
  assert.deepEqual(calm([SQUARE]).flight([0, 20], [40, 20]), [
    [0, 20],
    [40, 20],
  ]);
});

test('a flight along an edge touches and does not cut', () => {
  assert.deepEqual(calm([SQUARE]).flight([0, 10], [40, 10]), [
    [0, 10],
    [40, 10],
  ]);
  assert.deepEqual(calm([SQUARE]).flight([10, -10], [30, -10]), [
    [10, -10],
    [30, -10],
  ]);
});

test('a flight that an area blocks bends at its corners, by the shortest way', () => {
  const flown = calm([SQUARE]).flight([0, 1], [40, 1]);
  assert.deepEqual(flown, [
    [0, 1],
    [10, 10],
    [30, 10],
    [40, 1],
  ]);
  assert.ok(Math.abs(lengthOf(flown) - (20 + 2 * Math.hypot(10, 9))) < 1e-9);
});

test('a diagonal through opposite corners is blocked', () => {
  assert.ok(calm([SQUARE]).blocks([0, -20], [40, 20]));
});

test('in wind the quicker way around is flown, though it may be the longer', () => {
  const long = [
    [10, -10],
    [30, -10],
    [30, 9],
    [10, 9],
  ];
  const ways = [9, -10].map((y) => [
    [0, 0],
    [10, y],
    [30, y],
    [40, -20],
  ]);
  for (const direction of [0, 45, 90, 135, 180, 225, 270, 315]) {
    const airspace = new Airspace([long], { speed_kmh: 40, direction_deg: direction }, 60);
    const timeOf = (way) =>
      way.slice(1).reduce((sum, point, at) => sum + airspace.duration(way[at], point), 0);
    const flown = timeOf(airspace.flight([0, 0], [40, -20]));
    assert.ok(flown <= Math.min(...ways.map(timeOf)) + 1e-9);
  }
});

test('too strong a wind is no flight, and a tail wind is faster', () => {
  const windy = new Airspace([], { speed_kmh: 30, direction_deg: 270 }, 60);
  assert.ok(windy.duration([0, 0], [100, 0]) < windy.duration([100, 0], [0, 0]));
  const stormy = new Airspace([], { speed_kmh: 80, direction_deg: 270 }, 60);
  assert.equal(stormy.duration([100, 0], [0, 0]), Infinity);
});

test('a point along a line is found by its share of the way', () => {
  assert.deepEqual(
    pointAlong(
      [
        [0, 0],
        [10, 0],
        [10, 10],
      ],
      0.75,
    ),
    [10, 5],
  );
  assert.deepEqual(pointAlong([[3, 4]], 0.5), [3, 4]);
});

test('degrees become metres and back', () => {
  const request = {
    coordinate_system: 'geographic',
    depots: [{ location: [8.5, 47] }],
    customers: [{ location: [8.5, 48] }],
  };
  const { toPlane, fromPlane } = planeOf(request);
  const [south, north] = [
    [8.5, 47],
    [8.5, 48],
  ].map(toPlane);
  assert.ok(Math.abs(north[1] - south[1] - 111195) < 10);
  const again = fromPlane(toPlane([8.6, 47.3]));
  assert.ok(Math.hypot(again[0] - 8.6, again[1] - 47.3) < 1e-9);
});

test('a point is as far from a line as from its nearest place', () => {
  const line = [[0, 0], [10, 0], [10, 10]];
  assert.equal(distanceToLine([5, 3], line), 3);
  assert.equal(distanceToLine([13, 14], line), 5);
  assert.equal(distanceToLine([-3, -4], line), 5);
  assert.equal(distanceToLine([3, 4], [[0, 0], [0, 0]]), 5);
  assert.equal(distanceToLine([3, 4], [[0, 0]]), 5);
  assert.equal(distanceToLine([3, 4], []), Infinity);
});

test('of several lines the nearest is pointed at, if it is near enough', () => {
  const lines = [[], [[0, 0], [10, 0]], [[10, 0], [10, 10]], [[10, 10], [0, 0]]];
  assert.equal(nearestLine([4, 1], lines), 1);
  assert.equal(nearestLine([9, 6], lines), 2);
  assert.equal(nearestLine([5, 6], lines), 3);
  assert.equal(nearestLine([4, -9], lines, 8), -1);
  assert.equal(nearestLine([0, 0], []), -1);
});
