import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  addressOf, candidateInWords, doubtedPlaces, doubtsOfImport, placeOf, soughtIn, withDepot,
  withFound, withPlace,
} from '../../../app/console/static/js/core/places.js';

const request = {
  depots: [{ id: 'hub', location: { address: 'Hub 1' } }],
  customers: [
    { id: 'A', location: { address: 'Ring 1' } },
    { id: 'B', location: [10, 50] },
    { id: 'C', location: { address: 'Ring' } },
    { id: 'D', location: { address: 'Nowhere' } },
  ],
  fleet: [{ id: 'van', start_location: { address: 'Home 1' }, end: { location: [10, 51] } }],
};
const house = (lon) => ({ location: [lon, 50], label: 'x', quality: 'house' });
const replies = new Map([
  ['Hub 1', { places: [house(1)], doubt: null }],
  ['Home 1', { places: [house(2)], doubt: null }],
  ['Ring 1', { places: [{ ...house(3), quality: 'street' }], doubt: 'its street alone' }],
  ['Ring', { places: [house(4), house(5)], doubt: 'several' }],
  ['Nowhere', { places: [], doubt: null }],
]);

test('a place is coordinates or an address', () => {
  assert.deepEqual(placeOf(request.customers[1]), [10, 50]);
  assert.equal(placeOf(request.customers[0]), null);
  assert.equal(placeOf({}), null);
  assert.equal(addressOf(request.customers[0]), 'Ring 1');
  assert.equal(addressOf(request.customers[1]), null);
});

test('addresses are sought of depots, customers, starts and ends', () => {
  assert.deepEqual(soughtIn(request).map(({ key }) => key),
    ['depot hub', 'c:A', 'c:C', 'c:D', 'start van']);
});

test('what is found takes the place of its address, the rest stays and is told', () => {
  const found = withFound(request, replies);
  assert.deepEqual(found.request.depots[0].location, [1, 50]);
  assert.deepEqual(found.request.fleet[0].start_location, [2, 50]);
  assert.deepEqual(found.request.customers.map(placeOf), [[3, 50], [10, 50], null, null]);
  assert.equal(request.customers[0].location.address, 'Ring 1');
  assert.deepEqual(doubtedPlaces(found.request, found.doubts), [
    { id: 'A', key: 'c:A', address: 'Ring 1', doubt: 'its street alone' },
    { id: 'C', key: 'c:C', address: 'Ring', doubt: null },
    { id: 'D', key: 'c:D', address: 'Nowhere', doubt: null },
  ]);
});

test('who is put elsewhere is no longer doubted', () => {
  const { request: found, doubts } = withFound(request, replies);
  const moved = withPlace(withPlace(found, 'A', [3.1, 50]), 'D', [6, 50]);
  assert.deepEqual(doubtedPlaces(moved, doubts).map(({ id }) => id), ['C']);
  assert.deepEqual(withDepot(found, [9, 9]).depots, [{ id: 'hub', location: [9, 9] }]);
});

test('doubts of an import are those of its rows that were looked up', () => {
  const reply = {
    request: { customers: [
      { id: 'A', location: [3, 50], info: { address: 'Ring 1' } },
      { id: 'B', location: [10, 50], info: { address: 'Ring 2' } },
    ] },
    looked_up: { places: [
      { address: 'Ring 1', location: [3, 50], doubt: 'its street alone' },
      { address: 'Ring 2', location: [10, 50], doubt: null },
    ] },
  };
  assert.deepEqual(Object.keys(doubtsOfImport(reply)), ['c:A']);
  assert.deepEqual(doubtsOfImport({ request: null, looked_up: null }), {});
});

test('candidates below a house say what they are', () => {
  assert.equal(candidateInWords({ label: 'Ring', quality: 'street' }), 'Ring (the street alone)');
  assert.equal(candidateInWords({ label: 'Ring 1', quality: 'house' }), 'Ring 1');
});
