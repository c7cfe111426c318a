import assert from 'node:assert/strict';
import test from 'node:test';
import {
  pastedSheet,
  readFields,
  remember,
  signatureOf,
  withColumn,
} from '../../../app/console/static/js/core/importing.js';

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
