/** What of a problem changed, in words; entries are those of `requestDifferences`. */

import { clock, hours } from './format.js';
import { choiceOf, labelOf, withinSentence } from './schema.js';
import { t } from '../texts.js';

const LONGEST = 60;
const INSTANT = /(earliest|latest|time)$/;
const LENGTH = /(duration|endurance|aboard)$/;

/** Return a change of one field, such as `truck: speed km/h 40 → 50`. */
export function fieldChange({ path, before, after }) {
  const { owner, field, name } = placeOf(path);
  const [then, now] = [before, after].map((value) => shown(value, name));
  return `${owner && `${owner}: `}${field} ${then} \u2192 ${now}`;
}

/** Return whose field a path is, if someone's, and the field in words and by its own name. */
function placeOf(path) {
  const [, owner = '', rest] = /^(?:(?:customers|fleet|depots)\[(.*)\]\.)?(.*)$/.exec(path);
  const names = rest.split('.');
  const field = names.map((name) => withinSentence(labelOf(name))).join(', ');
  return { owner, field, name: names[names.length - 1] };
}

/** Return a value in words: of lists of what has no names how many there are. */
function textOf(value, name) {
  if (Array.isArray(value)) {
    const names = value.map((entry) => entry?.id ?? entry);
    return names.some((entry) => typeof entry === 'object') ? String(names.length)
      : (name === 'avoid' ? names.map((entry) => choiceOf(entry)) : names).join(', ');
  }
  if (typeof value === 'object') {
    return Object.entries(value)
      .map(([key, inner]) => `${withinSentence(labelOf(key))} ${shown(inner, key)}`).join(', ');
  }
  return typeof value === 'string' && name !== 'id' ? choiceOf(value, name) : String(value);
}

function shown(value, name) {
  if (value === undefined || value === null) return t('change.none');
  if (typeof value === 'number' && INSTANT.test(name)) return clock(value, { precise: true });
  if (typeof value === 'number' && LENGTH.test(name)) return hours(value, { precise: true });
  if (typeof value === 'object' && value.count !== undefined) {
    return t('change.each', { count: value.count });
  }
  const text = textOf(value, name);
  return text.length > LONGEST ? `${text.slice(0, LONGEST)}\u2026` : text;
}
