import assert from 'node:assert/strict';
import test from 'node:test';

import { drivesStraight, standingWarnings } from '../../../app/console/static/js/core/warned.js';

const swapped = { code: 'LOOKS_SWAPPED', path: '$.customers[1].location', message: 'far' };
const crow = { code: 'AS_THE_CROW_FLIES', path: '$.fleet[0].profile', message: 'no roads' };
const request = { customers: [{ id: 'A' }, { id: 'B', location: [48, 11] }], fleet: [{}] };
const warned = { request, warnings: [swapped, crow] };

const codes = (...rest) => standingWarnings(warned, ...rest).map(({ code }) => code);

test('warnings stand until what they are about is changed', () => {
  assert.deepEqual(codes(request, []), ['LOOKS_SWAPPED']);
  const moved = { ...request, customers: [request.customers[0], { id: 'B', location: [11, 48] }] };
  assert.deepEqual(codes(moved, []), []);
  assert.deepEqual(standingWarnings(null, request, []), []);
});

test('what is dismissed is not shown, and comes back only for another problem', () => {
  const keys = standingWarnings(warned, request, []).map(({ key }) => key);
  assert.deepEqual(codes(request, keys), []);
  const other = { ...swapped, message: 'farther' };
  assert.equal(standingWarnings({ request, warnings: [other] }, request, keys).length, 1);
});

test('ways are told to be straight where there is something that drives', () => {
  const plan = { warnings: [crow] };
  assert.equal(drivesStraight({ request, plan }), true);
  assert.equal(drivesStraight({ request, plan: { warnings: [] } }), false);
  assert.equal(drivesStraight({ request: { ...request, fleet: [{ flies: true }] }, plan }), false);
});

test('a warning knows the way to what it is about', () => {
  assert.deepEqual(standingWarnings(warned, request, [])[0].keys, ['customers', 1, 'location']);
});
