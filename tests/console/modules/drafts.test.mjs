import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  identifier, isKeptAlike, isUnsaved, pack, partsOf, unpack,
} from '../../../app/console/static/js/core/drafts.js';

let count = 0;
const identify = identifier(() => `part-${(count += 1)}`);

const plan = { cost: { total: 5 } };
const first = { customers: [{ id: 'A' }] };
const second = { customers: [{ id: 'A' }, { id: 'B' }], replan: { now: 60, plan } };
const third = { customers: [] };
const fourth = { customers: [{ id: 'C' }] };

const state = {
  name: 'Monday',
  note: '',
  home: null,
  request: second,
  past: [first],
  ahead: [fourth],
  plans: [{ number: 1, request: first, plan, name: 'one more van' }],
  saved: { request: first, plan },
  shown: 1,
  besides: null,
  run: { state: 'idle' },
  scenario: { kind: 'compare', body: { base: first }, result: null, job: 'j', state: 'running' },
  tab: 'fleet',
  scenarioSeconds: 2,
  keptFleets: {},
  sweepAxes: [],
};

/** Return what a browser gives back of a state: copies. */
function kept(of) {
  const { head, parts } = pack(of, identify);
  return [structuredClone(head), new Map([...parts].map((part) => structuredClone(part)))];
}

test('what was open comes back, and what is the same object is it again', () => {
  const back = unpack(...kept(state), identify);
  assert.deepEqual(back.request, second);
  assert.deepEqual(back.plans, state.plans);
  assert.equal(back.plans[0].request, back.past[0]);
  assert.equal(back.plans[0].request, back.saved.request);
  assert.equal(back.plans[0].plan, back.request.replan.plan);
  assert.equal(back.plans[0].plan, back.saved.plan);
  assert.deepEqual(back.scenario, state.scenario);
  assert.equal(back.tab, 'fleet');
  assert.equal(back.cut, null);
});

test('how times were written when it was opened comes back', () => {
  const stated = { customers: [{ id: 'A', time_window: { earliest: '7:30' } }] };
  assert.deepEqual(unpack(...kept({ ...state, stated }), identify).stated, stated);
  const { head, parts } = pack(state, identify);
  const { doubts, ...older } = head; // as a former version kept it
  assert.equal('stated' in unpack(older, parts, identify), false);
  assert.equal('doubts' in unpack(older, parts, identify), false);
});

test('what was being planned is known again by its job', () => {
  const run = { state: 'improving', number: 2, job: 'x', request: second, points: [] };
  const back = unpack(...kept({ ...state, run }), identify);
  assert.deepEqual([back.cut.number, back.cut.job], [2, 'x']);
  assert.equal(back.cut.request, back.request);
});

test('what came back is known: only what is new is written', () => {
  const [head, parts] = kept(state);
  const back = { ...state, ...unpack(head, parts, identify), run: { state: 'idle' } };
  assert.deepEqual(partsOf(pack(back, identify).head).sort(), partsOf(head).sort());
});

test('parts are named once, so that an edit writes one more', () => {
  const before = new Set(partsOf(pack(state, identify).head));
  const after = partsOf(pack({ ...state, request: third, past: [first, second] }, identify).head);
  assert.equal(after.filter((id) => !before.has(id)).length, 1);
});

test('what misses a part is not half restored', () => {
  const [head, parts] = kept(state);
  parts.delete(head.plans[0].plan);
  assert.equal(unpack(head, parts, identify), null);
});

test('only what is kept has it kept again', () => {
  assert.ok(isKeptAlike(state, { ...state, time: 5, hover: 'c:A' }));
  assert.ok(!isKeptAlike(state, { ...state, request: third }));
  assert.ok(!isKeptAlike(state, { ...state, run: { state: 'improving', job: 'x' } }));
});

test('unsaved is what differs from what is kept, or was never kept', () => {
  const opened = { ...state, request: first, saved: { request: first, plan: null } };
  assert.ok(!isUnsaved(opened));
  assert.ok(isUnsaved({ ...opened, request: third }));
  assert.ok(isUnsaved({ ...opened, saved: null }));
  const home = { where: 'browser', id: 'x', version: '1' };
  assert.ok(isUnsaved({ ...opened, home }));
  assert.ok(!isUnsaved({ ...opened, home, saved: { request: first, plan } }));
  const planless = { ...opened, home, request: third, saved: { request: third, plan: null } };
  assert.ok(!isUnsaved(planless), 'the plan is one of the problem as it was');
});
