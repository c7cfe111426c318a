import assert from 'node:assert/strict';
import test from 'node:test';

import { costTerms, judged, servesFewer } from '../../../app/console/static/js/core/terms.js';

test('terms are those that cost anything in some plan, in the order of the service', () => {
  const former = { total: 5, fixed: 5, time: 0, overtime: 0 };
  const next = { total: 7, fixed: 4, time: 0, overtime: 3 };
  assert.deepEqual(costTerms(former, next), [
    ['fixed', 'Vehicles used'],
    ['overtime', 'Overtime'],
  ]);
});

test('a plan of before a term was known lacks it', () => {
  assert.deepEqual(costTerms({ total: 1, fixed: 1 }, { total: 2, fixed: 1, stops: 1 }), [
    ['fixed', 'Vehicles used'],
    ['stops', 'Customers of trucks'],
  ]);
});

test('less cost is a saving, unless fewer are served for it', () => {
  assert.equal(judged(-5, false), 'delta-good');
  assert.equal(judged(-5, true), '');
  assert.equal(judged(5, true), 'delta-bad');
  assert.equal(judged(0.001, false), '');
  const plan = (served) => ({ plan: { summary: { served } } });
  assert.equal(servesFewer(plan(2), plan(5)), true);
  assert.equal(servesFewer(plan(5), plan(5)), false);
});
