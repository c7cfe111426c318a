import assert from 'node:assert/strict';
import test from 'node:test';
import {
  addressesIn,
  assumedOf,
  corrected,
  byAddress,
  forNextFile,
  isMarked,
  listedFleet,
  madeOf,
  meaningText,
  placing,
  readFields,
  remember,
  signatureOf,
  unplacedIn,
  withAnswer,
  withColumn,
  withoutUnplaced,
} from '../../../app/console/static/js/core/importing.js';
import { pastedSheet } from '../../../app/console/static/js/core/pasted.js';

test('fields become settings, and what cannot be read is named', () => {
  assert.deepEqual(readFields({ depot: ' 48.1, 11.5 ', vehicles: '3', capacity: '800 4.5', shift: '' }), {
    stated: { depot: '48.1, 11.5', vehicles: 3, capacity: [800, 4.5] },
    wrong: [],
  });
  assert.deepEqual(readFields({ vehicles: '2.5', capacity: 'much' }).wrong, ['vehicles', 'capacity']);
});

test('a column means what was said last', () => {
  const column = { heading: 'von', column: 'H' };
  const once = withColumn({ decimals: ',' }, column, { meaning: 'earliest', unit: null });
  const twice = withColumn(once, column, { meaning: 'earliest', unit: 'h.mm' });
  assert.deepEqual(twice, {
    decimals: ',',
    columns: [{ heading: 'von', column: 'H', meaning: 'earliest', unit: 'h.mm' }],
  });
  const remembered = { columns: [{ heading: 'von', column: null, meaning: 'latest', unit: null }] };
  assert.equal(withColumn(remembered, column, { meaning: 'earliest', unit: null }).columns.length, 1);
});

test('mappings are remembered by the headings of their files', () => {
  const signature = signatureOf({
    columns: [
      { heading: 'Name', column: 'A' },
      { heading: '', column: 'B' },
    ],
  });
  assert.equal(signature, 'Name|B');
  const known = remember(remember([], signature, { mapping: 1 }), signature, { mapping: 2 });
  assert.deepEqual(known, [{ signature, mapping: 2 }]);
});

test('what is pasted is a sheet if it has lines of cells', () => {
  assert.equal(pastedSheet('a\tb\n1\t2\n'), 'a\tb\n1\t2\n');
  assert.equal(pastedSheet('just a word'), null);
  assert.equal(pastedSheet('two\nlines'), null);
});

test('answers add up, and those about rows of one file are not kept for another', () => {
  const mapping = withAnswer(withAnswer({ decimals: ',' }, 'day', '2026-11-26'), 'sheet:Di', 'also');
  assert.deepEqual(mapping.answers, { day: '2026-11-26', 'sheet:Di': 'also' });
  const questions = [
    { id: 'day', kind: 'day' },
    { id: 'sheet:Di', kind: 'sheet' },
  ];
  assert.deepEqual(forNextFile(mapping, questions), {
    decimals: ',',
    answers: { 'sheet:Di': 'also' },
  });
  assert.deepEqual(forNextFile({ decimals: ',' }), { decimals: ',' });
});

test('customers of one address are placed at once, and may be left out', () => {
  const ring = { address: 'Ring 1' };
  const at = (id, location) => ({ id, location });
  const request = {
    depots: [],
    fleet: [],
    customers: [at('A', ring), { ...at('B', [1, 2]), alternatives: [at('kiosk', ring)] }],
    shipments: [
      { id: 'S', pickup: { location: [1, 2] }, delivery: { location: ring } },
      { id: 'T', pickup: { location: [1, 2] }, delivery: { location: [1, 3] } },
    ],
  };
  const ids = ['A', 'B/kiosk', 'S/delivery'];
  assert.deepEqual(addressesIn(request), [{ address: 'Ring 1', ids }]);
  assert.deepEqual(addressesIn(null), []);
  assert.deepEqual(unplacedIn(request, { 'Ring 1': [3, 4] }), []);
  assert.deepEqual(byAddress({ 'Ring 1': [3, 4] }).get('Ring 1').places[0].location, [3, 4]);
  const left = withoutUnplaced(request);
  assert.deepEqual(left.customers, [{ ...at('B', [1, 2]), alternatives: [] }]);
  assert.deepEqual(left.shipments.map(({ id }) => id), ['T']);
});

test('columns of other places are told by the place and what they say of it', () => {
  assert.equal(meaningText('pickup_latitude', 'x'), 'Pickup: Latitude');
  assert.equal(meaningText('alternative_cost', 'x'), 'Cost of the other place');
  assert.equal(meaningText('pickup', 'x'), 'Amount to pick up');
  assert.equal(meaningText('newest', 'Newest'), 'Newest');
});

test('what was made of a cell is told where it is not what stands there', () => {
  const made = (meaning, raw, read) => madeOf(meaning, { raw, read });
  assert.equal(made('name', 'Anna', 'Anna'), '');
  assert.equal(made('ignored', '7', '7'), '');
  assert.equal(made('service', '30', '30 min'), '30 min');
  assert.equal(made('latest', '10:30', '10:30'), 'by 10:30');
  assert.equal(made('pickup_earliest', '9', '9:00'), 'Pickup: from 9:00');
  assert.equal(made('pickup_latitude', '51.5', '51.5\u00b0'), 'Pickup: 51.5\u00b0');
  assert.equal(made('latitude', '51.x', null), 'not read');
});

test('columns that are not sure are to be looked at', () => {
  const marked = ['sure', 'doubtful', 'open', 'unused', 'stated'].filter((certainty) =>
    isMarked({ certainty }),
  );
  assert.deepEqual(marked, ['doubtful', 'open']);
});

test('what is taken for a fleet has no more digits than it needs', () => {
  const kind = {
    id: 'van',
    count: 2,
    capacity: [1012.4999999999999],
    shift: { earliest: 28_800, latest: '17:00' },
    breaks: [{ start: { earliest: 43_200, latest: 46_800 } }],
    costs: { per_km: 0.1 + 0.2 },
  };
  const request = {
    coordinate_system: 'geographic',
    depots: [{ location: [11.1234567890123, 48.1] }],
    fleet: [kind],
  };
  assert.equal(assumedOf({ request }, 'depot'), '48.1, 11.123457');
  assert.equal(assumedOf({ request }, 'per_km'), '0.3');
  assert.equal(assumedOf({ request }, 'vehicles'), '2');
  assert.equal(assumedOf({ request: null }, 'vehicles'), null);
  const doubts = [{ code: 'FLEET_IN_FILE' }];
  assert.deepEqual(listedFleet({ request, doubts }), [
    { id: 'van', count: 2, capacity: '1,012.5', shift: '8:00\u201317:00', breaks: '12:00\u201313:00' },
  ]);
  assert.deepEqual(listedFleet({ request, doubts: [] }), []);
});

test('listed vehicles are corrected, and what cannot be read is named', () => {
  const request = { fleet: [{ id: 'van', count: 2, capacity: [10], shift: { earliest: 0 } },
    { id: 'bike', count: 1, capacity: [1] }] };
  const texts = { van: { count: ' 3', capacity: '12,5', shift: '7:30-16:00' }, gone: { count: 'x' } };
  assert.deepEqual(corrected(request, texts), { wrong: [], request: { fleet: [
    { id: 'van', count: 3, capacity: [12.5], shift: { earliest: 27_000, latest: 57_600 } },
    request.fleet[1]] } });
  const dated = { ...request, plan_start: '2026-06-01T00:00:00+02:00' };
  assert.deepEqual(corrected(dated, { van: { shift: '7:30-' } }).request.fleet[0].shift,
    { earliest: '7:30' });
  assert.deepEqual(corrected(request, { van: { shift: '' } }).request.fleet[0].shift, {});
  assert.deepEqual(corrected(request, { bike: { count: 'many', shift: 'early' } }).wrong,
    ['bike count', 'bike shift']);
  assert.deepEqual(corrected(null, {}), { request: null, wrong: [] });
});

test('a place is written as maps show it, or as x and y of a plane', () => {
  assert.equal(placing({ coordinate_system: 'geographic' }, [11.5, 48.1234567]), '48.123457, 11.5');
  assert.equal(placing(null, [11.5, 48]), '48, 11.5');
  assert.equal(placing({ coordinate_system: 'planar' }, [3, 4]), '3, 4');
});

test('what is chosen for a column holds, whatever was answered about it before', () => {
  const column = { heading: 'Abladen', column: 'E' };
  const questions = [{ id: 'column:abladen', column: 'E' }];
  const answered = withAnswer({}, 'column:abladen', 'info');
  const back = withColumn(answered, column, { meaning: 'service', unit: null }, questions);
  assert.deepEqual(back.answers, {});
  assert.equal(back.columns.length, 1);
});
