import assert from 'node:assert/strict';
import test from 'node:test';
import {
  moveInWords,
  placeInWords,
  rulesInWords,
} from '../../../app/console/static/js/core/hands-words.js';
import {
  isHere,
  judgedPlan,
  placeAt,
  placeBeside,
  vehiclesFor,
  withCustomerAt,
  withRoute,
} from '../../../app/console/static/js/core/moving.js';
import { indexPlan } from '../../../app/console/static/js/core/plan.js';
import { furtherFrom } from '../../../app/console/static/js/core/replanning.js';
import { visitNamesOf } from '../../../app/console/static/js/core/visits.js';

const REQUEST = {
  depots: [{ id: 'hub', location: [0, 0] }],
  customers: ['A', 'B', 'C', 'D', 'F', 'G'].map((id, at) => ({ id, location: [at, 1], demand: [1] })),
  fleet: [
    { id: 'van', count: 3, capacity: [9] },
    { id: 'open', count: 1, capacity: [9], start_location: [5, 5], end: 'open' },
  ],
};
const stop = (id, at) => ({
  kind: id === 'hub' ? 'depot' : 'customer', id, arrival: at, service_start: at, departure: at + 10,
});
const flight = {
  drone: 'van-1/drone-1', launch_stop: 2, recovery_stop: 3, launch_time: 1, recovery_time: 2,
  customers: [{ id: 'F', arrival: 1, service_start: 1, departure: 1 }],
};
const PLAN = {
  routes: [
    { vehicle: 'van-1', type: 'van', trips: [
      { stops: [stop('hub', 0), stop('A', 100), stop('B', 200), stop('C', 300), stop('hub', 400)],
        sorties: [flight] }] },
    { vehicle: 'van-2', type: 'van', trips: [
      { stops: [stop('hub', 50), stop('D', 150), stop('hub', 250)], sorties: [] }] },
  ],
  unassigned: [{ id: 'G', reasons: [{ code: 'X' }] }],
};
const ids = (plan) => plan.routes.map(({ vehicle, trips }) =>
  [vehicle, ...trips.map(({ stops }) => stops.map(({ id }) => id).join(' '))].join(': '));
const at = (vehicle, place, trip = 0) => ({ vehicle, trip, stop: place });

test('a stop goes to another vehicle, whose times and own are made anew', () => {
  const moved = withCustomerAt(REQUEST, PLAN, 'A', at('van-2', 2));
  assert.deepEqual(ids(moved), ['van-1: hub B C hub', 'van-2: hub D A hub']);
  assert.deepEqual(moved.routes[1].trips[0].stops[1], { kind: 'customer', id: 'D' });
  assert.equal(moved.routes[1].trips[0].stops[0].arrival, 50);
  const [sortie] = moved.routes[0].trips[0].sorties;
  assert.deepEqual([sortie.launch_stop, sortie.recovery_stop], [1, 2]);
  assert.deepEqual(sortie.customers, [{ id: 'F' }]);
  assert.deepEqual(moved.unassigned, [{ id: 'G' }]);
});

test('a stop goes elsewhere on its trip; flights that met there do so at the one before', () => {
  const later = withCustomerAt(REQUEST, PLAN, 'B', at('van-1', 4));
  assert.deepEqual(ids(later)[0], 'van-1: hub A C B hub');
  const [sortie] = later.routes[0].trips[0].sorties;
  assert.deepEqual([sortie.launch_stop, sortie.recovery_stop], [1, 2]);
  assert.equal(later.routes[1], PLAN.routes[1]);
  assert.deepEqual(ids(withCustomerAt(REQUEST, PLAN, 'C', at('van-1', 1)))[0],
    'van-1: hub C A B hub');
});

test('who was flown to comes by truck, and a flight to nobody is gone', () => {
  const driven = withCustomerAt(REQUEST, PLAN, 'F', at('van-2', 1));
  assert.deepEqual(ids(driven), ['van-1: hub A B C hub', 'van-2: hub F D hub']);
  assert.deepEqual(driven.routes[0].trips[0].sorties, []);
});

test('vehicles come and go with those whom they serve', () => {
  const fresh = withCustomerAt(REQUEST, PLAN, 'D', { vehicle: 'van-3', type: 'van' });
  assert.deepEqual(ids(fresh), ['van-1: hub A B C hub', 'van-3: hub D hub']);
  const open = withCustomerAt(REQUEST, PLAN, 'G', { vehicle: 'open-1', type: 'open' });
  assert.deepEqual(open.routes[2].trips[0].stops, [
    { kind: 'start', id: 'open' }, { kind: 'customer', id: 'G' }]);
  assert.deepEqual(open.unassigned, []);
  const left = withCustomerAt(REQUEST, PLAN, 'D', null);
  assert.deepEqual([ids(left), left.unassigned], [['van-1: hub A B C hub'],
    [{ id: 'G' }, { id: 'D' }]]);
});

test('a route that was found stands in place of the vehicle\'s, and nobody is served twice', () => {
  const route = { vehicle: 'van-2', type: 'van', trips: [
    { stops: [stop('hub', 0), stop('A', 1), stop('D', 2), stop('hub', 3)], sorties: [] }] };
  const taken = withRoute(PLAN, ['A'], route);
  assert.deepEqual(ids(taken), ['van-1: hub B C hub', 'van-2: hub A D hub']);
  assert.equal(taken.routes[1], route);
  const added = withRoute(PLAN, ['G'], { ...route, vehicle: 'van-3' });
  assert.deepEqual([ids(added).length, added.unassigned], [3, []]);
});

test('a shipment goes elsewhere with all its ends, and who is left out stays so', () => {
  const end = (kind, part) => ({ kind, id: 's', ...(part && { part }), arrival: 1 });
  const before = { vehicle: 'van-1', type: 'van', trips: [{ stops: [
    stop('hub', 0), end('pickup', 'farm'), end('pickup', 'mill'), end('delivery'), stop('hub', 3),
  ], sorties: [] }] };
  const left = { kind: 'shipment', id: 'o', reasons: [] };
  const route = { ...before, vehicle: 'van-2' };
  const names = ['s/pickup/farm', 's/pickup/mill', 's/delivery'];
  const taken = withRoute({ routes: [before], unassigned: [left] }, names, route);
  assert.deepEqual(taken, { routes: [route], unassigned: [{ kind: 'shipment', id: 'o' }] });
  const out = { ...left, id: 's', parts: ['farm', 'mill'] };
  assert.deepEqual(withRoute({ routes: [], unassigned: [out] }, names, route),
    { routes: [route], unassigned: [] });
});

test('places are found by order, by time and by vehicle', () => {
  const index = indexPlan(REQUEST, PLAN);
  const [A, C, F] = ['c:A', 'c:C', 'c:F'].map((key) => index.halts.get(key));
  assert.equal(placeBeside(A, -1), null);
  assert.deepEqual(placeBeside(A, 1), at('van-1', 3));
  assert.deepEqual(placeBeside(C, -1), at('van-1', 2));
  assert.equal(placeBeside(C, 1), null);
  assert.equal(placeBeside(F, 1), null);
  assert.deepEqual(placeAt(index.vehicles[0], 210), at('van-1', 3));
  assert.deepEqual(placeAt(index.vehicles[1], 9999), at('van-2', 2));
  assert.ok(isHere(A, at('van-1', 2)) && isHere(A, at('van-1', 1)));
  assert.ok(!isHere(A, at('van-1', 3)) && !isHere(F, at('van-1', 1)));
  assert.deepEqual(vehiclesFor(REQUEST, index).map(({ name }) => name),
    ['van-1', 'van-2', 'van-3', 'open-1']);
});

test('a judged plan keeps why others are left out', () => {
  const decided = withCustomerAt(REQUEST, PLAN, 'D', null);
  const verdict = { cost: { total: 7 }, summary: { served: 4 }, routes: [PLAN.routes[0]] };
  const plan = judgedPlan({ ...PLAN, legs: [1] }, decided, verdict);
  assert.deepEqual(plan.unassigned, [{ id: 'G', reasons: [{ code: 'X' }] }, { id: 'D', reasons: [] }]);
  assert.deepEqual([plan.status, plan.cost.total, plan.legs], ['partial', 7, [1]]);
});

test('changes, places and rules are told in words', () => {
  const index = indexPlan(REQUEST, PLAN);
  assert.equal(moveInWords(index, 'A', at('van-1', 3)), 'A to van-1, after B');
  assert.equal(moveInWords(index, 'B', at('van-1', 3)), 'B to van-1, after A');
  assert.equal(moveInWords(index, 'A', { vehicle: 'van-3', type: 'van' }), 'A to van-3');
  assert.equal(moveInWords(index, 'A', null), 'A left out');
  assert.deepEqual(placeInWords({ vehicle: 'van-1', by: 'drone', service_start: 3600,
    position: { own_trip: false, after: 'A', recovered_at: 'B' } }),
  ['a drone of van-1', 'from A, back at B, 1:00']);
  assert.deepEqual(placeInWords({ vehicle: 'van-1', by: 'truck', service_start: 3600,
    position: { own_trip: false, after: 'A', recovered_at: null }, companions: ['C', 's1'] }),
  ['van-1 with C, s1', 'after A, 1:00']);
  assert.deepEqual(placeInWords({ vehicle: 'van-1', by: 'truck', service_start: 3600,
    alternative: 'locker', position: { own_trip: false, after: 'A', recovered_at: null } }),
  ['van-1', 'at locker, after A, 1:00']);
  assert.deepEqual(visitNamesOf({ customers: [{ id: 'C' }], shipments: [
    { id: 's1', amount: [1], pickup: {}, delivery: {} }] }, ['C', 's1']),
  ['C', 's1/pickup', 's1/delivery']);
  assert.deepEqual(rulesInWords([{ message: 'customer B is reached at 3600 s, after 60 s' },
    { message: 'customer B is reached at 3600 s, after 60 s' }]),
  ['Customer B is reached at 1:00, after 0:01.']);
  assert.deepEqual(rulesInWords([{ message: 'load 5 exceeds 4', path: '$.plan.routes[1].trips[0]' }],
    PLAN.routes), ['van-2: load 5 exceeds 4.']);
});

test('who is locked is pinned, in order, where a plan is improved, if the plan serves him', () => {
  const asked = furtherFrom(REQUEST, { plan: PLAN }, ['A', 'G', 'nobody']);
  assert.deepEqual(asked.replan, { plan: PLAN, pinned: ['A'], keep_order: true });
  assert.deepEqual(furtherFrom(REQUEST, { plan: PLAN }).replan, { plan: PLAN });
});
