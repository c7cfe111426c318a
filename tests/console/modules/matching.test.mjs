import assert from 'node:assert/strict';
import test from 'node:test';
import {
  movedCustomers, planDifference, renamedTours,
} from '../../../app/console/static/js/core/differences.js';
import { entryAfter, numbersIn } from '../../../app/console/static/js/core/entries.js';
import { matchVehicles } from '../../../app/console/static/js/core/matching.js';
import { penaltyOf, trueCost } from '../../../app/console/static/js/core/terms.js';

const ALL = ['A', 'B', 'C', 'D', 'E', 'F', 'G'];

function requestOf(fleet, more = {}) {
  return {
    depots: [{ id: 'hub', location: [0, 0] }],
    customers: ALL.map((id) => ({ id, location: [1, 1], demand: [1] })),
    fleet: Object.entries(fleet).map(([id, count]) => ({ id, count, capacity: [9] })),
    ...more,
  };
}

/** Return an entry of plans with tours such as `{'van-1': 'AB'}`; lower case goes by drone. */
function entryOf(fleet, tours, more = {}) {
  const served = new Set(Object.values(tours).join('').toUpperCase());
  const visit = (id) => ({ id, arrival: 1, service_start: 1, departure: 1, lateness: 0 });
  const routes = Object.entries(tours).map(([vehicle, ids]) => ({
    vehicle,
    type: vehicle.slice(0, vehicle.lastIndexOf('-')),
    trips: [{
      load: [1],
      stops: [...ids].filter((id) => id < 'a').map((id) => ({ kind: 'customer', ...visit(id) })),
      sorties: [...ids].filter((id) => id >= 'a').map((id) => ({
        drone: `${vehicle}/drone-1`,
        launch_stop: 0,
        recovery_stop: 0,
        customers: [visit(id.toUpperCase())],
      })),
    }],
  }));
  const unassigned = ALL.filter((id) => !served.has(id)).map((id) => ({ id }));
  return {
    number: 1,
    name: 'a plan',
    request: requestOf(fleet, more.request),
    plan: {
      routes,
      unassigned,
      cost: { total: 100, ...more.cost },
      summary: { served: served.size, customers: ALL.length },
      ...more.plan,
    },
  };
}

const pairsOf = (former, entry) =>
  Object.fromEntries(matchVehicles(former, entry).map(({ before, now }) => [now, before]));
const tours = ({ plan }) => Object.fromEntries(plan.routes.map(({ vehicle, trips }) => [
  vehicle, trips[0].stops.map(({ id }) => id).join('')]));

test('tours under other names are the same tours, also with a vehicle fewer', () => {
  const former = entryOf({ van: 3 }, { 'van-1': 'AB', 'van-2': 'CDE', 'van-3': 'FG' });
  const fewer = entryOf({ van: 2 }, { 'van-1': 'FGA', 'van-2': 'CDEB' });
  assert.deepEqual(pairsOf(former, fewer), { 'van-1': 'van-3', 'van-2': 'van-2' });
  assert.deepEqual(movedCustomers(former, fewer), [
    { id: 'A', before: 'van-1', now: 'van-1' },
    { id: 'B', before: 'van-1', now: 'van-2' },
  ]);
  assert.deepEqual(renamedTours(matchVehicles(former, fewer)),
    [{ before: 'van-3', now: 'van-1', shared: 2 }]);
});

test('all in all counts, not who comes first', () => {
  // Van 1 of the new plan has most of van 1, but van 2 has nothing else to be.
  const former = entryOf({ van: 2 }, { 'van-1': 'ABCDE', 'van-2': 'FG' });
  const later = entryOf({ van: 2 }, { 'van-1': 'ABCFG', 'van-2': 'DE' });
  assert.deepEqual(pairsOf(former, later), { 'van-1': 'van-2', 'van-2': 'van-1' });
});

test('types that both fleets have are not mixed up, and one that left is replaced', () => {
  const former = entryOf({ van: 1, truck: 1 }, { 'van-1': 'AB', 'truck-1': 'CD' });
  const swapped = entryOf({ van: 1, truck: 1 }, { 'van-1': 'CD', 'truck-1': 'AB' });
  assert.deepEqual(movedCustomers(former, swapped).map(({ id }) => id), ['A', 'B', 'C', 'D']);
  const vans = entryOf({ van: 2 }, { 'van-1': 'CD', 'van-2': 'AB' });
  assert.deepEqual(pairsOf(former, vans), { 'van-1': 'truck-1', 'van-2': 'van-1' });
});

test('a drone in place of its truck is another, a drone of another number is not', () => {
  const former = entryOf({ van: 1 }, { 'van-1': 'ABc' });
  const later = entryOf({ van: 1 }, { 'van-1': 'AbC' });
  assert.deepEqual(movedCustomers(former, later).map(({ id }) => id), ['B', 'C']);
  const other = structuredClone(former);
  other.plan.routes[0].trips[0].sorties[0].drone = 'van-1/drone-2';
  assert.deepEqual(movedCustomers(former, other), []);
});

test('a new plan has the names and numbers of the former for the same tours', () => {
  const first = entryAfter(null, entryOf({ van: 3 }, { 'van-1': 'AB', 'van-2': 'CDe', 'van-3': 'FG' }));
  const again = entryAfter(first, entryOf({ van: 3 }, { 'van-1': 'FG', 'van-2': 'AB', 'van-3': 'CDe' }));
  assert.deepEqual(tours(again), { 'van-3': 'FG', 'van-1': 'AB', 'van-2': 'CD' });
  assert.equal(again.plan.routes[2].trips[0].sorties[0].drone, 'van-2/drone-1');
  const fewer = entryAfter(again, entryOf({ van: 2 }, { 'van-1': 'CDEA', 'van-2': 'FGB' }));
  assert.deepEqual(tours(fewer), { 'van-2': 'CDEA', 'van-1': 'FGB' });
  assert.deepEqual(Object.fromEntries(numbersIn(fewer)), { 'van-2': 1, 'van-1': 2 });
  const more = entryAfter(fewer, entryOf({ van: 3 }, { 'van-1': 'CDE', 'van-2': 'FG', 'van-3': 'AB' }));
  assert.deepEqual(tours(more), { 'van-2': 'CDE', 'van-1': 'FG', 'van-3': 'AB' });
  assert.deepEqual(Object.fromEntries(numbersIn(more)), { 'van-2': 1, 'van-1': 2, 'van-3': 0 });
});

test('vehicles that someone asks for, or that are under way, keep their names', () => {
  const first = entryOf({ van: 2 }, { 'van-1': 'AB', 'van-2': 'CD' });
  const swapped = { 'van-1': 'CD', 'van-2': 'AB' };
  const asked = entryOf({ van: 2 }, swapped);
  asked.request.customers[0].vehicles = { allowed: ['van-2'] };
  assert.equal(entryAfter(first, asked).plan, asked.plan);
  const gone = entryOf({ van: 2 }, swapped,
    { plan: { replan: { settled: [{ vehicle: 'van-1', trip: 0, stop: 0 }], excused: [] } } });
  assert.equal(entryAfter(first, gone).plan, gone.plan);
  assert.deepEqual(Object.fromEntries(numbersIn(entryAfter(first, gone))),
    { 'van-1': 0, 'van-2': 1 });
  assert.deepEqual(pairsOf(first, gone), { 'van-1': 'van-1', 'van-2': 'van-2' });
});

test('what a plan costs is told apart from penalties that nobody stated', () => {
  const former = entryOf({ van: 1 }, { 'van-1': 'ABCDEFG' }, { cost: { total: 120, unassigned: 0 } });
  const tour = { 'van-1': 'ABCDE' };
  const cost = { total: 9100, unassigned: 9000 };
  const entry = entryOf({ van: 1 }, tour, { cost });
  assert.equal(penaltyOf(entry), 9000);
  assert.equal(trueCost(entry), 100);
  assert.equal(planDifference(former, entry), 'It costs 20.00 less and serves 2 customers fewer.');
  const stated = entryOf({ van: 1 }, tour, { cost });
  stated.request.customers[5].unassigned_cost = 30;
  assert.equal(penaltyOf(stated), 8970);
  assert.equal(penaltyOf(entryOf({ van: 1 }, tour, { cost, request: { unassigned_cost: 4500 } })), 0);
  assert.equal(planDifference(former, former), 'It costs the same.');
});
