import assert from 'node:assert/strict';
import test from 'node:test';

import {
  askedFor, NOTHING_TYPED, nowOf, orderOf, placeIn, placeText, takesAnotherTrip, withAnotherTrip,
  withoutOrders, withSettled,
} from '../../../app/console/static/js/core/orders.js';
import { savedShare, flownIn } from '../../../app/console/static/js/core/drones-worth.js';

const globe = {
  coordinate_system: 'geographic',
  depots: [{ id: 'Westhafen', location: [13.343, 52.539] }],
  customers: [
    { id: 'Ostkreuz', location: [13.469, 52.503], demand: [1], service_duration: 300 },
    { id: 'Charité', location: [13.3777, 52.5258], demand: [2], service_duration: 300 },
    { id: 'address', location: { address: 'Hauptstr. 1' }, demand: [2], service_duration: 60 },
  ],
  fleet: [{ id: 'van', count: 2, capacity: [9] }],
};
const plane = { ...globe, coordinate_system: 'planar' };

test('a place is read as maps copy it, and by its name', () => {
  for (const text of ['52.5219, 13.4132', '52.5219,13.4132', ' 52.5219 13.4132', '52,5219 13,4132',
    '52,5219; 13,4132', '(52.5219, 13.4132)', '52,5219, 13,4132', '52.5219,\t13.4132']) {
    assert.deepEqual(placeIn(globe, text), [13.4132, 52.5219], text);
  }
  assert.deepEqual(placeIn(plane, '3, -4.5'), [3, -4.5]);
  assert.deepEqual(placeIn(plane, '3, \u22124.5'), [3, -4.5]);
  assert.deepEqual(placeIn(globe, 'ostkreuz '), [13.469, 52.503]);
  assert.deepEqual(placeIn(globe, 'Westhafen'), [13.343, 52.539]);
  for (const text of ['', '52.5', 'Hauptstr. 1', 'nowhere', '1, 2, 3', 'address']) {
    assert.equal(placeIn(globe, text), null, text);
  }
  assert.equal(placeText(globe, placeIn(globe, '52.5219, 13.4132')), '52.5219, 13.4132');
});

test('an order has what is typed, and what most others have', () => {
  const typed = { ...NOTHING_TYPED, amount: '2,5', opens: '10:30', closes: '12:00', name: 'Late' };
  assert.deepEqual(orderOf(globe, typed, [13, 52]), { wrong: [], customer: {
    id: 'Late', location: [13, 52], demand: [2.5], service_duration: 300,
    time_window: { earliest: 37800, latest: 43200 } } });
  const { customer } = orderOf(globe, NOTHING_TYPED, [13, 52]);
  assert.deepEqual([customer.id, customer.demand], ['order-4', [1]]);
  assert.ok(!('time_window' in customer));
  const two = { ...globe, fleet: [{ id: 'van', count: 1, capacity: [9, 9] }] };
  for (const amount of ['2; 3', '2, 3', '2 3', '2;3']) {
    assert.deepEqual(orderOf(two, { ...NOTHING_TYPED, amount }, [1, 1]).customer.demand, [2, 3]);
  }
});

test('what can not be read is named by its field', () => {
  const typed = { place: 'x', amount: '-1', opens: 'noon', closes: '9:00', name: 'Ostkreuz' };
  assert.deepEqual(orderOf(globe, typed, null).wrong, ['place', 'amount', 'opens', 'name']);
  assert.deepEqual(orderOf(globe, { ...NOTHING_TYPED, amount: '1 2' }, [1, 1]).wrong, ['amount']);
  const early = { ...NOTHING_TYPED, opens: '10:00', closes: '9:00' };
  assert.deepEqual(orderOf(globe, early, [1, 1]).wrong, ['closes']);
});

test('now is told for a plan of today alone, in its zone', () => {
  const day = { plan_start: '2026-11-26T00:00:00+01:00', time_zone: 'Europe/Berlin' };
  assert.equal(nowOf(day, new Date('2026-11-26T09:40:30Z')), 38400);
  assert.equal(nowOf(day, new Date('2026-11-25T09:40:00Z')), null);
  assert.equal(nowOf(day, new Date('2026-11-26T23:30:00Z')), null);
  assert.equal(nowOf({}, new Date()), null);
  const later = { plan_start: '2026-11-26T08:00:00Z' };
  assert.equal(nowOf(later, new Date('2026-11-26T07:00:00Z')), null);
  assert.equal(nowOf(later, new Date('2026-11-26T09:00:00Z')), 3600);
});

const stop = (id, at, kind = 'customer') =>
  ({ kind, id, arrival: at, service_start: at, departure: at + 60 });
const plan = { routes: [{ vehicle: 'van-1', type: 'van', trips: [{ sorties: [], stops: [
  stop('Westhafen', 0, 'depot'), stop('Ostkreuz', 600), stop('Charité', 1200),
  stop('Westhafen', 1800, 'depot')] }] }] };
const ahead = { ...globe, replan: { plan, freeze_before: 700, pinned: ['Charité'] } };

test('who is served, or driven to, is not cancelled', () => {
  // At 700 the van has left Ostkreuz, and is on its way to Charité.
  const { request, settled } = withoutOrders(ahead, ['Ostkreuz', 'Charité', 'address']);
  assert.deepEqual(settled, ['Ostkreuz', 'Charité']);
  assert.deepEqual(request.customers.map(({ id }) => id), ['Ostkreuz', 'Charité']);
  const earlier = { ...ahead, replan: { ...ahead.replan, freeze_before: 300 } };
  const early = withoutOrders(earlier, ['Ostkreuz', 'Charité']);
  assert.deepEqual(early.settled, ['Ostkreuz']);
  assert.deepEqual(early.request.replan.pinned, []);
  assert.deepEqual(withoutOrders(globe, ['Ostkreuz']).settled, []);
});

test('who was cancelled too late is back', () => {
  const without = { ...ahead, customers: globe.customers.slice(2) };
  const { request, back } = withSettled(without, globe);
  assert.deepEqual(back, ['Ostkreuz', 'Charité']);
  assert.equal(request.customers.length, 3);
  assert.equal(withSettled(ahead, globe).request, ahead);
  assert.equal(withSettled(without, undefined).request, without);
});

test('places are sought on one trip more, which is taken only where it is needed', () => {
  const { base, asked } = askedFor(globe, plan, 900);
  assert.equal(base.replan.freeze_before, 900);
  assert.equal(asked.fleet[0].max_trips, 2);
  assert.ok(!('max_trips' in base.fleet[0]));
  assert.ok(!('replan' in askedFor(globe, plan, null).base));
  const own = { vehicle: 'van-1', position: { own_trip: true } };
  assert.ok(takesAnotherTrip(base, plan, own));
  assert.ok(!takesAnotherTrip(base, plan, { ...own, vehicle: 'van-2' }));
  assert.ok(!takesAnotherTrip(base, plan, { ...own, position: { own_trip: false } }));
  const further = withAnotherTrip(base, plan, own);
  assert.equal(further.fleet[0].max_trips, 2);
  assert.ok(!takesAnotherTrip(further, plan, own));
});

test('what drones save is a share of what trucks alone cost, if both serve all', () => {
  const told = { saves: 20, trucks_alone: { cost: { total: 100 }, unassigned: 0 },
    with_drones: { cost: { total: 80 }, unassigned: 0 } };
  assert.equal(savedShare(told), 0.2);
  assert.equal(savedShare({ ...told, saves: null }), null);
  assert.equal(savedShare({ ...told, trucks_alone: null }), null);
  assert.equal(savedShare({ ...told, with_drones: { unassigned: 1 } }), null);
  assert.equal(savedShare(undefined), null);
});

test('drones that fly are counted once, and whom they serve', () => {
  const flight = (drone, ...ids) => ({ drone, customers: ids.map((id) => ({ id })) });
  const entry = { request: { fleet: [{ id: 'van', drones: { count: 2 } }, { id: 'bike' }] },
    plan: { routes: [
      { type: 'van', trips: [{ sorties: [flight('van-1/drone-1', 'A'),
        flight('van-1/drone-1', 'B', 'C')] }, { sorties: [flight('van-1/drone-2', 'D')] }] },
      { type: 'bike', trips: [{}] }] } };
  assert.deepEqual(flownIn(entry), { drones: 2, customers: 4, ofHubs: 0, present: 2 });
});
