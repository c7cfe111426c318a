import assert from 'node:assert/strict';
import test from 'node:test';
import { getIn, parsePath, removeIn, setIn } from '../../../app/console/static/js/core/paths.js';

test('a value is set without a change of the former object', () => {
  const before = { fleet: [{ id: 'a', count: 1 }] };
  const after = setIn(before, ['fleet', 0, 'count'], 2);
  assert.deepEqual(after, { fleet: [{ id: 'a', count: 2 }] });
  assert.equal(before.fleet[0].count, 1);
});

test('what is missing on the way is made', () => {
  assert.deepEqual(setIn({}, ['airspace', 'no_fly', 0], [1]), { airspace: { no_fly: [[1]] } });
});

test('fields and entries are removed', () => {
  assert.deepEqual(removeIn({ a: { b: 1, c: 2 } }, ['a', 'b']), { a: { c: 2 } });
  assert.deepEqual(removeIn({ a: [1, 2, 3] }, ['a', 1]), { a: [1, 3] });
  assert.equal(getIn({ a: null }, ['a', 'b']), undefined);
});

test("an error's path is taken apart", () => {
  assert.deepEqual(parsePath('$.customers[3].time_window.latest'), [
    'customers',
    3,
    'time_window',
    'latest',
  ]);
  assert.deepEqual(parsePath("$.matrices['my truck'].durations[0][1]"), [
    'matrices',
    'my truck',
    'durations',
    0,
    1,
  ]);
  assert.deepEqual(parsePath('$'), []);
});
