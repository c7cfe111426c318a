import assert from 'node:assert/strict';
import { test } from 'node:test';

import { callBy, labelOfVehicle, nameOfVehicle } from '../../../app/console/static/js/core/vehicle-labels.js';

function labels(...types) {
  const fleet = types.map(([id, count]) => ({ id, count }));
  return fleet.flatMap(({ id, count }) => Array.from({ length: count }, (_, index) =>
    labelOfVehicle(fleet, `${id}-${index + 1}`, id)));
}

test('vehicles of one type have their own numbers', () => {
  assert.deepEqual(labels(['van', 3]), ['1', '2', '3']);
  const fleet = [{ id: 'van', count: 9 }];
  assert.equal(labelOfVehicle(fleet, 'van-7', 'van'), '7');
});

test('types whose names are numbered have these numbers', () => {
  assert.deepEqual(labels(['van-1', 1], ['van-2', 1], ['van 10', 1]), ['1', '2', '10']);
  assert.deepEqual(labels(['van-150', 2], ['van-200', 1]), ['150-1', '150-2', '200']);
});

test('where several types have the same numbers, letters tell them apart', () => {
  assert.deepEqual(labels(['drone-truck', 2], ['van', 2]), ['DT1', 'DT2', 'V1', 'V2']);
  assert.deepEqual(labels(['truck', 1], ['trike', 2]), ['TRU', 'TRI1', 'TRI2']);
});

test('drivers by name have letters alone, all unlike', () => {
  assert.deepEqual(labels(['Anna', 1], ['Ben', 1], ['Anton', 1]), ['ANN', 'B', 'ANT']);
  assert.deepEqual(labels(['a', 1], ['ab', 1], ['7', 1]), ['A', 'AB', '7']);
});

test('a vehicle of a type that the fleet has no more is known by its number', () => {
  assert.equal(labelOfVehicle([{ id: 'van', count: 1 }], 'truck-4', 'truck'), '4');
});

test('a lone vehicle is called as its type, others by their names where they have some', () => {
  callBy([{ id: 'van', count: 1 }, { id: 'bike', count: 2, names: ['Anna'] }]);
  assert.deepEqual(
    ['van-1', 'van-1/drone-2', 'bike-1', 'bike-2', 'bike-3', 'other-1'].map(nameOfVehicle),
    ['van', 'van/drone-2', 'Anna', 'bike-2', 'bike-3', 'other-1'],
  );
  callBy([]);
});
