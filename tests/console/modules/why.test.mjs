import assert from 'node:assert/strict';
import test from 'node:test';
import {
  alternativeRows,
  bindingInWords,
  countWorth,
  drones,
  noDroneInWords,
} from '../../../app/console/static/js/core/why.js';

const cost = (total, terms = {}) => ({ total, fixed: 0, distance: total, ...terms });
const position = (after, rest = {}) => ({
  trip: 0, own_trip: false, stop: 1, after, recovery_stop: null, recovered_at: null, ...rest,
});
const item = (kind, rest) => ({
  kind, vehicle: 'truck-1', by: 'truck', window: null, position: position('A'),
  service_start: 29100, cost: cost(12.4), feasible: true, reasons: [], ...rest,
});

test('an alternative is told with who comes, where and for how much', () => {
  const customer = { time_windows: [{ latest: 100 }, { earliest: 28800, latest: 36000 }] };
  const rows = alternativeRows([
    item('place', {}),
    item('by', { by: 'drone', position: position('B', { recovered_at: 'C' }) }),
    item('window', { window: 1, cost: cost(-3) }),
    item('vehicle', {
      vehicle: 'van-2', position: position('hub', { own_trip: true }), companions: ['C', 's1'],
    }),
    item('unassigned', { vehicle: null, by: null, position: null, service_start: null }),
  ], customer);
  assert.deepEqual(rows.map(({ what, where }) => [what, where]), [
    ['Elsewhere with truck-1', 'after A, 8:05'],
    ['By a drone of truck-1', 'from B, back at C, 8:05'],
    ['Only 8:00 to 10:00, by truck-1', 'after A, 8:05'],
    ['By van-2 with C, s1', 'on a trip of its own, 8:05'],
    ['Not at all', ''],
  ]);
  assert.deepEqual(rows.map((row) => row.cost), ['+12.40', '+12.40', '−3.00', '+12.40', '+12.40']);
  assert.equal(rows[0].terms, 'Distance +12.40');
  assert.equal(new Set(rows.map(({ key }) => key)).size, rows.length);
});

test('all ends of a shipment are told with where and when they come', () => {
  const end = (kind, after, rest) => ({
    kind, id: 's1', by: 'truck', position: position(after, rest), arrival: 29100,
  });
  const visits = [{ id: 's1/delivery', time_windows: [{ latest: 100 }, { earliest: 28800 }] }];
  const ends = [{ ...end('pickup', 'A'), part: 'farm' }, end('delivery', 'B')];
  const rows = alternativeRows([
    item('vehicle', { ends }),
    item('window', { ends, window: 1, window_at: 's1/delivery' }),
    item('by', { by: 'drone', ends: [ends[0], end('delivery', 'B', { recovered_at: 'C' })] }),
    item('vehicle', {
      ends: [end('pickup', 'hub'), end('delivery', 's1/pickup')],
      position: position('hub', { own_trip: true }),
    }),
  ], {}, visits);
  assert.deepEqual(rows.map(({ where }) => where), [
    'pickup farm after A, 8:05; delivery after B, 8:05',
    'pickup farm after A, 8:05; delivery after B, 8:05',
    'pickup farm after A, 8:05; delivery from B, back at C, 8:05',
    'on a trip of its own: pickup 8:05; delivery 8:05',
  ]);
  assert.equal(rows[1].what, 's1/delivery: Only from 8:00, by truck-1');
  const limit = { rule: 'time_window.latest', slack: 0, unit: 'minute', saves_per_unit: 1 };
  assert.equal(bindingInWords({ ...limit, at: 's1/delivery' }, 's1'),
    'The end of its window of s1/delivery: one minute later would save 1.00.');
});

test('what forbids an alternative is told with times', () => {
  const reasons = [{ code: 'TIME_WINDOW', message: 'customer A is reached at 36000 s' }];
  const [row] = alternativeRows([item('vehicle', { feasible: false, reasons })], {});
  assert.deepEqual(row.reasons, ['customer A is reached at 10:00']);
});

test('what binds is told with what a unit more would save', () => {
  const limit = { at: 'van', slack: 0, unit: 'minute', saves_per_unit: 1.25 };
  assert.equal(bindingInWords({ ...limit, rule: 'time_windows[-1].latest', at: 'A' }),
    'The end of its window: one minute later would save 1.25.');
  assert.equal(bindingInWords({ ...limit, rule: 'shift.latest', saves_per_unit: 0 }),
    'The end of the shift of van is reached: one minute later would save nothing.');
  assert.equal(bindingInWords({ ...limit, rule: 'capacity[1]', unit: 'unit', slack: 2 }),
    'The capacity of van (2 units left): one more would save 1.25.');
  assert.equal(bindingInWords({ ...limit, rule: 'max_trip_distance', unit: 'km', slack: null }),
    'The longest trip of van: one km more would save 1.25.');
});

test('a rule without a number that binds is told with what it costs', () => {
  const limit = { at: 'A', slack: null, unit: 'rule', saves_per_unit: 1.25 };
  assert.equal(bindingInWords({ ...limit, rule: 'vehicles' }),
    'Which vehicles may serve it: without this rule 1.25 would be saved.');
  assert.equal(bindingInWords({ ...limit, rule: 'pickups', at: 'van' }),
    'The order of pickups of van: without this rule 1.25 would be saved.');
  assert.equal(bindingInWords({ ...limit, rule: 'breaks[tea]', at: 'van' }),
    'The break of tea of van: without this rule 1.25 would be saved.');
  assert.equal(bindingInWords({ ...limit, rule: 'breaks[tea].max_load', at: 'van', unit: 'unit' }),
    'What may be aboard during the break of tea of van: one more would save 1.25.');
  assert.equal(
    bindingInWords({ ...limit, rule: 'fairness.min_vehicles', at: '', unit: 'vehicle' }),
    'The least number of vehicles: one vehicle fewer would save 1.25.');
});

test('what drones save in sum is told with how that is known', () => {
  const told = { saves: 10, saves_at_most: 12, seconds: 1.25 };
  assert.deepEqual(drones(told, 100), [
    'Drones save 10.00 against trucks alone: two searches of 1.3 s from the same plan, ' +
      'one without drones.',
    'Against this plan trucks alone cost +12.00 (12 % of this plan): at most that much is saved, ' +
      'as this plan may have been searched for longer.',
  ]);
  const unknown = { saves: null, saves_at_most: null, seconds: 0 };
  assert.equal(drones(unknown, 1).length, 1);
  assert.match(drones({ ...unknown, trucks_alone: { unassigned: 2 }, with_drones:
    { unassigned: 0 } }, 1)[0], /leave out more/);
});

test('sorties that save nothing are counted apart from those that were not tried', () => {
  assert.deepEqual(countWorth([
    { tried: true, saves: -1 }, { tried: true, saves: 3 }, { tried: true, saves: null },
    { tried: false, saves: null },
  ]), { useless: 1, needed: 1, untried: 1 });
});

const FLEET = [
  { id: 'van', drones: { count: 1, capacity: [1] } },
  { id: 'quad', flies: true },
];
const bySortie = { by: 'drone', position: position('B', { recovered_at: 'C' }) };

test('a vehicle that flies comes as itself, not as a drone of its own', () => {
  const [row] = alternativeRows([item('vehicle', { vehicle: 'quad-1', by: 'drone' })], {});
  assert.deepEqual([row.what, row.where], ['By quad-1', 'after A, 8:05']);
});

test('why no drone comes is told by zone and by drone', () => {
  const range = { code: 'MAX_RANGE', message: 'customer A lies 2000 m from its launch' };
  const told = {
    here: { by: 'truck' },
    zones: [{
      holds: 'customer', name: 'EDR-4', identifier: null, restriction: 'PROHIBITED', lower: null,
      upper: null, authority: null, message: 'the zone EDR-4.',
    }],
    alternatives: [
      item('place', {}),
      item('by', { ...bySortie, feasible: false, reasons: [range] }),
      item('vehicle', { vehicle: 'quad-1', by: 'drone', feasible: false, reasons: [range] }),
    ],
  };
  const windy = { fleet: FLEET, airspace: { wind: [] } };
  assert.deepEqual(noDroneInWords(told, windy, { served_by: 'truck' }), [
    'It is to be served by truck.',
    'No drone lands in the zone EDR-4, where flying is prohibited from an unstated height up.',
    'a drone of truck-1: customer A lies 2000 m from its launch',
    'quad-1: customer A lies 2000 m from its launch',
  ]);
  const may = { ...told, zones: [], alternatives: [item('by', bySortie)] };
  assert.deepEqual(noDroneInWords(may, windy, {}), ['a drone of truck-1: may come, for +12.40.']);
});

test('who is left out is told what drones alone are held by; who is flown to, nothing', () => {
  const told = {
    here: null,
    alternatives: [],
    reasons: [
      { vehicle_type: 'van', code: 'SHIFT', message: 'too late' },
      { vehicle_type: 'van', code: 'AIRSPACE', message: 'It lies in the zone EDR-4.' },
      { vehicle_type: 'quad', code: 'SHIFT', message: 'too late' },
    ],
  };
  const request = { fleet: FLEET };
  assert.deepEqual(noDroneInWords(told, request, {}), [
    'van: It lies in the zone EDR-4.',
    'quad: too late',
  ]);
  assert.deepEqual(noDroneInWords({ here: { by: 'drone' }, alternatives: [] }, request, {}), []);
  assert.deepEqual(noDroneInWords(told, { fleet: [{ id: 'van' }] }, {}), []);
  const untried = { here: null, alternatives: [] };
  assert.equal(noDroneInWords(untried, request, {}).length, 1);
});
