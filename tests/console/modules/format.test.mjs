import assert from 'node:assert/strict';
import test from 'node:test';
import {
  clock,
  duration,
  money,
  number,
  parseClock,
  parseNumber,
  signed,
  timeWindow,
} from '../../../app/console/static/js/core/format.js';

test('an instant is shown to the minute unless seconds are asked for', () => {
  assert.equal(clock(29100), '8:05');
  assert.equal(clock(29129), '8:05');
  assert.equal(clock(29131, { precise: true }), '8:05:31');
  assert.equal(clock(90000), '25:00');
  assert.equal(clock(null), '');
});

test('an instant that is shown can be read again', () => {
  for (const seconds of [0, 61, 29131, 86399]) {
    assert.equal(parseClock(clock(seconds, { precise: true })), seconds);
  }
  assert.equal(parseClock('28800'), 28800);
  assert.equal(parseClock('8:75'), null);
  assert.equal(parseClock('early'), null);
});

test('numbers are read with a point or a comma, and nothing else is a number', () => {
  assert.equal(parseNumber('1.5'), 1.5);
  assert.equal(parseNumber('1,5'), 1.5);
  assert.equal(parseNumber('-2'), -2);
  assert.equal(parseNumber(''), null);
  assert.equal(parseNumber('12 kg'), null);
});

test('lengths of time and money are shown as people write them', () => {
  assert.equal(duration(40), '40 s');
  assert.equal(duration(720), '12 min');
  assert.equal(duration(7500), '2 h 05 min');
  assert.equal(duration(3600), '1 h');
  assert.equal(money(1234.5), '1,234.50');
  assert.equal(number(-0.5), '\u22120.5');
  assert.equal(signed(3), '+3.00');
  assert.equal(signed(0.001), '0.00');
});

test('a window tells which of its ends are open', () => {
  assert.equal(timeWindow({ earliest: 28800, latest: 36000 }), '8:00 to 10:00');
  assert.equal(timeWindow({ earliest: 28800 }), 'from 8:00');
  assert.equal(timeWindow({ latest: 36000 }), 'until 10:00');
  assert.equal(timeWindow(undefined), 'any time');
});
