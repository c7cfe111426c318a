import assert from 'node:assert/strict';
import { test } from 'node:test';

const from = (name) => import(`../../../app/console/static/js/core/${name}.js`);
const { dayOf } = await from('day');
const { clock, money, parseClock, tellBy, timesInWords } = await from('format');
const { asStated, durationText, inSeconds, onDay, readDuration } = await from('times');

const HOUR = 3600;
const day = (plan_start, time_zone) => dayOf({ plan_start, time_zone });
const SPRING = day('2026-03-29T00:00', 'Europe/Berlin');
const AUTUMN = day('2026-10-25T00:00', 'Europe/Berlin');

const time = (title) => ({ anyOf: [{ type: 'number' }, { type: 'string', title }] });
const optional = (title) => ({ anyOf: [...time(title).anyOf, { type: 'null' }] });
const SCHEMAS = {
  PlanRequest: {
    type: 'object',
    properties: {
      plan_start: { type: 'string' },
      breaks: { type: 'array', items: { $ref: '#/components/schemas/BreakInput' } },
      customers: { type: 'array', items: { $ref: '#/components/schemas/CustomerInput' } },
    },
  },
  BreakInput: {
    type: 'object',
    properties: {
      start: { $ref: '#/components/schemas/BreakStartInput' },
      after_departure: { type: 'boolean' },
    },
  },
  BreakStartInput: {
    type: 'object',
    properties: { earliest: time('OpeningOrLength'), latest: optional('InstantOrLength') },
  },
  CustomerInput: {
    type: 'object',
    properties: {
      id: { type: 'string' },
      demand: { type: 'array', items: { type: 'number' } },
      service_duration: time('Duration'),
      service_duration_by_type: { type: 'object', additionalProperties: time('Duration') },
      time_window: { $ref: '#/components/schemas/TimeWindowInput' },
    },
  },
  TimeWindowInput: {
    type: 'object',
    properties: { earliest: time('Opening'), latest: optional('Instant') },
  },
};

test('instants are those that the service reads', () => {
  for (const [at, text, hours] of [
    [SPRING, '01:30', 1.5], [SPRING, '7:30', 6.5], [SPRING, '02:30', 2.5], [SPRING, '24:00', 23],
    [AUTUMN, '02:30', 2.5], [AUTUMN, '02:30+01:00', 3.5], [AUTUMN, '+1 06:00', 31],
    [AUTUMN, '2026-10-25T07:30', 8.5], [AUTUMN, '2026-10-25 06:30Z', 8.5],
    [day('2026-05-04T12:30:00+02:00', 'Europe/Berlin'), '08:00', -4.5],
    [day('2026-03-08T05:00:00Z', 'America/New_York'), '07:30', 6.5],
    [day('2026-05-04T23:00:00Z', 'Pacific/Kiritimati'), '13:00', 0],
    [day('2026-05-04T05:00:00+02:00'), '07:30', 2.5],
  ]) {
    assert.equal(at.secondsAt(text), hours * HOUR, text);
  }
  for (const wrong of ['25:00', '24:01', 'noon', '7', '07:60']) {
    assert.equal(SPRING.secondsAt(wrong), null, wrong);
  }
  for (const [start, zone] of [['2026-05-04T06:00'], ['soon', 'UTC'], ['2026-05-04T06:00', 'X/Y']]) {
    assert.equal(day(start, zone), null);
  }
});

test('what counts from a departure is a length on any day', () => {
  const breaks = [
    { start: { latest: 'PT5H30M' }, after_departure: true },
    { start: { latest: '06:00' }, after_departure: false },
  ];
  const request = { plan_start: '2026-05-04T05:00Z', breaks };
  const read = inSeconds(SCHEMAS, request);
  assert.deepEqual(read.breaks.map(({ start }) => start.latest), [5.5 * HOUR, HOUR]);
  const moved = onDay(SCHEMAS, read, { plan_start: '2026-05-05T04:00Z' });
  assert.deepEqual(moved.breaks.map(({ start }) => start.latest), [5.5 * HOUR, 2 * HOUR]);
});

test('instants are told by the day that is open', () => {
  const autumn = { plan_start: '2026-10-25T06:00:00+01:00', time_zone: 'Europe/Berlin' };
  tellBy({ ...autumn, currency: 'EUR' });
  assert.equal(clock(1.5 * HOUR), '7:30');
  assert.equal(clock(24 * HOUR + 30), '+1 6:01');
  assert.equal(clock(59.5, { precise: true }), '6:01');
  assert.equal(parseClock('7:30'), 1.5 * HOUR);
  assert.equal(money(3), '3.00\u00a0EUR');
  assert.equal(timesInWords('reached at 5400 s, 60 s too late'), 'reached at 7:30, 1 min too late');
  assert.equal(timesInWords('arrives 7332.8 minutes late'), 'arrives 122 h 13 min late');
  assert.equal(timesInWords('works 600 s, in 90.5 s'), 'works 10 min, in 1 min 30.5 s');
  tellBy(null);
  assert.equal(clock(1.5 * HOUR), '1:30');
  assert.equal(money(3), '3.00');
});

const request = {
  plan_start: '2026-03-29T05:00+02:00',
  customers: [
    {
      id: 'A',
      demand: [1],
      service_duration: '0:10',
      service_duration_by_type: { van: 'PT90S' },
      time_window: { earliest: '04:00', latest: '2026-03-29T07:30+02:00' },
    },
    { id: 'B', demand: [1], service_duration: 60, time_window: { latest: null } },
  ],
};

test('a request is read in seconds, and written as it was stated where it stayed so', () => {
  const read = inSeconds(SCHEMAS, request);
  assert.deepEqual(read.customers[0].time_window, { earliest: 0, latest: 2.5 * HOUR });
  assert.equal(read.customers[0].service_duration, 600);
  assert.deepEqual(read.customers[0].service_duration_by_type, { van: 90 });
  assert.deepEqual(asStated(SCHEMAS, read, request), request);
  const changed = structuredClone(read);
  changed.customers[0].time_window.latest = 3 * HOUR;
  const written = asStated(SCHEMAS, changed, request).customers[0];
  assert.deepEqual(written.time_window, { earliest: '04:00', latest: 3 * HOUR });
  assert.equal(written.service_duration, '0:10');
});

test('times of one of several drones are read, whose schema is a union within another', () => {
  const drones = { $ref: '#/components/schemas/DronesInput' };
  const schemas = {
    PlanRequest: { type: 'object', properties: {
      drones: { anyOf: [{ oneOf: [drones, { type: 'array', items: drones }] }, { type: 'null' }] },
    } },
    DronesInput: { type: 'object', properties: { endurance: time('Duration') } },
  };
  for (const wrapped of [(each) => each, (each) => [each]]) {
    const read = inSeconds(schemas, { drones: wrapped({ endurance: '0:30' }) });
    assert.deepEqual(read, { drones: wrapped({ endurance: 1800 }) });
  }
});

test('on another day all is at the same time of day', () => {
  const zone = { time_zone: 'Europe/Berlin' };
  const plain = { customers: [{ id: 'A', time_window: { earliest: 7.5 * HOUR, latest: 100000 } }] };
  const spring = onDay(SCHEMAS, plain, { plan_start: '2026-03-29T00:00', ...zone });
  assert.equal(spring.customers[0].time_window.earliest, 6.5 * HOUR);
  const later = onDay(SCHEMAS, spring, { plan_start: '2026-10-25T05:00', ...zone });
  assert.equal(later.customers[0].time_window.earliest, 2.5 * HOUR);
});

test('lengths are typed in words', () => {
  const read = { '10 min': 600, '1 h 30 min': 5400, '0:10': 600, PT10M: 600, '90': 90, '1,5 h': 5400 };
  for (const [text, seconds] of Object.entries(read)) assert.equal(readDuration(text), seconds);
  for (const wrong of ['soon', '10 min later', 'P', 'P1Y']) assert.equal(readDuration(wrong), null);
  for (const seconds of [0, 600, 5400, 61.5, 3600]) {
    assert.equal(readDuration(durationText(seconds)), seconds);
  }
  assert.equal(durationText(600), '10 min');
});
