/** Fields of a form from the schemas of `/openapi.json`. */

import { language, t } from '../texts.js';

/** Units by what a description says, the first that fits. @type {[RegExp, string][]} */
const UNITS = [
  [/\bkm\/h\b/i, 'km/h'],
  [/\bdegrees\b/i, '\u00b0'],
  [/\bmetres per\b/i, 'm'],
  [/\bin metres\b/i, 'm'],
  [/\bseconds?\b/i, 's']];

/** Longest text that an empty field can show. */
const LONGEST_HINT = 18;

const WORDS = { kmh: 'km/h', deg: '', id: 'name' };

/** Return a schema with its reference followed and `null` taken out: `{schema, nullable}`. */
export function resolve(schemas, schema) {
  if (schema.$ref) {
    const { $ref, ...own } = schema;
    const found = resolve(schemas, schemas[$ref.slice($ref.lastIndexOf('/') + 1)]);
    return { ...found, schema: { ...found.schema, ...own } };
  }
  const { anyOf, oneOf, ...own } = schema;
  const all = anyOf ?? oneOf;
  if (!all) return { schema, nullable: false };
  const kinds = all.filter(({ type }) => type !== 'null');
  const found = resolve(schemas, kinds[0]);
  // Texts are found by what the schema is called, not the field that may hold it.
  const title = found.schema.title ?? own.title;
  return {
    schema: { ...found.schema, ...own, ...(title && { title }) },
    nullable: kinds.length < all.length,
  };
}

/** Return the kind of input that a schema asks for. */
export function kindOf(schema) {
  if (schema.enum) return 'choice';
  if (schema.type === 'boolean') return 'switch';
  if (schema.type === 'number' || schema.type === 'integer') return 'number';
  if (schema.type === 'object') {
    return typeof schema.additionalProperties === 'object' ? 'words' : 'object';
  }
  if (schema.type !== 'array') return 'text';
  const item = schema.items ?? {};
  if (item.$ref || item.type === 'object') return 'objects';
  if (schema.prefixItems || item.type === 'number') return 'numbers';
  if (item.anyOf?.some(({ title }) => title === 'Duration')) return 'durations';
  if (item.enum) return 'several';
  return item.type === 'string' ? 'texts' : 'other';
}

/** Return the unit of a number, empty if its description names none. */
export function unitOf(schema) {
  const text = schema.description ?? '';
  if (!['number', 'integer'].includes(schema.type)) return '';
  // What costs a kilometre or an hour is labelled so.
  if (/per kilometre|cost per hour/i.test(text)) return '';
  return UNITS.find(([pattern]) => pattern.test(text))?.[1] ?? '';
}

/** Return texts, or other values, by name as lines such as `phone: 089 1234`. */
export function wordLines(words, show = String) {
  return Object.entries(words ?? {})
    .map(([name, value]) => `${name}: ${show(value)}`)
    .join('\n');
}

/** Return what lines such as `phone: 089 1234` say; null if one lacks its name or can't be read. */
export function wordsOf(text, read = String) {
  const lines = text.split('\n').filter((line) => line.trim());
  if (!lines.every((line) => line.indexOf(':') > 0)) return null;
  const entries = lines.map((line) => {
    const colon = line.indexOf(':');
    return [line.slice(0, colon).trim(), read(line.slice(colon + 1).trim())];
  });
  return entries.every(([, value]) => value !== null) ? Object.fromEntries(entries) : null;
}

/** Return a field's name in words; one that isn't known is called as the API calls it. */
export function labelOf(name) {
  return t(`field.${name}`, { defaultValue: plainLabel(name) });
}

/** Return a label as it stands within a sentence: nouns keep their capital where they have one. */
export function withinSentence(label) {
  return language() === 'en' ? label.charAt(0).toLowerCase() + label.slice(1) : label;
}

/** Return a name's own words: `max_trip_distance` becomes `Max trip distance`. */
function plainLabel(name) {
  const words = name
    .split('_')
    .map((word) => WORDS[word] ?? word)
    .filter(Boolean)
    .join(' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/**
 * Return what a field is for, in the words of who fills it, else as the API describes it. What a
 * view says of it here (`help` of the schema) comes first.
 *
 * @param owner title of the schema that has the field
 * @param name of the field
 * @param schema of the field
 */
export function helpOf(owner, name, schema) {
  const own = schema.help ?? t(`help.${owner}.${name}`, { defaultValue: '' });
  if (own || !(owner in LIKE)) return own || apiHelpOf(schema);
  return helpOf(LIKE[owner], name, schema);
}

/** Schemas whose fields mean what those of the same name in another do. */
const LIKE = {
  ShipmentPickupInput: 'ShipmentEndInput', ShipmentEndInput: 'CustomerInput',
  ShipmentInput: 'CustomerInput',
};

/** Return the API's own description, in plain text. */
export function apiHelpOf(schema) {
  return (schema.description ?? '').replaceAll('`', '');
}

/** Return a value to choose from in words, those of its field first; itself if it is a name. */
export function choiceOf(value, name = '') {
  const key = value.replaceAll(/\W/g, '_');
  const usual = t(`choice.${key}`, { defaultValue: value });
  return t(`choice.${name}_${key}`, { defaultValue: usual });
}

/** Return an object with what a schema demands and nothing else. */
export function blank(schemas, schema) {
  const found = resolve(schemas, schema).schema;
  const required = found.required ?? [];
  return Object.fromEntries(
    required.map((name) => [name, blankValue(schemas, found.properties[name])]));
}

function blankValue(schemas, schema) {
  const found = resolve(schemas, schema).schema;
  switch (kindOf(found)) {
    case 'object':
      return blank(schemas, found);
    case 'number':
      return Math.max(found.minimum ?? 0, 0);
    case 'numbers':
      return Array(found.minItems ?? 1).fill(0);
    case 'choice':
      return found.enum[0];
    case 'switch':
      return false;
    case 'text':
      return '';
    default:
      return [];
  }
}

/** Return what an empty field means, for its placeholder. */
export function emptyMeans(schema, nullable) {
  if (schema.empty) return schema.empty;
  const stated = schema.default;
  if (stated !== null && stated !== undefined && typeof stated !== 'object') {
    return choiceOf(String(stated));
  }
  const byDefault = /([\d.]+) by default/.exec(schema.description ?? '');
  if (byDefault) return byDefault[1];
  const told = /Null: ([^.]*)\./.exec(schema.description ?? '')?.[1].replaceAll('`', '') ?? '';
  if (!nullable || !told || told.length > LONGEST_HINT) return '';
  return t(`empty.${told.replaceAll(' ', '_')}`, { defaultValue: told });
}
