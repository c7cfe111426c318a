/** Fields that a sweep varies: `fleet[*].capacity[0]` and the like. */

import { hours, parseHours, parseNumber } from './format.js';
import { getIn, setIn } from './paths.js';
import { kindOf, labelOf, resolve, unitOf } from './schema.js';

/** Return the fields of vehicle types that can be varied: `[{path, label, unit}]`. */
export function variableFields(schemas, fleet) {
  const dimensions = fleet[0]?.capacity.length ?? 1;
  const hasDrones = fleet.every(({ drones }) => drones && !Array.isArray(drones));
  return [
    ...fieldsOf(schemas, schemas.VehicleTypeInput, 'fleet[*]', '', dimensions),
    ...(hasDrones
      ? fieldsOf(
        schemas,
        schemas.DronesInput,
        'fleet[*].drones',
        `${labelOf('drones')}: `,
        dimensions)
      : [])];
}

function fieldsOf(schemas, schema, path, prefix, dimensions) {
  return Object.entries(schema.properties).flatMap(([name, own]) => {
    const found = resolve(schemas, own).schema;
    const kind = kindOf(found);
    const place = `${path}.${name}`;
    const label = prefix + labelOf(name);
    if (kind === 'number') return [{ path: place, label, unit: unitOf(found) }];
    if (kind === 'numbers') {
      return Array.from({ length: dimensions }, (_, index) => ({
        path: `${place}[${index}]`,
        label: dimensions > 1 ? `${label} ${index + 1}` : label,
        unit: '',
      }));
    }
    if (kind === 'object' && name !== 'drones') {
      return fieldsOf(schemas, found, place, `${label}: `, dimensions);
    }
    return [];
  });
}

const SHARES = [0.75, 1, 1.25, 1.5];
const QUARTER = 15 * 60; // seconds
const FEW = 10;

/** What a sweep begins with, of which those count that some vehicle type states. */
const FIRST_FIELDS = [
  { path: 'fleet[*].max_working_duration', unit: 's' },
  { path: 'fleet[*].max_travel_duration', unit: 's' },
  { path: 'fleet[*].capacity[0]', unit: '' },
  { path: 'fleet[*].count', unit: '' }];

/** Return two axes around the fleet at hand: `[{path, text}]`. */
export function axesAround(fleet) {
  const axes = FIRST_FIELDS.map((field) => ({
    path: field.path,
    text: valuesAround(fleet, field),
  })).filter(({ text }) => text);
  return [...axes, { path: '', text: '' }].slice(0, 2);
}

/** Return values around the largest that a fleet has for a field, as text; empty if it has none. */
export function valuesAround(fleet, { path, unit }) {
  const keys = stepsOf(path).slice(2);
  const stated = fleet.map((type) => getIn(type, keys)).filter((value) => value > 0);
  if (!stated.length) return '';
  const middle = Math.max(...stated);
  const isCount = unit !== 's' && Number.isInteger(middle) && middle <= FEW;
  const around = isCount
    ? [middle - 1, middle, middle + 1].filter((value) => value > 0)
    : SHARES.map((share) => (share === 1 ? middle : rounded(middle * share, unit)));
  return [...new Set(around)]
    .map((value) => (unit === 's' ? hours(value, { precise: true }) : String(value)))
    .join(', ');
}

function rounded(value, unit) {
  if (unit === 's' && value >= QUARTER) return Math.round(value / QUARTER) * QUARTER;
  return Number(value.toPrecision(2));
}

/** Return the values of a text such as `100, 110` or `4:00, 5:30`, null if one is no number. */
export function readValues(text, unit) {
  const read = unit === 's' ? parseHours : parseNumber;
  const values = text
    .split(/[,;]\s*/)
    .filter((part) => part.trim() !== '')
    .map((part) => read(part));
  return values.length === 0 || values.includes(null) ? null : values;
}

/** Return a request with a value written to every place that a path means. */
export function writeAt(request, path, value) {
  const places = placesOf(request, stepsOf(path));
  return places.reduce((changed, keys) => setIn(changed, keys, value), request);
}

/** Return the keys of a path; null stands for every entry. */
function stepsOf(path) {
  return [...path.matchAll(/\[(\*|\d+)\]|([A-Za-z_]\w*)/g)].map(([, index, name]) =>
    name !== undefined ? name : index === '*' ? null : Number(index));
}

function placesOf(request, steps) {
  return steps.reduce(
    (places, step) =>
      places.flatMap((keys) => {
        if (step !== null) return [[...keys, step]];
        return (getIn(request, keys) ?? []).map((_, index) => [...keys, index]);
      }),
    [[]]);
}

/**
 * Return a sweep's cells as rows of a table: `{rows, columns, cells, least, most}`.
 *
 * The first axis makes rows, the second columns; further axes are held at their first value.
 */
export function heatTable({ axes, cells }) {
  const [rows, columns] = [axes[0].values, axes[1]?.values ?? [null]];
  const width = axes.slice(1).reduce((product, { values }) => product * values.length, 1);
  const step = width / columns.length;
  const table = rows.map((_, row) =>
    columns.map((__, column) => cells[row * width + column * step]));
  const costs = table
    .flat()
    .map((cell) => cell?.cost)
    .filter((cost) => typeof cost === 'number');
  return { rows, columns, cells: table, least: Math.min(...costs), most: Math.max(...costs) };
}
