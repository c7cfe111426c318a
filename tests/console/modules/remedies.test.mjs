import assert from 'node:assert/strict';
import test from 'node:test';

import { applied, groupUnassigned } from '../../../app/console/static/js/core/remedies.js';

const request = {
  customers: ['A', 'B', 'C', 'D', 'E'].map((id) => ({ id, time_window: { latest: 600 } })),
  fleet: [
    { id: 'van', count: 1, capacity: [9, 1], max_trip_distance: 1000 },
    { id: 'bike', count: 2, capacity: [2, 2], vehicles: null },
  ],
};

const remedy = (code, ...changes) => ({ code, changes, suffices: true, text: code });
const longer = (by) => remedy('TRIP_DISTANCE', { path: '$.fleet[0].max_trip_distance', by });
const later = (at, by) =>
  remedy('WINDOW', { path: `$.customers[${at}].time_window.latest`, by });
const larger = (...to) => remedy('CAPACITY', { path: '$.fleet[1].capacity', to });
const several = (...parts) => ({
  ...remedy('SEVERAL', ...parts.flatMap(({ changes }) => changes)), parts });

const because = (id, ...reasons) => ({
  id,
  reasons: reasons.map(([vehicle_type, code, ...remedies]) => ({
    vehicle_type, code, remedies, message: code })),
});

const paths = ({ remedy: { parts } }) => parts.map(({ changes: [{ path, by, to }] }) =>
  [path, by ?? to]);

test('a remedy is applied as it stands, to the request that is there by now', () => {
  const by = [{ path: '$.customers[1].time_window.latest', by: 0.2 }];
  assert.equal(applied(request, by).customers[1].time_window.latest, 600.2);
  const moved = { ...request, customers: [{ id: 'new' }, ...request.customers] };
  assert.equal(applied(moved, by, request).customers[2].time_window.latest, 600.2);
  assert.equal(applied({ ...request, customers: [] }, by, request), null);
  assert.equal(applied(request, []), null);
  assert.equal(applied(request, [{ path: '$.fleet[0].max_stops', by: 1 }]), null);
  const to = [{ path: '$.fleet[1].turnaround.batteries', to: 1 }];
  assert.deepEqual(applied(request, to).fleet[1].turnaround, { batteries: 1 });
  assert.deepEqual(request.fleet[1].turnaround, undefined);
});

test('each customer is in one group, the largest with a remedy first', () => {
  const groups = groupUnassigned(request, [
    because('A', ['van', 'DISTANCE', longer(3000)], ['bike', 'CAPACITY', larger(5, 2)]),
    because('B', ['van', 'DISTANCE', longer(7500)]),
    because('C', ['bike', 'CAPACITY', larger(5, 2)]),
    because('D', ['van', 'SKILLS']),
    because('E'),
  ]);
  assert.deepEqual(
    groups.map(({ code, members }) => [code, members.map(({ customer }) => customer.id)]),
    [['DISTANCE', ['A', 'B']], ['CAPACITY', ['C']], ['SKILLS', ['D']], [undefined, ['E']]],
  );
  assert.equal(groups[2].changed, null);
});

test('what changes vehicles is applied once, by the most that any asks for', () => {
  const [group] = groupUnassigned(request, [
    because('A', ['van', 'DISTANCE', longer(3000)]), because('B', ['van', 'DISTANCE', longer(7500)]),
  ]);
  assert.equal(group.changed.fleet[0].max_trip_distance, 8500);
  assert.equal(group.isForEach, false);
  assert.deepEqual(paths(group), [['$.fleet[0].max_trip_distance', 7500]]);
  const [wide] = groupUnassigned(request, [
    because('A', ['bike', 'CAPACITY', larger(5, 2)]),
    because('B', ['bike', 'CAPACITY', larger(2, 4)]),
  ]);
  assert.deepEqual(wide.changed.fleet[1].capacity, [5, 4]);
  assert.deepEqual(paths(wide), [['$.fleet[1].capacity', [5, 4]]]);
});

test('what changes customers is applied to each', () => {
  const [group] = groupUnassigned(request, [
    because('A', ['van', 'TIME_WINDOW', later(0, 600)]),
    because('B', ['van', 'TIME_WINDOW', later(1, 1200)]),
  ]);
  assert.equal(group.isForEach, true);
  assert.deepEqual(paths(group), [['$.customers[1].time_window.latest', 1200]]);
  assert.deepEqual(
    group.changed.customers.slice(0, 3).map((customer) => customer.time_window.latest),
    [1200, 1800, 600],
  );
});

test('of several limits each is changed by the most', () => {
  const [group] = groupUnassigned(request, [
    because('A', ['van', 'DISTANCE', several(longer(3000), later(0, 60))]),
    because('B', ['van', 'DISTANCE', several(longer(2000), later(1, 90))]),
  ]);
  assert.deepEqual(paths(group), [
    ['$.fleet[0].max_trip_distance', 3000], ['$.customers[1].time_window.latest', 90]]);
  assert.equal(group.changed.fleet[0].max_trip_distance, 4000);
  assert.equal(group.changed.customers[0].time_window.latest, 660);
});

test('a second remedy of the same reason makes a group of its own kind', () => {
  const one = remedy('COUNT', { path: '$.fleet[0].count', by: 1 });
  const trip = remedy('TRIPS', { path: '$.fleet[0].max_trips', to: 2 });
  const [group] = groupUnassigned(request, ['A', 'B'].map(
    (id) => because(id, ['van', 'FLEET_EXHAUSTED', one, trip])));
  assert.equal(group.changed.fleet[0].count, 2);
  assert.deepEqual(group.others.map(({ changed }) => changed.fleet[0].max_trips), [2]);
  const [alone] = groupUnassigned(request, [
    because('A', ['van', 'FLEET_EXHAUSTED', one, trip]),
    because('B', ['van', 'FLEET_EXHAUSTED', one])]);
  assert.deepEqual(alone.others, []);
});

test('what leaves different relations can not be done together', () => {
  const free = (...to) => remedy('RELATIONS', { path: '$.relations', to });
  const groups = groupUnassigned(request, [
    because('A', ['van', 'RELATION', free({ customers: ['B', 'C'] })]),
    because('B', ['van', 'RELATION', free({ customers: ['A', 'C'] })]),
    because('C', ['van', 'RELATION', free({ customers: ['A', 'C'] })]),
  ]);
  assert.deepEqual(groups.map(({ members }) => members.length), [2, 1]);
  assert.equal(groups[0].isForEach, true);
});

test('a plan that tells no remedies as data has none', () => {
  const reason = { vehicle_type: 'van', code: 'SHIFT', message: '', remedy: 'fits' };
  const [group] = groupUnassigned(request, [{ id: 'A', reasons: [reason] }]);
  assert.equal(group.remedy, null);
});
