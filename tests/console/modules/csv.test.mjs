/** Cells of CSV that no sheet takes for a formula. */

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { csvCell } from '../../../app/console/static/js/core/csv.js';

const EVERY = Array.from({ length: 0x10000 }, (_, code) => String.fromCharCode(code));
const SIGNS = EVERY.filter((sign) => '=+-@\u2212'.includes(sign.normalize('NFKC')));
const UNSEEN = EVERY.filter((sign) => /[\s\p{C}\p{Z}\p{DI}]/u.test(sign) && !/\p{Cn}|\p{Co}|\p{Cs}/u.test(sign));
const BEFORE = ['', '"', '\r\n', ';', 'a;', 'a; ', 'a;"', 'a\t', 'a\n', '\u200b\u202e ', ...UNSEEN,
  ...UNSEEN.map((sign) => `a;${sign}`)];

/** Return what programs make of a cell that split lines at other signs, and skip what isn't seen. */
function parts(cell) {
  return cell.split(/[;,\t\r\n\u2028]/).map((part) => part.replace(/^[\s"\p{C}\p{Z}\p{DI}]+/u, ''));
}

test('no cell begins with a sign of formulas, whatever ends a cell', () => {
  for (const before of BEFORE) {
    for (const sign of SIGNS) {
      const cell = csvCell(`${before}${sign}1+1`);
      assert.ok(!parts(cell).some((part) => SIGNS.includes(part[0])), JSON.stringify(cell));
    }
  }
});

test('signs of formulas are those that anybody has heard of', () => {
  for (const sign of '=+-@＝＋－＠﹢﹣﹦﹫⁺⁻⁼₊₋₌−') assert.ok(SIGNS.includes(sign), sign);
  for (const sign of ['\u200b', '\u200e', '\u202e', '\u2066', '\u2060', '\ufeff', '\u00ad', '\u3164']) {
    assert.ok(UNSEEN.includes(sign), sign.codePointAt(0).toString(16));
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
