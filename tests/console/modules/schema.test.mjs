import assert from 'node:assert/strict';
import test from 'node:test';
import {
  blank,
  choiceOf,
  emptyMeans,
  kindOf,
  labelOf,
  resolve,
  unitOf,
  wordLines,
  wordsOf,
} from '../../../app/console/static/js/core/schema.js';
import {
  heatTable,
  readValues,
  variableFields,
  writeAt,
} from '../../../app/console/static/js/core/grid.js';

const SCHEMAS = {
  Costs: {
    type: 'object',
    properties: {
      per_km: { type: 'number', default: 1, description: 'Cost per kilometre driven.' },
    },
  },
  DronesInput: {
    type: 'object',
    required: ['count'],
    properties: { count: { type: 'integer', minimum: 0 } },
  },
  VehicleTypeInput: {
    type: 'object',
    required: ['id', 'capacity'],
    properties: {
      id: { type: 'string' },
      capacity: { type: 'array', items: { type: 'number' }, minItems: 1 },
      longest: {
        anyOf: [{ type: 'number', minimum: 0 }, { type: 'null' }],
        default: null,
        description: 'Longest time in seconds. Null: no limit.',
      },
      costs: { $ref: '#/components/schemas/Costs', description: 'What it costs.' },
      drones: { anyOf: [{ $ref: '#/components/schemas/DronesInput' }, { type: 'null' }] },
    },
  },
};

test('some of few values are boxes to check, and words of a field come first', () => {
  const items = { enum: ['tolls', 'ferries'], type: 'string' };
  assert.equal(kindOf({ type: 'array', items }), 'several');
  assert.equal(choiceOf('any'), 'at any time');
  assert.equal(choiceOf('any', 'approach'), 'from either side');
  assert.equal(choiceOf('last', 'approach'), choiceOf('last'));
});

test('references are followed and null is told apart', () => {
  const { schema, nullable } = resolve(SCHEMAS, SCHEMAS.VehicleTypeInput.properties.longest);
  assert.deepEqual(
    [schema.type, nullable, unitOf(schema), emptyMeans(schema, nullable)],
    ['number', true, 's', 'no limit'],
  );
  assert.equal(
    kindOf(resolve(SCHEMAS, SCHEMAS.VehicleTypeInput.properties.costs).schema),
    'object',
  );
});

test('names become words', () => {
  assert.equal(labelOf('max_trip_distance'), 'Max trip distance');
  assert.equal(labelOf('speed_kmh'), 'Speed km/h');
});

test('a new entry has what is required and nothing else', () => {
  assert.deepEqual(blank(SCHEMAS, SCHEMAS.VehicleTypeInput), { id: '', capacity: [0] });
});

test('every number of a vehicle type can be swept', () => {
  const fields = variableFields(SCHEMAS, [{ capacity: [1, 2], drones: { count: 1 } }]);
  assert.deepEqual(
    fields.map(({ path }) => path),
    [
      'fleet[*].capacity[0]',
      'fleet[*].capacity[1]',
      'fleet[*].longest',
      'fleet[*].costs.per_km',
      'fleet[*].drones.count',
    ],
  );
});

test('values are read as times or as numbers', () => {
  assert.deepEqual(readValues('4:00, 5:30', 's'), [14400, 19800]);
  assert.deepEqual(readValues('100, 150', ''), [100, 150]);
  assert.equal(readValues('100, many', ''), null);
});

test('a value is written to every place of a path', () => {
  const request = { fleet: [{ capacity: [1] }, { capacity: [2] }] };
  assert.deepEqual(writeAt(request, 'fleet[*].capacity[0]', 9), {
    fleet: [{ capacity: [9] }, { capacity: [9] }],
  });
  assert.deepEqual(writeAt(request, 'fleet[1].count', 3).fleet[1], { capacity: [2], count: 3 });
});

test("a sweep's cells become a table, the last axis across", () => {
  const cells = [1, 2, 3, 4, 5, null].map((cost) => ({ cost }));
  const table = heatTable({ axes: [{ values: [10, 20] }, { values: [7, 8, 9] }], cells });
  assert.deepEqual(
    table.cells.map((row) => row.map(({ cost }) => cost)),
    [
      [1, 2, 3],
      [4, 5, null],
    ],
  );
  assert.deepEqual([table.least, table.most], [1, 5]);
});

test('texts by name are written as lines and read again', () => {
  assert.equal(kindOf({ type: 'object', additionalProperties: { type: 'string' } }), 'words');
  const words = { phone: '089 1234', notes: 'gate 3: ring' };
  assert.equal(wordLines(words), 'phone: 089 1234\nnotes: gate 3: ring');
  assert.deepEqual(wordsOf(wordLines(words)), words);
  assert.deepEqual(wordsOf(' \n'), {});
  assert.equal(wordsOf('no name'), null);
});
