/** What of a problem changed, in words; entries are those of `requestDifferences`. */

import { clock, hours } from './format.js';
import { labelOf } from './schema.js';
import { t } from '../texts.js';

const LONGEST = 60;
const INSTANT = /(earliest|latest|time)$/;
const LENGTH = /(duration|endurance|aboard)$/;

/** Return a change of one field, such as `truck: speed km/h 40 → 50`. */
export function fieldChange({ path, before, after }) {
  const { owner, field } = placeOf(path);
  const [then, now] = [before, after].map((value) => shown(value, field));
  return `${owner && `${owner}: `}${field} ${then} \u2192 ${now}`;
}

/** Return whose field a path is, if someone's, and the field in words. */
function placeOf(path) {
  const [, owner = '', rest] = /^(?:(?:customers|fleet|depots)\[(.*)\]\.)?(.*)$/.exec(path);
  return { owner, field: rest.split('.').map(labelOf).join(', ').toLowerCase() };
}

function shown(value, field) {
  if (value === undefined || value === null) return t('change.none');
  if (typeof value === 'number' && INSTANT.test(field)) return clock(value, { precise: true });
  if (typeof value === 'number' && LENGTH.test(field)) return hours(value, { precise: true });
  if (Array.isArray(value) && value.every((entry) => typeof entry === 'number')) {
    return value.join(', ');
  }
  if (typeof value === 'object' && value.count !== undefined) {
    return t('change.each', { count: value.count });
  }
  const text = typeof value === 'object' ? JSON.stringify(value) : String(value);
  return text.length > LONGEST ? `${text.slice(0, LONGEST)}\u2026` : text;
}
