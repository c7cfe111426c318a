import assert from 'node:assert/strict';
import { test } from 'node:test';

import { legsInWords } from '../../../app/console/static/js/core/legs.js';

const LEG = { profile: 'truck', engine: null, estimated: 0, detour: null, note: null };

test('trucks on roads are said to be', () => {
  const legs = [
    { ...LEG, by: 'roads', engine: 'osrm' },
    { ...LEG, profile: 'drone', by: 'flight' },
  ];
  assert.deepEqual(legsInWords(legs), ['truck: by roads (osrm)']);
});

test('what is avoided on roads is told', () => {
  const legs = [{ ...LEG, by: 'roads', engine: 'osrm', avoid: ['ferries', 'tolls'] }];
  assert.deepEqual(legsInWords(legs), ['truck: by roads (osrm) without ferries, tolls']);
});

test('estimated legs are counted', () => {
  const [line] = legsInWords([
    { ...LEG, by: 'roads', engine: 'osrm', estimated: 12, detour: 1.3, note: 'So it is.' },
  ]);
  assert.equal(line, 'truck: by roads (osrm), 12 legs estimated (detour 1.3).');
});

test('as the crow flies is told in the words of the page', () => {
  const legs = [{ ...LEG, by: 'great_circle', note: 'No roads.' }];
  assert.deepEqual(legsInWords(legs), ['truck: as the crow flies.']);
});

test('plans of former versions tell nothing', () => {
  assert.deepEqual(legsInWords(undefined), []);
});
