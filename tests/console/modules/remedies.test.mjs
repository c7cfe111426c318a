import assert from 'node:assert/strict';
import test from 'node:test';

import { groupUnassigned } from '../../../app/console/static/js/core/remedies.js';

const request = {
  customers: ['A', 'B', 'C', 'D', 'E'].map((id) => ({
    id,
    demand: [5],
    skills: [],
    time_window: { latest: 600 },
  })),
  fleet: [
    { id: 'van', count: 1, capacity: [9], max_trip_distance: 1000 },
    { id: 'bike', count: 2, capacity: [2] },
  ],
};

const because = (id, ...reasons) => ({
  id,
  reasons: reasons.map(([vehicle_type, code, remedy]) => ({
    vehicle_type,
    code,
    remedy,
    message: code,
  })),
});

test('each customer is in one group, the largest with a remedy first', () => {
  const groups = groupUnassigned(request, [
    because('A', ['van', 'DISTANCE', 'fits if trips could be 3.0 km longer'],
      ['bike', 'CAPACITY', 'fits if capacity were at least 5']),
    because('B', ['van', 'DISTANCE', 'fits if trips could be 7.5 km longer']),
    because('C', ['bike', 'CAPACITY', 'fits if capacity were at least 5']),
    because('D', ['van', 'SKILLS', null]),
    because('E'),
  ]);
  assert.deepEqual(
    groups.map(({ code, members }) => [code, members.map(({ customer }) => customer.id)]),
    [['DISTANCE', ['A', 'B']], ['CAPACITY', ['C']], ['SKILLS', ['D']], [undefined, ['E']]],
  );
  assert.equal(groups[2].changed, null);
});

test('what changes vehicles by so much is applied once, the largest', () => {
  const [group] = groupUnassigned(request, [
    because('A', ['van', 'DISTANCE', 'fits if trips could be 3.0 km longer']),
    because('B', ['van', 'DISTANCE', 'fits if trips could be 7.5 km longer']),
  ]);
  assert.equal(group.changed.fleet[0].max_trip_distance, 8500);
  assert.equal(group.remedy, 'fits if trips could be 7.5 km longer');
  const [more] = groupUnassigned(request, [
    because('A', ['van', 'CAPACITY', 'fits with one more vehicle']),
    because('B', ['van', 'CAPACITY', 'fits with one more vehicle']),
  ]);
  assert.equal(more.changed.fleet[0].count, 2);
  const another = 'fits if van could make another trip';
  const [again] = groupUnassigned(request, [
    because('A', ['van', 'FLEET_EXHAUSTED', another]),
    because('B', ['van', 'FLEET_EXHAUSTED', another]),
  ]);
  assert.equal(again.changed.fleet[0].max_trips, 2);
});

test('a second remedy of the same reason makes a group of its own kind', () => {
  const both = (id) => ({ id, reasons: [{ vehicle_type: 'van', code: 'FLEET_EXHAUSTED',
    message: 'all are in use', remedy: 'fits with one more vehicle',
    other_remedy: 'fits if van could make another trip' }] });
  const [group] = groupUnassigned(request, [both('A'), both('B')]);
  assert.equal(group.others.length, 1);
  assert.equal(group.others[0].remedy, 'fits if van could make another trip');
  assert.equal(group.others[0].changed.fleet[0].max_trips, 2);
});

test('what changes customers is applied to each', () => {
  const [group] = groupUnassigned(request, [
    because('A', ['van', 'TIME_WINDOW', 'fits if its window closed 10 minutes later']),
    because('B', ['van', 'TIME_WINDOW', 'fits if its window closed 20 minutes later']),
  ]);
  assert.equal(group.isForEach, true);
  assert.deepEqual(
    group.changed.customers.slice(0, 3).map((customer) => customer.time_window.latest),
    [1200, 1800, 600],
  );
});
