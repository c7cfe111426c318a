import assert from 'node:assert/strict';
import test from 'node:test';
import { indexPlan } from '../../../app/console/static/js/core/plan.js';
import {
  changesOf, doubtsOf, lateInWords, lateOf, liveRemedyInWords, locksOf, pinsOf, remedyFor, sightingsOf,
  slotsFor, untoldOf, waitingOf, withUntold,
} from '../../../app/console/static/js/core/living.js';

const customer = (id, more = {}) => ({ id, location: [0, 0], demand: [1], ...more });
const BASE = { customers: [customer('A'), customer('B')], fleet: [{ shift: { latest: 43200 } }] };

function indexed(served, out = []) {
  return {
    plan: { unassigned: out.map((id) => ({ id, reasons: [] })) },
    customers: new Map([...Object.keys(served), ...out].map((id) => [id, {}])),
    halts: new Map(Object.entries(served).map(([id, [name, arrival, lateness = 0]]) =>
      [`c:${id}`, { vehicle: { name }, arrival, lateness }])),
  };
}

test('what changed a moment ago is told by customer', () => {
  const before = indexed({ A: ['van-1', 100], B: ['van-1', 200], C: ['van-2', 300], D: ['v', 1] });
  const after = indexed({ A: ['van-1', 130], B: ['van-2', 200], C: ['van-2', 900], N: ['v', 5] },
    ['D']);
  const kinds = [...changesOf(before, after)].map(([key, { kind, text }]) => [key, kind, text]);
  assert.deepEqual(kinds, [
    ['c:B', 'moved', '\u2192 van-2'], ['c:C', 'later', '+10 min'], ['c:N', 'new', 'new'],
    ['c:D', 'out', 'left out'],
  ]);
  assert.equal(changesOf(null, after).size, 0);
});

test('who is late, waits or is in doubt is told by how the day stands', () => {
  const order = (id, state, more) => ({ id, state, vehicle: 'van-1', arrival: 900, told: 900,
    ...more });
  const day = { orders: [
    order('A', 'planned'), order('B', 'planned', { told: 200 }), order('C', 'planned'),
    order('D', 'waiting'), order('E', 'doubtful', { told: 0 }), order('F', 'doubtful'),
    order('G', 'left_out', { vehicle: null, pinned: { vehicle: null, after: null } }),
  ] };
  const index = indexed({ A: ['van-1', 900], C: ['van-1', 900, 3600] });
  assert.deepEqual(lateOf(day, index).map(({ id, by }) => [id, by]), [['C', 3600], ['B', 700]]);
  assert.deepEqual(waitingOf(day, index.plan).map(({ id, isByHand }) => [id, isByHand]),
    [['D', false], ['G', true]]);
  const outlook = [{ id: 'A', leaves: false, departure: 3600, futures: 30, later_in: 26,
    saved: 3.1 }];
  assert.deepEqual(waitingOf(day, { ...index.plan, outlook })[0], { id: 'A', key: 'c:A',
    isByHand: false, why: 'Waits: in 26 of 30 futures it leaves at 1:00, for 3.10 less' });
  const risky = { orders: [order('A', 'planned', { at_risk: true, chance: 0.3 })] };
  assert.deepEqual(lateOf(risky, index).map(lateInWords), ['may be late (30 %)']);
  assert.deepEqual(doubtsOf(day).map(([vehicle, orders]) => [vehicle, orders.length]),
    [['van-1', 2]]);
});

test('a remedy is offered while the plan is the one that it was told for', () => {
  const events = [{ kind: 'order.pinned', order: 'B', vehicle: 'van-2' },
    { kind: 'order.pinned', order: 'A', vehicle: 'van-2', after: 'B' }];
  const remedy = { code: 'serve_sooner', vehicle: 'van-2', arrival: 1300, cost: 12.4, events };
  const order = { id: 'B', state: 'planned', vehicle: 'van-1', remedy, pinned: null };
  const day = (vehicle) => ({ orders: [order, { id: 'A', state: 'planned', vehicle }] });
  assert.equal(remedyFor(day('van-2'), order), remedy);
  assert.equal(liveRemedyInWords(remedy), 'van-2 serves it at 0:22 (+12.40)');
  assert.equal(remedyFor(day('van-1'), order), null);
  assert.equal(remedyFor(day('van-2'), { ...order, pinned: { vehicle: 'van-1' } }), null);
  assert.equal(remedyFor(day('van-2'), { ...order, remedy: null }), null);
});

test('where vehicles were seen is told with how long ago that was', () => {
  const seen = { vehicle: 'van-1', position: [11.5, 48.1], position_at: 60 };
  assert.deepEqual(sightingsOf({ now: 180, vehicles: [seen, { vehicle: 'v', position: null }] }), [
    { location: [11.5, 48.1], text: 'van-1, 2 min ago' }]);
});

test('what is edited and not told yet stays where others tell something', () => {
  const edited = { ...BASE, customers: [customer('A', { demand: [2] }), customer('N')] };
  const events = untoldOf(BASE, edited);
  assert.deepEqual(events.map(({ kind, customer: stated, order }) => [kind, stated?.id ?? order]), [
    ['order.changed', 'A'], ['order.placed', 'N'], ['order.cancelled', 'B']]);
  const others = { ...BASE, customers: [...BASE.customers, customer('Z')] };
  assert.deepEqual(withUntold(others, events).customers.map(({ id }) => id), ['A', 'Z', 'N']);
  assert.deepEqual(untoldOf(BASE, { ...BASE, customers: BASE.customers.map((each) => ({ ...each }))
  }), []);
});

test('slots are those ahead, unless one was asked for', () => {
  assert.deepEqual(slotsFor(BASE, { time_window: { earliest: 1, latest: 2 } }, 0, 0),
    [{ earliest: 1, latest: 2 }]);
  assert.deepEqual(slotsFor(BASE, {}, 35000, 40000), [{ earliest: 35000 },
    { earliest: 36000, latest: 43200 }]);
});

test('where orders were put by hand is told by who they are between', () => {
  const at = (name, second) => ({ kind: 'customer', id: name, arrival: second,
    service_start: second, departure: second });
  const hub = (second) => ({ kind: 'depot', id: 'hub', arrival: second, departure: second });
  const request = { depots: [{ id: 'hub', location: [0, 0] }], fleet: [{ id: 'van', count: 2 }],
    customers: ['A', 'B', 'C', 'D', 'E'].map((id) => customer(id)) };
  const plan = { unassigned: [], summary: { trips: 2 }, cost: { total: 0 }, routes: [
    { vehicle: 'van-1', type: 'van', trips: [{
      stops: [hub(0), at('C', 1), at('A', 2), at('B', 3), hub(4)], sorties: [] }] },
    { vehicle: 'van-2', type: 'van', trips: [{ stops: [hub(0), at('D', 1), hub(2)], sorties: [] }] },
  ] };
  const index = indexPlan(request, plan, new Map());
  const pin = (order, vehicle, after) => ({ kind: 'order.pinned', order, vehicle,
    ...(after && { after }) });
  assert.deepEqual(pinsOf(index, ['C']), [pin('C', 'van-1'), pin('A', 'van-1', 'C')]);
  assert.deepEqual(pinsOf(index, ['A', 'A', 'gone']),
    [pin('A', 'van-1', 'C'), pin('B', 'van-1', 'A')]);
  assert.deepEqual(pinsOf(index, ['D']), [pin('D', 'van-2')]);
  assert.deepEqual(pinsOf(index, ['E']), [{ kind: 'order.pinned', order: 'E', left_out: true }]);
  assert.deepEqual(locksOf(index, ['A', 'D'], true), [pin('A', 'van-1'), pin('D', 'van-2')]);
  assert.deepEqual(locksOf(index, ['A'], false),
    [{ kind: 'order.pinned', order: 'A', undone: true }]);
});
