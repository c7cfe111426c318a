/** What the console knows of imports: corrections, what is stated beside, earlier mappings. */

import { t } from '../texts.js';
import { clock, number, parseHours, parseNumber, withDecimals } from './format.js';
import { soughtIn } from './places.js';

const MOST_REMEMBERED = 30;
const MOST_PLACES = 3000;

/** Kinds of questions whose answers mean nothing for another file. */
const OF_ONE_FILE = ['day', 'hidden_rows', 'total_rows', 'same_rows'];

/** Fields beside the columns that matter every day, as the settings name them, with an example. */
export const FIELDS = [
  { name: 'depot', example: '48.137, 11.575', read: text },
  { name: 'vehicles', example: '3', read: whole },
  { name: 'capacity', example: '800', read: numbers },
  { name: 'shift', example: '8:00-17:00', read: text }];

/** The others. */
export const MORE_FIELDS = [
  { name: 'max_trips', example: '2', read: whole },
  { name: 'per_hour', example: '30', read: parseNumber },
  { name: 'per_km', example: '0.5', read: parseNumber },
  { name: 'currency', example: 'EUR', read: currency },
  { name: 'speed_kmh', example: '40', read: parseNumber },
  { name: 'service_minutes', example: '5', read: parseNumber },
  { name: 'drones', example: '1', read: whole },
  { name: 'drone_capacity', example: '5', read: numbers }];

/** Return a text, or what stands in its place where the language has none by its key. */
export function knownOr(text, fallback) {
  return /^import\.\S+$/.test(text) ? fallback : text;
}

/** Return what a column means in words; of a row's other places, with which one it is. */
export function meaningText(meaning, title) {
  const own = knownOr(t(`import.meaning.${meaning}`), null);
  const [, side, rest] = /^(pickup|alternative)_(\w+)$/.exec(meaning) ?? [];
  if (own || !side) return own ?? title;
  return `${t(`import.side.${side}`)}: ${t(`import.meaning.${rest}`)}`;
}

/** Return a doubt or an error of an import in words, by its code and values. */
export function grantedInWords({ code, message, values, cell, column }) {
  const { case: context, names = [], meaning, amount, currency } = values;
  return t(`granted.${code}`, {
    ...values, cell, column, context, defaultValue: message,
    names: names.join(', '),
    meaning: meaning && meaningText(meaning, meaning),
    amount: amount && `${number(amount)} ${currency ?? ''}`.trim(),
  });
}

/** Return a window of the request in words; its times may be counted or written. */
function timeWindow(window) {
  const { earliest, latest } = window ?? { earliest: undefined, latest: undefined };
  if (earliest === undefined && latest === undefined) return '';
  const told = (time) => (typeof time === 'number' ? clock(time) : (time ?? ''));
  return `${told(earliest)}\u2013${told(latest)}`;
}

/** Tell whether a column is to be looked at before its file is planned. */
export function isMarked({ certainty }) {
  return certainty === 'doubtful' || certainty === 'open';
}

/** Return what was made of a cell, in words; nothing where that is what stands in it. */
export function madeOf(meaning, { raw, read }) {
  if (read === null) return t('import.notRead');
  const [, side, own] = /^(pickup|alternative)_(\w+)$/.exec(meaning) ?? [null, null, meaning];
  const bound = { earliest: 'since', latest: 'until' }[own];
  const said = bound ? t(`import.${bound}`, { time: read }) : read;
  const made = withDecimals(side ? `${t(`import.side.${side}`)}: ${said}` : said);
  return meaning === 'ignored' || made === raw || said === raw ? '' : made;
}

function text(value) {
  return value;
}

function whole(value) {
  const read = parseNumber(value);
  return Number.isInteger(read) ? read : null;
}

function currency(value) {
  return /^[a-z]{3}$/i.test(value) ? value.toUpperCase() : null;
}

function numbers(value) {
  const read = value.split(/[;\s]+/).map(parseNumber);
  return read.includes(null) ? null : read;
}

/** Return `{stated, wrong}`: settings from texts of fields, and the names of those not read. */
export function readFields(texts) {
  const stated = {};
  const wrong = [];
  for (const { name, read } of [...FIELDS, ...MORE_FIELDS]) {
    const value = (texts[name] ?? '').trim();
    if (!value) continue;
    const found = read(value);
    if (found === null) wrong.push(name);
    else stated[name] = found;
  }
  return { stated, wrong };
}

/** Return what is taken for a field that is empty, of several types what they have in common. */
export function assumedOf({ request }, name) {
  if (!request) return null;
  const alike = (value) => {
    const [first, ...others] = request.fleet.map(value);
    return others.every((other) => other === first) ? first : undefined;
  };
  const plain = (value) => (value === undefined ? null : number(value));
  const depot = request.depots[0].location;
  return {
    depot: Array.isArray(depot) ? placing(request, [depot[0], depot[1]]) : null,
    vehicles: String(request.fleet.reduce((sum, { count }) => sum + count, 0)),
    capacity: alike(({ capacity }) => capacity.map((amount, at) =>
      `${number(amount)} ${request.load_dimensions?.[at]?.unit ?? ''}`.trim()).join(' / ')),
    shift: alike(({ shift }) => timeWindow(shift)),
    max_trips: plain(alike((kind) => kind.max_trips)),
    per_hour: plain(alike(({ costs }) => costs?.per_hour)),
    per_km: plain(alike(({ costs }) => costs?.per_km)),
    currency: request.currency,
    speed_kmh: '40',
    drones: '0',
  }[name];
}

/** Return the vehicles that a file lists, in words: `[{id, count, capacity, shift, breaks}]`. */
export function listedFleet({ request, doubts }) {
  if (!request || !doubts.some(({ code }) => code === 'FLEET_IN_FILE')) return [];
  return request.fleet.map(({ id, count, capacity, shift, breaks = [] }) => ({
    id,
    count,
    capacity: capacity.map((amount) => number(amount)).join(' '),
    shift: timeWindow(shift),
    breaks: breaks.map((pause) => timeWindow(pause.start)).join(', '),
  }));
}

const CORRECTED = { count: whole, capacity: numbers, shift: shiftIn };

/** Fields of listed vehicles that can be corrected. */
export const CORRECTABLE = Object.keys(CORRECTED);

/**
 * Return a request with listed vehicles as they were corrected, and what of that can't be read.
 *
 * @param texts by id of the vehicle and field
 */
export function corrected(request, texts) {
  const wrong = [];
  const fleet = request?.fleet.map((kind) => {
    const read = Object.entries(texts[kind.id] ?? {})
      .map(([name, value]) => [name, CORRECTED[name](value.trim(), request)]);
    wrong.push(...read.filter(([, value]) => value === null).map(([name]) => `${kind.id} ${name}`));
    return { ...kind, ...Object.fromEntries(read.filter(([, value]) => value !== null)) };
  });
  return { request: request && { ...request, fleet }, wrong };
}

/** Return a shift such as `8:00-17:00`, either end of which may lack; null: it can't be read. */
function shiftIn(value, { plan_start: day }) {
  const [, ...ends] = /^(\d\d?:\d\d)?\s*[-\u2013]\s*(\d\d?:\d\d)?$/.exec(value) ?? [];
  const stated = ['earliest', 'latest'].map((end, at) => [end, ends[at]]).filter(([, at]) => at);
  if (value && !stated.length) return null;
  // Where no day is known, times count from midnight.
  return Object.fromEntries(stated.map(([end, at]) => [end, day ? at : parseHours(at)]));
}

/** Return a mapping in which a column means what the user says, whatever was answered before. */
export function withColumn(mapping, { heading, column }, change, questions = []) {
  const others = otherColumns(mapping, { heading, column });
  const asked = questions.filter((question) => question.column === column).map(({ id }) => id);
  const changed = { ...mapping, columns: [...others, { heading, column, ...change }] };
  return mapping.answers ? { ...changed, answers: without(mapping.answers, asked) } : changed;
}

function otherColumns({ columns = [] }, { heading, column }) {
  return columns.filter(
    (entry) => entry.heading !== heading || (entry.column ?? column) !== column);
}

function without(answers, ids) {
  return Object.fromEntries(Object.entries(answers).filter(([id]) => !ids.includes(id)));
}

/** Return a mapping in which a question is answered. */
export function withAnswer(mapping, id, answer) {
  return { ...mapping, answers: { ...mapping.answers, [id]: answer } };
}

/** Return the addresses of a request that nobody has placed yet: `[{address, ids}]`. */
export function unplacedIn(request, places) {
  return addressesIn(request).filter(({ address }) => !places[address]);
}

/** Return the addresses of customers and shipments that are not looked up: `[{address, ids}]`. */
export function addressesIn(request) {
  const ids = new Map();
  for (const { key, address } of soughtIn(request)) {
    if (key.startsWith('c:')) ids.set(address, [...(ids.get(address) ?? []), key.slice(2)]);
  }
  return [...ids].map(([address, named]) => ({ address, ids: named }));
}

/** Return places that were chosen by hand as `withFound` takes them. */
export function byAddress(places) {
  return new Map(
    Object.entries(places).map(([address, location]) => [
      address,
      { places: [{ location, quality: 'house' }], doubt: null }]));
}

/** Return a request without whoever's addresses have no place, and without such other places. */
export function withoutUnplaced(request) {
  const isPlaced = ({ location }) => !location?.address;
  const customers = request.customers.filter(isPlaced).map((customer) =>
    customer.alternatives
      ? { ...customer, alternatives: customer.alternatives.filter(isPlaced) }
      : customer);
  if (!request.shipments) return { ...request, customers };
  const shipments = request.shipments.filter(
    ({ pickup, pickups, delivery }) => [...(pickups ?? [pickup]), delivery].every(isPlaced));
  return { ...request, customers, shipments };
}

/** Return how a place is written where latitude comes first, or x where the map is a plane. */
export function placing(request, [x, y]) {
  const digits = (value) => Number(value.toFixed(6));
  const isPlane = request && request.coordinate_system !== 'geographic';
  return (isPlane ? [x, y] : [y, x]).map(digits).join(', ');
}

/** Return the places by address that are worth keeping for other files, the newest. */
export function rememberPlaces(places) {
  return Object.fromEntries(Object.entries(places).slice(-MOST_PLACES));
}

/** Return a mapping for the next file like it, without answers that are about this file's rows. */
export function forNextFile(mapping, questions = []) {
  const own = questions.filter(({ kind }) => OF_ONE_FILE.includes(kind)).map(({ id }) => id);
  return mapping.answers ? { ...mapping, answers: without(mapping.answers, own) } : mapping;
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
