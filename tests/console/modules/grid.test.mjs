import assert from 'node:assert/strict';
import test from 'node:test';

import { axesAround, readValues, valuesAround } from '../../../app/console/static/js/core/grid.js';

const fleet = [
  { id: 'van', count: 3, capacity: [800, 4], max_working_duration: 28800, costs: { per_km: 0.4 } },
  { id: 'bike', count: 2, capacity: [60, 1] },
];

test('a sweep begins around the fleet at hand', () => {
  assert.deepEqual(axesAround(fleet), [
    { path: 'fleet[*].max_working_duration', text: '6:00, 8:00, 10:00, 12:00' },
    { path: 'fleet[*].capacity[0]', text: '600, 800, 1000, 1200' },
  ]);
  const [first, second] = axesAround([{ id: 'van', count: 3, capacity: [0] }]);
  assert.deepEqual(first, { path: 'fleet[*].count', text: '2, 3, 4' });
  assert.deepEqual(second, { path: '', text: '' });
});

test('a field that is chosen begins around what the fleet has, and is read back', () => {
  const text = valuesAround(fleet, { path: 'fleet[*].costs.per_km', unit: '' });
  assert.deepEqual(readValues(text, ''), [0.3, 0.4, 0.5, 0.6]);
  assert.equal(valuesAround(fleet, { path: 'fleet[*].reload_duration', unit: 's' }), '');
  const hours = valuesAround(fleet, { path: 'fleet[*].max_working_duration', unit: 's' });
  assert.deepEqual(readValues(hours, 's'), [21600, 28800, 36000, 43200]);
});
