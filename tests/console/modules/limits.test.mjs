import assert from 'node:assert/strict';
import test from 'node:test';
import { fittingSeconds, limitOf, shortSeconds } from '../../../app/console/static/js/core/limits.js';

const of = (count, options) => ({ customers: Array(count).fill({}), ...(options && { options }) });

test('time grows somewhat faster than the customers', () => {
  const found = [0, 100, 1000, 5000, 20_000, 100_000].map((count) => fittingSeconds(of(count)));
  assert.deepEqual(found, [1, 1, 3, 20, 110, 750]);
});

test('no more is asked for than the service allows', () => {
  assert.equal(fittingSeconds(of(20_000), 60), 60);
});

test('what the user states holds, zero too', () => {
  assert.deepEqual(limitOf(of(20_000, { time_limit: 5 })), { seconds: 5, isChosen: false });
  assert.deepEqual(limitOf(of(20_000, { time_limit: 0 })), { seconds: 0, isChosen: false });
  assert.deepEqual(limitOf(of(20_000, { seed: 1 })), { seconds: 110, isChosen: true });
});

test('a short search has time for what comes before it', () => {
  assert.deepEqual([0, 2000, 20_000].map((count) => shortSeconds(of(count))), [1, 1, 8]);
});
