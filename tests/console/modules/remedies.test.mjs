import assert from 'node:assert/strict';
import test from 'node:test';

import { groupUnassigned } from '../../../app/console/static/js/core/remedies.js';
import { applyRemedy } from '../../../app/console/static/js/core/remedy-changes.js';

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

const MORE = {
  customers: [
    {
      id: 'A',
      demand: [1],
      alternatives: [{ id: 'kiosk', time_windows: [{ latest: 60 }, { latest: 600 }] }],
    },
    { id: 'B', demand: [1] },
  ],
  shipments: [
    {
      id: 'A',
      amount: [7],
      pickup: { time_window: { latest: 600 } },
      delivery: { time_window: { latest: 900 } },
    },
  ],
  relations: [{ kind: 'together', customers: ['A', 'B'] }],
  fleet: [
    {
      id: 'van',
      capacity: [5],
      breaks: [{ id: 'lunch', start: { latest: 3600 }, max_load: [1] }],
      driving_rules: {},
    },
  ],
};

for (const [remedy, kind, changed] of [
  ['fits if capacity were at least 7', 'shipment', ({ fleet }) => fleet[0].capacity[0] === 7],
  [
    'fits if the window of its pickup closed 1 minute later and the last window of its delivery ' +
      'closed 2 minutes later',
    'shipment',
    ({ shipments: [{ pickup, delivery }] }) =>
      pickup.time_window.latest === 660 && delivery.time_window.latest === 1020,
  ],
  [
    'fits if max_time_between were at least 1.5 minutes and max_detour were at least 1.062',
    'shipment',
    ({ shipments: [it] }) => it.max_time_between === 90 && it.max_detour === 1.062,
  ],
  [
    'fits if max_detour were at least 2',
    'shipment',
    ({ shipments: [it] }) => it.max_detour === 2 && it.max_time_between === undefined,
  ],
  [
    'served if its unassigned_cost were above 3.00',
    'shipment',
    ({ shipments: [it] }) => it.unassigned_cost === 3.01,
  ],
  ['fits if van could make 2 stops', 'shipment', ({ fleet }) => fleet[0].max_stops === 2],
  [
    'fits if its last window at A/kiosk closed 1 minute later',
    'customer',
    ({ customers }) => customers[0].alternatives[0].time_windows[1].latest === 660,
  ],
  ['fits without its relations', 'customer', ({ relations }) => relations.length === 0],
  ['fits without break lunch', 'customer', ({ fleet }) => fleet[0].breaks.length === 0],
  [
    'fits if break lunch allowed 5 aboard',
    'customer',
    ({ fleet }) => fleet[0].breaks[0].max_load[0] === 5,
  ],
  [
    'fits if break lunch could begin 10 minutes later',
    'customer',
    ({ fleet }) => fleet[0].breaks[0].start.latest === 4200,
  ],
  [
    "fits if van's drivers could work 400 minutes without a rest",
    'customer',
    ({ fleet }) => fleet[0].driving_rules.max_work_before_break === 24_000,
  ],
]) {
  test(`the console does what is offered: ${remedy}`, () => {
    const result = applyRemedy(MORE, 'A', { vehicle_type: 'van', code: 'X', remedy }, kind);
    assert.ok(changed(result), JSON.stringify(result));
  });
}

test('of a relation nothing is left that one shipment keeps anyhow', () => {
  const related = (kind, ...customers) => ({ kind, customers });
  const shipments = ['s', 't'].map((id) => ({ id, amount: [1], pickup: {}, delivery: {} }));
  const changed = applyRemedy({
    ...request,
    shipments,
    relations: [
      related('together', 'A', 's/pickup', 's/delivery'),
      related('together', 'A', 's/pickup', 't/pickup'),
      related('before', 's/pickup', 'A', 's/delivery'),
    ],
  }, 'A', { vehicle_type: 'van', remedy: 'fits without its relations' });
  assert.deepEqual(changed.relations, [
    related('together', 's/pickup', 't/pickup'), related('before', 's/pickup', 's/delivery'),
  ]);
});
