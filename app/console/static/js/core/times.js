/** Instants and lengths of time of a request, which its schema tells from other numbers. */

import { dayOf } from './day.js';
import { hours, parseHours } from './format.js';
import { getIn } from './paths.js';
import { resolve } from './schema.js';

const KINDS = {
  Instant: 'instant', InstantOrLength: 'instant', Opening: 'opening', OpeningOrLength: 'opening',
  Duration: 'duration',
};

/** What was found out of schemas, which each of many thousand customers asks for anew. */
const titles = new WeakMap();
const shapes = new WeakMap();

/** Return `instant`, `opening` or `duration` if a schema is of one, else null. */
export function timeKind(schema) {
  return KINDS[titleOf(schema)] ?? null;
}

/** Likewise of what a request states at `keys`: what counts from a departure is a length. */
export function timeKindAt(schema, request, keys) {
  const mayBeLength = titleOf(schema)?.endsWith('OrLength');
  return mayBeLength && getIn(request, [...keys.slice(0, -2), 'after_departure'])
    ? 'duration'
    : timeKind(schema);
}

function titleOf(schema) {
  if (!schema) return undefined;
  if (!titles.has(schema)) {
    const texts = (schema.anyOf ?? []).flatMap((one) => one.anyOf ?? [one]);
    titles.set(schema, texts.find(({ type }) => type === 'string')?.title);
  }
  return titles.get(schema);
}

/** Yield `{keys, kind, value}` of every instant and length that a request states. */
export function* timesIn(schemas, request) {
  for (const { keys, schema, value } of within(schemas, schemas.PlanRequest, request, [])) {
    yield { keys, kind: timeKindAt(schema, request, keys), value };
  }
}

function* within(schemas, schema, value, keys) {
  if (value === null || value === undefined) return;
  if (timeKind(schema)) {
    yield { keys, schema, value };
  } else if (typeof value === 'object') {
    const found = shapeOf(schemas, schema, value);
    if (Array.isArray(value)) {
      if (!found?.items || isPlain(found.items)) return;
      for (const [index, entry] of value.entries()) {
        yield* within(schemas, found.items, entry, [...keys, index]);
      }
    } else {
      for (const [name, entry] of Object.entries(value)) {
        const inner = found?.properties?.[name] ?? found?.additionalProperties;
        if (inner && !isPlain(inner)) yield* within(schemas, inner, entry, [...keys, name]);
      }
    }
  }
}

function isPlain(schema) {
  return ['number', 'integer', 'string', 'boolean'].includes(schema.type);
}

/** Return what describes an object or array, of several schemas the one that does. */
function shapeOf(schemas, schema, value) {
  if (!shapes.has(schema)) shapes.set(schema, shapesOf(schemas, schema));
  const type = Array.isArray(value) ? 'array' : 'object';
  return shapes.get(schema).find((one) => one.type === type);
}

/** Return all that a schema may be, also where one of several is one of several. */
function shapesOf(schemas, schema) {
  const all = schema.anyOf ?? schema.oneOf;
  return all?.flatMap((one) => shapesOf(schemas, one)) ?? [resolve(schemas, schema).schema];
}

/**
 * Return a request whose instants and lengths are seconds, itself if they are; what can't be read
 * stays as it is.
 */
export function inSeconds(schemas, request) {
  const day = dayOf(request);
  const texts = [...timesIn(schemas, request)].filter(({ value }) => typeof value === 'string');
  if (!texts.length) return request;
  const changed = structuredClone(request);
  for (const { keys, kind, value } of texts)
    put(changed, keys, secondsOf(value, kind, day) ?? value);
  return changed;
}

function secondsOf(text, kind, day) {
  if (kind === 'duration') return readDuration(text);
  const seconds = day?.secondsAt(text) ?? null;
  // What has opened before the plan's start is open from then on.
  return seconds !== null && kind === 'opening' ? Math.max(0, seconds) : seconds;
}

/** Write a value to a place. In place. */
function put(request, keys, value) {
  getIn(request, keys.slice(0, -1))[keys[keys.length - 1]] = value;
}

/** Return a request in which what is as it was `stated` is written as it was there. */
export function asStated(schemas, request, stated) {
  if (!stated) return request;
  const before = inSeconds(schemas, stated);
  if (before.plan_start !== request.plan_start || before.time_zone !== request.time_zone) {
    return request;
  }
  const changed = structuredClone(request);
  for (const { keys, value } of timesIn(schemas, stated)) {
    const isAsBefore = getIn(before, keys) === getIn(request, keys);
    if (typeof value === 'string' && isAsBefore) put(changed, keys, value);
  }
  return changed;
}

/** Return a request on another day, whose instants are at the same time of day as before. */
export function onDay(schemas, request, changes) {
  const next = { ...request, ...changes };
  const [from, to] = [dayOf(request), dayOf(next)];
  if (!to) return next;
  const changed = structuredClone(next);
  for (const { keys, kind, value } of timesIn(schemas, request)) {
    if (kind !== 'duration' && typeof value === 'number') {
      const seconds = to.secondsAt(from ? from.textAt(value) : textOf(value));
      if (seconds !== null) put(changed, keys, Math.max(0, seconds));
    }
  }
  return changed;
}

/** Return seconds since midnight as a time of the day. */
function textOf(seconds) {
  const days = Math.floor(seconds / 86400);
  const text = hours(seconds - days * 86400, { precise: true });
  return days ? `+${days} ${text}` : text;
}

const ISO = /^P(?:([\d.]+)W)?(?:([\d.]+)D)?(?:T(?:([\d.]+)H)?(?:([\d.]+)M)?(?:([\d.]+)S)?)?$/;
const UNITS = { h: 3600, min: 60, s: 1 };

/** Return the seconds of `0:10`, `PT10M`, `1 h 30 min` or a number; null for any other text. */
export function readDuration(text) {
  const trimmed = text.trim();
  const iso = trimmed.length > 2 && ISO.exec(trimmed);
  if (iso) {
    return [604800, 86400, 3600, 60, 1].reduce(
      (sum, size, index) => sum + size * Number(iso[index + 1] ?? 0),
      0);
  }
  const parts = [...trimmed.matchAll(/(\d+(?:[.,]\d+)?)\s*(h|min|s)\b\s*/g)];
  if (parts.length && parts.map(([part]) => part).join('') === trimmed) {
    return parts.reduce(
      (sum, [, amount, unit]) => sum + UNITS[unit] * Number(amount.replace(',', '.')),
      0);
  }
  return parseHours(trimmed);
}

/** Return a length as it is typed, such as `10 min`, exactly. */
export function durationText(seconds) {
  const whole = Math.floor(seconds);
  const parts = [
    [Math.floor(whole / 3600), 'h'],
    [Math.floor(whole / 60) % 60, 'min'],
    [Number(((whole % 60) + seconds - whole).toFixed(3)), 's']];
  const shown = parts.filter(([amount]) => amount).map((part) => part.join(' '));
  return shown.join(' ') || '0 min';
}
