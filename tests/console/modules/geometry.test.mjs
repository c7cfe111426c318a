import assert from 'node:assert/strict';
import test from 'node:test';
import {
  distanceToLine,
  isInside,
  nearestLine,
  planeOf,
  pointAlong,
} from '../../../app/console/static/js/core/geometry.js';

test('inside of a ring is what its corners go around, closed or not', () => {
  const bay = [[0, 0], [8, 0], [8, 8], [4, 2], [0, 8]];
  for (const ring of [bay, [...bay, bay[0]]]) {
    const inside = [[4, 1], [1, 6], [4, 6], [9, 1], [-1, 1]].map((point) => isInside(ring, point));
    assert.deepEqual(inside, [true, true, false, false, false]);
  }
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
