/** Cells of CSV that no sheet takes for a formula. */

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { csvCell } from '../../../app/console/static/js/core/csv.js';

const SIGNS = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];
const BEFORE = ['', ' ', '"', '\t', '\r', '\n', '\r\n', ';', 'a;', 'a; ', 'a;"', 'a\t', 'a\n', '\u00a0'];

/** Return what programs make of a cell that split lines at other signs, and skip blanks. */
function parts(cell) {
  return cell.split(/[;,\t\r\n]/).map((part) => part.replace(/^[\s"]+/, ''));
}

test('no cell begins with a sign of formulas, whatever ends a cell', () => {
  for (const before of BEFORE) {
    for (const sign of SIGNS) {
      const cell = csvCell(`${before}${sign}1+1`);
      assert.ok(!parts(cell).some((part) => SIGNS.includes(part[0])), JSON.stringify(cell));
    }
  }
});

test('a blank that sheets skip begins no cell', () => {
  for (const blank of ['\t', '\r', '\n']) assert.match(csvCell(`${blank}a`), /^"'/);
});

test('numbers and plain words stay as they are', () => {
  assert.equal(csvCell(-5.5), '-5.5');
  assert.equal(csvCell('Ring-Str. 5 + 6'), 'Ring-Str. 5 + 6');
  assert.equal(csvCell('a "b", c'), '"a ""b"", c"');
});
