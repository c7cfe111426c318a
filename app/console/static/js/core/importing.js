/** What the console knows of imports: corrections, what is stated beside, earlier mappings. */

import { parseNumber } from './format.js';

const MOST_REMEMBERED = 30;

/** Fields beside the columns, as the settings name them: an example, and what holds if empty. */
export const FIELDS = [
  { name: 'depot', label: 'Depot', help: 'latitude first', example: '48.137, 11.575', read: text },
  { name: 'vehicles', label: 'Vehicles', example: '3', read: whole },
  { name: 'capacity', label: 'Capacity', help: 'of each amount', example: '800', read: numbers },
  { name: 'shift', label: 'Shift', help: 'any time if empty', example: '8:00-17:00', read: text },
  { name: 'speed_kmh', label: 'Speed', help: 'km/h', example: '40', empty: '40', read: number },
  { name: 'service_minutes', label: 'Stop time', help: 'min', example: '5', read: number },
  { name: 'drones', label: 'Drones', help: 'a vehicle', example: '1', empty: '0', read: whole },
  { name: 'drone_capacity', label: 'A drone carries', example: '5', read: numbers },
];

/** What bare numbers mean, in words. */
export const UNITS = {
  clock: 'as 8:30',
  hours: 'hours, as 8.5',
  'h.mm': 'as 8.30',
  hhmm: 'as 0830',
  minutes: 'minutes',
  seconds: 'seconds',
  days: 'shares of a day',
  m: 'metres',
  km: 'kilometres',
};

function text(value) {
  return value;
}

function number(value) {
  return parseNumber(value);
}

function whole(value) {
  const read = parseNumber(value);
  return Number.isInteger(read) ? read : null;
}

function numbers(value) {
  const read = value.split(/[;\s]+/).map(parseNumber);
  return read.includes(null) ? null : read;
}

/** Return `{stated, wrong}`: settings from texts of fields, and the names of those not read. */
export function readFields(texts) {
  const stated = {};
  const wrong = [];
  for (const { name, read } of FIELDS) {
    const value = (texts[name] ?? '').trim();
    if (!value) continue;
    const found = read(value);
    if (found === null) wrong.push(name);
    else stated[name] = found;
  }
  return { stated, wrong };
}

/** Return a mapping in which a column means what the user says. */
export function withColumn(mapping, { heading, column }, change) {
  const columns = mapping.columns ?? [];
  const others = columns.filter(
    (entry) => entry.heading !== heading || (entry.column ?? column) !== column,
  );
  return { ...mapping, columns: [...others, { heading, column, ...change }] };
}

/** Return what tells files alike: their headings in order. */
export function signatureOf(reply) {
  return reply.columns.map(({ heading, column }) => heading || column).join('|');
}

/** Return what is remembered of earlier imports with one more, the newest last. */
export function remember(known, signature, entry) {
  const others = known.filter((other) => other.signature !== signature);
  return [...others, { signature, ...entry }].slice(-MOST_REMEMBERED);
}

/** Return a pasted text if it looks like cells of a sheet, else null. */
export function pastedSheet(content) {
  const lines = content.trim().split(/\r?\n/);
  const cut = lines.filter((line) => line.includes('\t'));
  return cut.length > 1 ? content : null;
}
