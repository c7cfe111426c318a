import assert from 'node:assert/strict';
import test from 'node:test';
import { removeCustomers } from '../../../app/console/static/js/core/changes.js';
import { presetOf, withEntry, withoutEntry } from '../../../app/console/static/js/core/presets.js';
import {
  needlessIn, ofTheirKinds, relate, renamed, withShipments,
} from '../../../app/console/static/js/core/relations.js';
import {
  helpOf, kindOf, resolve, wordLines, wordsOf,
} from '../../../app/console/static/js/core/schema.js';
import { parseNumber } from '../../../app/console/static/js/core/format.js';

const REQUEST = {
  customers: ['A', 'B', 'C'].map((id) => ({ id, location: [1, 2] })),
  relations: [
    { kind: 'together', customers: ['A', 'B'] },
    { kind: 'before', customers: ['A', 'B', 'C'], min_lag: 60 },
  ],
};

test('a relation has the fields of its kind, and those that are stated', () => {
  assert.deepEqual(needlessIn({ kind: 'before' }), ['scope']);
  assert.deepEqual(needlessIn({ kind: 'apart', min_lag: 5 }), ['max_lag', 'same_vehicle']);
  assert.deepEqual(relate({}, 'apart', ['A', 'B']).relations, [
    { kind: 'apart', customers: ['A', 'B'] },
  ]);
});

test('what was an order says nothing of orders under another kind', () => {
  const apart = { ...REQUEST, relations: [
    REQUEST.relations[0], { ...REQUEST.relations[1], kind: 'apart' }] };
  assert.deepEqual(ofTheirKinds(REQUEST, apart).relations, [
    REQUEST.relations[0], { kind: 'apart', customers: ['A', 'B', 'C'] }]);
  assert.deepEqual(ofTheirKinds(apart, apart), apart);
  assert.deepEqual(ofTheirKinds(REQUEST, { customers: [] }), { customers: [] });
});

test('whoever is removed is named no longer, and a relation of one is left out', () => {
  assert.deepEqual(removeCustomers(REQUEST, ['A']).relations, [
    { kind: 'before', customers: ['B', 'C'], min_lag: 60 },
  ]);
  const typed = { ...REQUEST, relations: [{ kind: 'apart', customers: [] }] };
  assert.deepEqual(removeCustomers(typed, ['A']).relations, typed.relations);
  assert.equal('relations' in removeCustomers({ customers: [{ id: 'A' }] }, ['A']), false);
});

test('whoever is renamed is bound under the new name', () => {
  assert.deepEqual(
    renamed(REQUEST, 'B', 'Ben').relations.map(({ customers }) => customers),
    [['A', 'Ben'], ['A', 'Ben', 'C']],
  );
  assert.equal(renamed(REQUEST, 'X', 'Y'), REQUEST);
});

test('ends of shipments are followed as they are renamed, and left out as they go', () => {
  const pair = (id) => ({ id, pickup: {}, delivery: {} });
  const parts = (...names) => ({ id: 't', pickups: names.map((id) => ({ id })), delivery: {} });
  const bound = (...customers) => ({ kind: 'apart', customers });
  const request = { shipments: [pair('s'), parts('x', 'y')], relations: [
    bound('A', 's/pickup'), bound('A', 'B', 't/pickup/x')] };
  const after = (...shipments) => withShipments(request, { ...request, shipments })
    .relations.map(({ customers }) => customers);
  assert.deepEqual(after(pair('new'), parts('x', 'y')),
    [['A', 'new/pickup'], ['A', 'B', 't/pickup/x']]);
  assert.deepEqual(after(pair('s'), parts('z', 'y')), [['A', 's/pickup'], ['A', 'B', 't/pickup/z']]);
  assert.deepEqual(after(pair('s'), parts('y')), [['A', 's/pickup'], ['A', 'B']]);
  assert.deepEqual(after(parts('x', 'y')), [['A', 'B', 't/pickup/x']]);
  assert.equal('relations' in withShipments({}, { shipments: [] }), false);
});

test('another place begins where the customer is', () => {
  assert.deepEqual(presetOf('alternatives', REQUEST, ['customers', 1, 'alternatives']), {
    location: [1, 2],
  });
  assert.equal(presetOf('breaks', REQUEST, []).duration, 1800);
});

test('numbers by name are lines, too', () => {
  assert.equal(kindOf({ type: 'object', additionalProperties: { type: 'number' } }), 'words');
  assert.equal(kindOf({ type: 'object', additionalProperties: false }), 'object');
  assert.deepEqual(wordsOf('van-1: 5\nvan: 2', parseNumber), { 'van-1': 5, van: 2 });
  assert.equal(wordsOf('van-1: many', parseNumber), null);
  assert.equal(wordLines({ van: 120 }, (value) => `${value / 60} min`), 'van: 2 min');
});

test('two lengths are one field', () => {
  const length = { anyOf: [{ type: 'number' }, { type: 'string', title: 'Duration' }] };
  assert.equal(kindOf({ type: 'array', items: length }), 'durations');
});

test('what is said of a field is found by the name of its schema, or of one like it', () => {
  const drones = { anyOf: [{ $ref: '#/DronesInput' }, { type: 'null' }], title: 'Drones' };
  const { schema } = resolve({ DronesInput: { type: 'object', title: 'DronesInput' } }, drones);
  assert.equal(schema.title, 'DronesInput');
  const api = { description: 'As the API says.' };
  const ofCustomers = helpOf('CustomerInput', 'setup_duration', api);
  assert.notEqual(ofCustomers, api.description);
  assert.equal(helpOf('ShipmentPickupInput', 'setup_duration', api), ofCustomers);
  assert.notEqual(helpOf('ShipmentPickupInput', 'amount', api), api.description);
  assert.equal(helpOf('Unknown', 'amount', api), api.description);
});

test('the first of several pickups stands instead of the only one, and the last is it again', () => {
  const keys = ['shipments', 0, 'pickups'];
  const single = { depots: [{ location: [0, 0] }], fleet: [{ capacity: [9] }], shipments: [
    { id: 's1', amount: [4], pickup: { location: [1, 2], served_by: 'either' }, delivery: {} }] };
  const add = (request, id) => (
    withEntry(request, keys, { id, ...presetOf('pickups', request, keys) }));
  const farm = add(single, 'farm');
  const first = { id: 'farm', amount: [4], location: [1, 2], served_by: 'either' };
  assert.deepEqual(farm.shipments, [{ id: 's1', delivery: {}, pickups: [first] }]);
  const both = add(farm, 'mill');
  assert.deepEqual(both.shipments[0].pickups,
    [first, { id: 'mill', amount: [1], location: [0, 0] }]);
  assert.deepEqual(withoutEntry(withoutEntry(both, keys, 1), keys, 0).shipments, [
    { id: 's1', amount: [4], pickup: { location: [1, 2], served_by: 'either' }, delivery: {} }]);
});
