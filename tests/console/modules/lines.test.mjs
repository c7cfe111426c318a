import assert from 'node:assert/strict';
import test from 'node:test';
import { describe } from '../../../app/console/static/js/core/describe.js';
import { geoJson, gpx } from '../../../app/console/static/js/core/exports.js';
import { flownLegs } from '../../../app/console/static/js/core/flights.js';
import { contains, indexPlan } from '../../../app/console/static/js/core/plan.js';
import { playback } from '../../../app/console/static/js/core/playback.js';
import { decodeLine } from '../../../app/console/static/js/core/polyline.js';

// By the package polyline of Python, from (y, x) with six decimals.
const FAR = '_pnwqB_}eqn@elA~eoc~Adk`ypB_hpecuey@';
const BENT = '?????_c`|@_c`|@?'; // x and y: (0, 0), (0, 0), (1, 0), (1, 1)
const AROUND = '??_c`|@?_c`|@_gayB'; // (0, 0), (0, 1), (2, 2)

const REQUEST = {
  depots: [{ id: 'hub', location: [0, 0] }],
  customers: [
    { id: 'A', location: [1, 1], demand: [1] },
    { id: 'B', location: [2, 2], demand: [1] },
  ],
  fleet: [{ id: 'van', count: 1, capacity: [5], drones: { count: 1, capacity: [1] } }],
};
const halt = (kind, id, time, more = {}) => ({
  kind,
  id,
  arrival: time,
  service_start: time,
  departure: time,
  waiting: 0,
  lateness: 0,
  load: [0],
  ...more,
});

function planned(lines) {
  const stops = [
    halt('depot', 'hub', 0),
    halt('customer', 'A', 20, { geometry: lines.leg }),
    halt('depot', 'hub', 40),
  ];
  const flight = {
    drone: 'van-1/drone-1',
    launch_stop: 0,
    recovery_stop: 0,
    launch_time: 0,
    recovery_time: 20,
    customers: [{ ...halt('customer', 'B', 10), geometry: lines.flight }],
  };
  const trip = { load: [1], load_rate: 1, distance: 4, duration: 40, stops, sorties: [flight] };
  const route = { vehicle: 'van-1', type: 'van', trips: [trip] };
  return indexPlan(REQUEST, { routes: [route], unassigned: [], summary: {}, cost: { total: 1 } });
}

const bent = planned({ leg: BENT, flight: AROUND });
const straight = planned({});

test('lines are read as they were written, however far', () => {
  assert.deepEqual(decodeLine(FAR), [
    [24.94, 60.17],
    [-24.9412, 60.171235],
    [1e6, 0.5],
  ]);
  assert.deepEqual(decodeLine(''), []);
});

test('legs and flights take the lines of the reply', () => {
  const [trip] = bent.vehicles[0].trips;
  assert.deepEqual(trip.stops[1].line, [
    [0, 0],
    [0, 0],
    [1, 0],
    [1, 1],
  ]);
  const [there, back] = flownLegs(trip.sorties[0]);
  assert.deepEqual(there, [
    [0, 0],
    [0, 1],
    [2, 2],
  ]);
  assert.equal(back.length, 2); // straight, as it is flown
});

test('a line that leads elsewhere is not taken', () => {
  const [trip] = planned({ leg: AROUND, flight: BENT }).vehicles[0].trips;
  assert.deepEqual(trip.stops[1].line, [
    [0, 0],
    [1, 1],
  ]);
  assert.deepEqual(trip.sorties[0].lines, [null, null]);
});

test('files hold flights as they are flown, not as the map draws them', () => {
  const lineOf = (index) =>
    geoJson(index).features.find(
      ({ properties: { kind } }) => kind === 'flight',
    ).geometry.coordinates;
  assert.deepEqual(lineOf(straight), [
    [0, 0],
    [2, 2],
    [0, 0],
  ]);
  assert.deepEqual(lineOf(bent), [
    [0, 0],
    [0, 1],
    [2, 2],
    [0, 0],
  ]);
});

test('files hold the roads of trips', () => {
  const file = gpx(bent.vehicles[0]);
  assert.equal(file.split('<trk>').length, 3);
  assert.ok(file.includes('<name>van-1, trip 1, road</name>'));
  assert.equal(gpx(straight.vehicles[0]).split('<trk>').length, 2);
});

test('trucks drive along their roads', () => {
  const at = playback(bent);
  assert.deepEqual(at(10).trucks[0].location, [1, 0]);
});

test('a leg is told with its road', () => {
  assert.ok(contains(bent, 't:0/0', 'l:0/0/1'));
  const { title, facts } = describe(REQUEST, bent, 'l:0/0/1');
  assert.equal(title, 'hub \u2192 A');
  assert.deepEqual(Object.fromEntries(facts).Road, '2 m');
  assert.ok('Straight' in Object.fromEntries(describe(REQUEST, straight, 'l:0/0/1').facts));
  assert.equal(describe(REQUEST, bent, 'l:0/0/0'), null);
});

test('who is served at another place is told and drawn there', () => {
  const [customer, ...others] = REQUEST.customers;
  const locker = { id: 'locker', location: [5, 5], cost: 2, service_duration: 30 };
  const request = {
    ...REQUEST,
    customers: [{ ...customer, service_duration: 60, alternatives: [locker] }, ...others],
  };
  const stops = [
    halt('depot', 'hub', 0),
    halt('customer', 'A', 20, { alternative: 'locker' }),
    halt('depot', 'hub', 40),
  ];
  const trip = { load: [1], load_rate: 1, distance: 4, duration: 40, stops, sorties: [] };
  const route = { vehicle: 'van-1', type: 'van', trips: [trip] };
  const index = indexPlan(request, { routes: [route], unassigned: [], summary: {}, cost: {} });
  const served = index.halts.get('c:A');
  assert.deepEqual([served.location, served.source.service_duration], [[5, 5], 30]);
  const { facts } = describe(request, index, 'c:A');
  assert.ok(facts.some(([term, value]) => term === 'Served at' && value === 'locker'));
});
