import assert from 'node:assert/strict';
import test from 'node:test';
import {
  basisRoutes,
  choicesOf,
  fromNothing,
  furtherFrom,
  goOnFrom,
  dronesOnTheWay,
  idleVehicles,
  isDrone,
  setBroken,
  setPinned,
  settledParts,
  standingOf,
  whereabouts,
} from '../../../app/console/static/js/core/replanning.js';
import { timesInWords } from '../../../app/console/static/js/core/format.js';
import { indexPlan } from '../../../app/console/static/js/core/plan.js';

const stop = (id, arrival, departure) => ({
  kind: id === 'hub' ? 'depot' : 'customer',
  id,
  arrival,
  service_start: arrival,
  departure,
});
const trip = (stops, sorties = []) => ({ stops, sorties });
const flight = {
  drone: 'van-1/drone-1',
  launch_stop: 1,
  recovery_stop: 2,
  launch_time: 130,
  recovery_time: 290,
  customers: [{ id: 'F', arrival: 200, service_start: 200, departure: 210 }],
};
const PLAN = {
  routes: [
    {
      vehicle: 'van-1',
      type: 'van',
      trips: [
        trip(
          [
            stop('hub', 0, 0),
            stop('A', 100, 140),
            stop('B', 250, 300),
            stop('C', 400, 410),
            stop('hub', 500, 500),
          ],
          [flight],
        ),
      ],
    },
    {
      vehicle: 'van-2',
      type: 'van',
      trips: [
        trip([stop('hub', 0, 0), stop('D', 50, 60), stop('hub', 100, 100)]),
        trip([stop('hub', 120, 600), stop('E', 650, 660), stop('hub', 700, 700)]),
      ],
    },
  ],
};
const REQUEST = {
  customers: [...'ABCDEF'].map((id) => ({ id, demand: [1] })),
  depots: [{ id: 'hub' }],
  fleet: [{ id: 'van', count: 3, capacity: [9], drones: { count: 1, launch_duration: 20 } }],
};

test('settled is what has departed, up to where a drone in the air is met', () => {
  const entry = { request: REQUEST, plan: PLAN };
  const before = (now) => settledParts(entry, goOnFrom(REQUEST, PLAN, now)).get('van-1');
  assert.deepEqual(
    [before(-1).stop, before(99).stop, before(110).stop, before(299).stop, before(300).stop],
    [-1, 1, 2, 2, 3],
  );
  assert.deepEqual([before(109).flights, before(110).flights], [[], [0]]);
  const parts = settledParts(entry, goOnFrom(REQUEST, PLAN, 150));
  const at = (place) => standingOf(parts, { vehicle: 'van-1', trip: 0, ...place });
  assert.deepEqual([at({ stop: 2 }), at({ stop: 3 }), at({ flight: 0 })],
    ['settled', 'open', 'settled']);
  assert.equal(settledParts(entry, REQUEST).size, 0);
});

test('a broken vehicle keeps whom it has begun to serve, and loses the rest', () => {
  const pinned = setPinned(goOnFrom(REQUEST, PLAN, 150), ['C', 'E'], true);
  const request = setBroken(pinned, 'van-1', true);
  assert.deepEqual(request.replan.pinned, ['E']);
  const [first, second] = basisRoutes(request);
  assert.deepEqual(first.open, ['B', 'C', 'F']);
  assert.deepEqual(second.open, ['E']);
  assert.deepEqual(choicesOf(request, 'C'),
    { vehicle: 'van-1', isPlanned: true, mayPin: false, mayCancel: true });
  assert.equal(choicesOf(request, 'A').mayCancel, false);
  assert.equal(choicesOf(request, 'G').isPlanned, false);
  assert.deepEqual(idleVehicles(request), ['van-3']);
  request.replan.parcels_back = 300;
  assert.deepEqual([200, 301].map((now) => goOnFrom(request, PLAN, now).replan.parcels_back),
    [300, undefined]);
});

test('drones of trucks on their way can be lost', () => {
  const [van, ...others] = REQUEST.fleet;
  const drones = [{ id: 'small', count: 2 }, { id: 'large', count: 1 }];
  const request = goOnFrom({ ...REQUEST, fleet: [{ ...van, drones }, ...others] }, PLAN, 150);
  assert.deepEqual(dronesOnTheWay(request).slice(0, 4),
    ['van-1/drone-1', 'van-1/drone-2', 'van-1/drone-3', 'van-2/drone-1']);
  const lost = setBroken(request, 'van-1/drone-2', true);
  assert.deepEqual(lost.replan.unavailable, ['van-1/drone-2']);
  assert.deepEqual(lost.replan.unavailable.map(isDrone), [true]);
  assert.equal(isDrone('van-1'), false);
  assert.equal(basisRoutes(lost)[0].progress.isBroken, false);
});

test('of a new plan the reply tells what was settled', () => {
  const replan = { plan: {}, freeze_before: 150, unavailable: ['van-2'] };
  const settled = [{ vehicle: 'van-1', trip: 0, stop: 3 }, { vehicle: 'van-2', trip: 0, stop: 2 }];
  const entry = { request: { ...REQUEST, replan }, plan: { ...PLAN, replan: { settled } } };
  const parts = settledParts(entry, REQUEST);
  assert.equal(standingOf(parts, { vehicle: 'van-1', trip: 0, stop: 3 }), 'settled');
  assert.equal(standingOf(parts, { vehicle: 'van-1', trip: 0, stop: 4 }), 'open');
  assert.equal(standingOf(parts, { vehicle: 'van-2', trip: 1, stop: 1 }), 'settled');
});

test('whereabouts are said in words', () => {
  const at = (now, route) => {
    const { route: found, progress } = basisRoutes(goOnFrom(REQUEST, PLAN, now))[route];
    return whereabouts(found, progress, now);
  };
  assert.equal(at(-1, 0), 'not departed, leaves at 0:00');
  assert.equal(at(60, 0), 'on its way to A, there at 0:02');
  assert.equal(at(120, 0), 'at A, until 0:02');
  assert.equal(at(300, 1), 'back since 0:02, leaves again at 0:10');
  assert.equal(at(800, 1), 'back since 0:12');
});

test('going on keeps pins of whom the plan serves, and what is broken', () => {
  const pinned = setPinned(goOnFrom(REQUEST, PLAN, 50), ['E', 'gone'], true);
  const first = setBroken(pinned, 'van-3', true);
  const { replan } = goOnFrom(first, PLAN, 90);
  const kept = { pinned: ['E'], unavailable: ['van-3'] };
  assert.deepEqual(replan, { ...kept, plan: PLAN, freeze_before: 90 });
  assert.equal(furtherFrom(first, { plan: PLAN }).replan.freeze_before, 50);
  assert.equal(furtherFrom(first, { plan: PLAN }).replan.keep_order, undefined);
  assert.equal(furtherFrom(first, { plan: PLAN }, ['gone']).replan.keep_order, undefined);
  assert.equal(furtherFrom(first, { plan: PLAN }, ['E']).replan.keep_order, true);
  assert.equal(fromNothing(first).replan, undefined);
});

test('vehicles keep their row and number where the reply puts those under way first', () => {
  const bare = (route) => ({
    ...route,
    trips: route.trips.map(({ stops }) => ({ stops, sorties: [], load: [1] })),
  });
  const [first, second] = PLAN.routes.map(bare);
  const index = indexPlan(REQUEST, { routes: [second, first], unassigned: [] });
  assert.deepEqual(index.vehicles.map(({ name, label }) => [name, label]),
    [['van-1', '1'], ['van-2', '2']]);
  const later = { ...first, vehicle: 'van-3' };
  const goesOn = { ...REQUEST, replan: { plan: index.plan } };
  const next = indexPlan(goesOn, { routes: [second, later], unassigned: [] });
  assert.deepEqual(next.vehicles.map(({ label }) => label), ['2', '3']);
});

test('seconds in messages are times', () => {
  assert.equal(timesInWords('reached at 36030 s, after 60 s'), 'reached at 10:00:30, after 0:01');
});
