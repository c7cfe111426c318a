import assert from 'node:assert/strict';
import test from 'node:test';
import {
  addVehicles, changeWindows, giveWindows, removeCustomers, withoutDrones,
} from '../../../app/console/static/js/core/changes.js';
import { planName, unlike } from '../../../app/console/static/js/core/naming.js';

const REQUEST = {
  depots: [{ id: 'hub', location: [0, 0] }],
  customers: ['Anna', 'Ben', 'Cleo'].map((id) => ({
    id,
    location: [1, 1],
    demand: [1],
    time_window: { earliest: 28800, latest: 43200 },
  })),
  fleet: [
    { id: 'van', count: 4, capacity: [9], drones: { count: 1, capacity: [1] } },
    { id: 'truck', count: 1, capacity: [20] },
  ],
  options: { time_limit: 1 },
};
const FORMER = { request: REQUEST };
const named = (request, isFurther) => planName(FORMER, request, isFurther);
const withFields = (index, fields) => ({
  ...REQUEST,
  customers: REQUEST.customers.map((customer, at) =>
    at === index ? { ...customer, ...fields } : customer),
});

test('plans are named by what changed', () => {
  const cases = [
    [addVehicles(REQUEST, 0, -1), 'one van fewer'],
    [addVehicles(REQUEST, 0, 2), 'two vans more'],
    [addVehicles(REQUEST, 1, -1), 'one truck fewer'],
    [withoutDrones(REQUEST), 'drones off'],
    [giveWindows(REQUEST, ['Anna'], [{ earliest: 28800, latest: 36000 }]),
      "Anna's window 8:00\u201310:00"],
    [changeWindows(REQUEST, null), 'windows off'],
    [changeWindows(REQUEST, 30), 'windows soft'],
    [removeCustomers(REQUEST, ['Ben']), 'without Ben'],
    [{ ...REQUEST, customers: [...REQUEST.customers, { id: 'Dora' }] }, 'Dora added'],
    [withFields(1, { demand: [4] }), 'Ben: demand 1 \u2192 4'],
    [withFields(1, { info: { phone: '1' } }), 'planned again'],
    [{ ...REQUEST, airspace: { no_fly: [[[0, 0], [1, 0], [1, 1]]] } }, 'other no-fly areas'],
    [{ ...REQUEST, fleet: [{ ...REQUEST.fleet[0], speed_kmh: 30 }, REQUEST.fleet[1]] },
      'van: speed km/h none \u2192 30'],
    [{ ...REQUEST, fleet: [
      { ...REQUEST.fleet[0], driving_rules: { preset: 'us-hos', max_driving: 3600 } },
      REQUEST.fleet[1]] },
    'van: driving rules none \u2192 preset US hours of service'],
    [{ ...REQUEST, fleet: [{ ...REQUEST.fleet[0], breaks: [{ id: 'tea', duration: 60 }] },
      REQUEST.fleet[1]] }, 'van: breaks none \u2192 tea'],
    [{ ...REQUEST, relations: [{ kind: 'apart', customers: ['Anna', 'Ben'] }] },
      'who goes with whom none \u2192 1'],
    [{ ...REQUEST, options: { time_limit: 10 } }, 'planned for 10 s'],
    [REQUEST, 'planned again'],
  ];
  for (const [request, name] of cases) assert.ok(named(request).startsWith(name), named(request));
});

test('several changes are named as far as they fit', () => {
  const both = withoutDrones(addVehicles(REQUEST, 0, -1));
  assert.equal(named(both), 'one van fewer, drones off');
  const three = giveWindows(both, ['Anna', 'Ben'], [{ earliest: 0, latest: 3600 }]);
  assert.equal(named(three), 'one van fewer, drones off, 1 more change');
});

test('the first plan, an improved one and a replanned one are told', () => {
  assert.equal(planName(null, REQUEST), 'first plan');
  assert.equal(named(REQUEST, true), 'improved');
  const later = { ...REQUEST, replan: { plan: {}, freeze_before: 36600 } };
  assert.equal(named(later), 'replanned at 10:10');
  assert.equal(named(removeCustomers(later, ['Ben'])), 'without Ben, replanned at 10:10');
});

test('no two plans have one name', () => {
  const plans = [{ name: 'planned again' }, { name: 'planned again (2)' }];
  assert.equal(unlike('planned again', plans), 'planned again (3)');
  assert.equal(unlike('drones off', plans), 'drones off');
});
