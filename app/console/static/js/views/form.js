/** Forms made from the API's schema, with units, descriptions and errors at their fields. */

import { freeName } from '../core/changes.js';
import { clock, parseClock, parseNumber, withDecimals } from '../core/format.js';
import { getIn, keyOf, pathOf, removeIn, setIn } from '../core/paths.js';
import { assumptionIn, presetOf, withEntry, withoutEntry } from '../core/presets.js';
import {
  apiHelpOf, blank, choiceOf, emptyMeans, helpOf, kindOf, labelOf, resolve, unitOf, withinSentence,
  wordLines, wordsOf,
} from '../core/schema.js';
import { needlessIn } from '../core/relations.js';
import { durationText, readDuration, timeKind, timeKindAt } from '../core/times.js';
import { html, useLayoutEffect, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';
import { Said } from './said.js';

/**
 * Fields of an object.
 *
 * @param schema of the object
 * @param keys the object's place in the request
 * @param request the whole request
 * @param onChange called with the changed request
 * @param skip names of fields to leave out
 * @param choices names of fields and the values to choose from
 */
export function Fields({ schema, keys, request, onChange, skip = [], choices = {} }) {
  const schemas = useStore((state) => state.schemas);
  const { properties = {}, required = [], title } = resolve(schemas, schema).schema;
  const names = Object.keys(properties).filter((name) => !skip.includes(name)
    && !isOfTables(name, request, keys));
  return html`<div class="fields">${names.map((name) => html`
    <${Field} key=${keyOf([...keys, name])} name=${name} owner=${title}
      schema=${properties[name]}
      keys=${[...keys, name]} request=${request} onChange=${onChange} choices=${choices}
      required=${required.includes(name)} />`)}</div>`;
}

/** Tell whether a field is of places in tables of legs, of which there are none. */
function isOfTables(name, request, keys) {
  return name.endsWith('location_index') && !request.matrices
    && getIn(request, [...keys, name]) === undefined;
}

/** Kinds of fields whose entries have no field of their own. */
const ENTRIES = new Set(['texts', 'several', 'numbers', 'durations', 'words']);

/** One field, of whatever kind its schema says; `owner` is the title of the schema that has it. */
export function Field({
  name, schema, keys, request, onChange, owner = 'PlanRequest', choices = {}, required = false,
}) {
  const schemas = useStore((state) => state.schemas);
  const found = ruled(resolve(schemas, schema), owner, request, keys);
  const kind = choices[name] ? 'choice' : kindOf(found.schema);
  const errors = useStore((state) => state.errors).filter(
    // What is wrong with one of several texts or numbers is told at the field that has them all.
    (error) => keyOf(ENTRIES.has(kind) ? error.keys.slice(0, keys.length) : error.keys)
      === keyOf(keys));
  if (kind === 'other') return null;
  const time = timeKindAt(schema, request, keys);
  const help = html`<${Help} id=${`${idOf(keys)}-help`} keys=${keys} schema=${found.schema}
    text=${helpOf(owner, name, found.schema)} />`;
  const shared = { name, keys, request, onChange, errors, schema: found.schema, choices, help };
  if (kind === 'object' && Array.isArray(getIn(request, keys))) {
    return html`<${ListField} ...${shared} schema=${{ ...found.schema, items: found.schema }}
      nullable=${found.nullable} />`;
  }
  if (kind === 'object') return html`<${ObjectField} ...${shared} nullable=${found.nullable} />`;
  if (kind === 'words') return html`<${WordsField} ...${shared} />`;
  if (kind === 'several') return html`<${SeveralField} ...${shared} />`;
  if (kind === 'objects') return html`<${ListField} ...${shared} nullable=${found.nullable} />`;
  return html`<${PlainField} ...${shared} kind=${time ?? kind} nullable=${found.nullable}
    required=${required} />`;
}

/** Return a schema whose empty field means what a published rule says, where one is stated. */
function ruled(found, owner, request, keys) {
  const isRuled = owner === 'DrivingRulesInput' && getIn(request, [...keys.slice(0, -1), 'preset']);
  return isRuled && found.nullable
    ? { ...found, schema: { ...found.schema, empty: t('form.asRuled') } } : found;
}

/** How numbers that are times are shown and read, by their kind. */
const INSTANT = {
  show: (value) => clock(value, { precise: true }),
  read: parseClock,
  example: () => t('form.exampleInstant'),
};
const TIMES = {
  instant: INSTANT,
  opening: INSTANT,
  duration: { show: durationText, read: readDuration, example: () => t('form.exampleDuration') },
};

/** What a field is for; its place in the API and what that says of it are behind a click. */
function Help({ id, keys, schema, text }) {
  return html`<div class="help"><p id=${id}>${text}</p>
    <details class="in-api"><summary>${t('form.inApi')}</summary>
      <p lang="en"><code>${pathOf(keys)}</code> ${apiHelpOf(schema)}</p></details></div>`;
}

function idOf(keys) {
  return `field-${keys.join('-')}`;
}

function PlainField({
  name, schema, keys, request, onChange, kind, nullable, required, errors, choices, help,
}) {
  const id = idOf(keys);
  const value = getIn(request, keys);
  const set = (next) =>
    onChange(next === undefined ? removeIn(request, keys) : setIn(request, keys, next));
  const Input = { choice: ChoiceInput, switch: SwitchInput }[kind] ?? TextInput;
  const invalid = errors.length > 0;
  const [problem, setProblem] = useState(null);
  const isWrong = Boolean(problem) || invalid;
  return html`<div class=${`field kind-${kind} ${invalid || problem ? 'invalid' : ''}`}>
    <label for=${id}>${labelOf(name)}</label>
    <${Input} id=${id} name=${name} kind=${kind} schema=${schema} value=${value} set=${set}
      nullable=${nullable} required=${required} choices=${choices[name]} onProblem=${setProblem}
      describedBy=${`${id}-help${isWrong ? ` ${id}-error` : ''}`}
        invalid=${isWrong} />
    <span class="unit">${
      TIMES[kind] || labelOf(name).endsWith(unitOf(schema)) ? '' : unitOf(schema)}</span>
    ${help}
    ${isWrong && html`<div class="error" id=${`${id}-error`}>${
        problem ?? errors.map((error) => html`<${Said} key=${error.code} ...${error} />`)
      }</div>`}
  </div>`;
}

/** A field in a table: its input alone, called by its `label`. */
export function Cell({ schema, keys, request, onChange, label, required = false }) {
  const schemas = useStore((state) => state.schemas);
  const errors = useStore((state) => state.errors).filter(
    (error) => keyOf(error.keys) === keyOf(keys));
  const [problem, setProblem] = useState(null);
  const found = resolve(schemas, schema);
  const id = idOf(keys);
  const set = (next) =>
    onChange(next === undefined ? removeIn(request, keys) : setIn(request, keys, next));
  const isWrong = Boolean(problem) || errors.length > 0;
  return html`<${TextInput} id=${id} kind=${timeKind(schema) ?? kindOf(found.schema)} label=${label}
      schema=${found.schema} value=${getIn(request, keys)} set=${set} nullable=${found.nullable}
      required=${required} onProblem=${setProblem} invalid=${isWrong}
      describedBy=${isWrong ? `${id}-error` : null} />
    ${isWrong && html`<div class="error" id=${`${id}-error`}>${
      problem ?? errors.map((error) => html`<${Said} key=${error.code} ...${error} />`)}</div>`}`;
}

/** Stands for a value that is no choice but an object. */
const OWN_PLACE = 'own place';

function ChoiceInput({ id, name, schema, value, set, choices, describedBy, nullable }) {
  const values = choices ?? schema.enum;
  const own = typeof value === 'object' && value !== null;
  const shown = own ? OWN_PLACE : (value ?? schema.default ?? '');
  return html`<select id=${id} aria-describedby=${describedBy} value=${shown}
    onChange=${(event) => set(event.target.value === '' ? undefined : event.target.value)}>
    ${own && html`<option value=${OWN_PLACE}>${t('form.ownPlace')}</option>`}
    ${nullable && html`<option value="">${emptyMeans(schema, true) || t('form.none')}</option>`}
    ${values.map((entry) => html`<option key=${entry} 
      value=${entry}>${choices ? entry : choiceOf(entry, name)}</option>`)}
  </select>`;
}

function SwitchInput({ id, schema, value, set, describedBy }) {
  return html`<input type="checkbox" id=${id} aria-describedby=${describedBy}
    checked=${value ?? schema.default ?? false}
      onChange=${(event) => set(event.target.checked)} />`;
}

const LIST = /[,;]\s*/;

/** Return the text of a value. */
function textOf(kind, value) {
  if (value === null || value === undefined) return '';
  if (TIMES[kind] && typeof value === 'number') return TIMES[kind].show(value);
  if (kind === 'numbers' && !Array.isArray(value)) return value.address ?? '';
  if (kind === 'durations') return value.map(durationText).join(', ');
  if (kind === 'number') return withDecimals(String(value));
  return kind === 'numbers' || kind === 'texts' ? value.join(', ') : String(value);
}

/** Return `{value}` or `{problem}` of a text; the value undefined if it is left out. */
function valueOf(text, { kind, required }) {
  const trimmed = text.trim();
  if (trimmed === '' && kind === 'texts') return { value: undefined };
  if (trimmed === '') {
    return required ? { problem: t('form.required') } : { value: undefined };
  }
  if (kind === 'text') return { value: trimmed };
  if (kind === 'texts') return { value: trimmed.split(LIST).filter(Boolean) };
  if (TIMES[kind]) {
    const value = TIMES[kind].read(trimmed);
    return value === null
      ? { problem: t('form.noTime', { text: trimmed, example: TIMES[kind].example() }) }
      : { value };
  }
  if (kind === 'number') {
    const value = parseNumber(trimmed);
    return value === null ? { problem: t('form.noNumber', { text: trimmed }) } : { value };
  }
  if (kind === 'durations') {
    const lengths = trimmed.split(LIST).map(readDuration);
    return lengths.includes(null)
      ? { problem: t('form.noTime', { text: trimmed, example: t('form.exampleDuration') }) }
      : { value: lengths };
  }
  const values = trimmed.split(LIST).map(parseNumber);
  return values.includes(null)
    ? { problem: t('form.numbers') }
    : { value: values };
}

/** Return what stands in an empty field: what that means, in words that are no value. */
function hintOf(kind, schema, nullable) {
  const means = emptyMeans(schema, nullable);
  if (!/^[\d.]+$/.test(means)) return means;
  const value = TIMES[kind] ? TIMES[kind].show(Number(means)) : withDecimals(means);
  return TIMES[kind] && Number(means) === 0 ? '' : t('form.else', { value });
}

function TextInput({
  id, kind, schema, value, set, nullable, required, describedBy, invalid, onProblem, label = null,
}) {
  const [text, setText] = useState(textOf(kind, value));
  useLayoutEffect(() => {
    setText(textOf(kind, value));
    onProblem(null);
  }, [textOf(kind, value)]);
  const commit = () => {
    const read = valueOf(text, { kind, required });
    onProblem(read.problem ?? null);
    if (!read.problem && textOf(kind, read.value) !== textOf(kind, value)) set(read.value);
  };
  const numeric = kind === 'number';
  return html`<input type="text" id=${id} value=${text} aria-describedby=${describedBy}
    aria-label=${label} aria-invalid=${invalid} aria-required=${required} autocomplete="off"
    spellcheck=${false} inputmode=${numeric ? 'decimal' : 'text'}
    placeholder=${hintOf(kind, schema, nullable)}
    onInput=${(event) => setText(event.target.value)} onBlur=${commit}
    onKeyDown=${(event) => event.key === 'Enter' && commit()} />`;
}

function ObjectField({ name, schema, keys, request, onChange, nullable, choices, help }) {
  const schemas = useStore((state) => state.schemas);
  const value = getIn(request, keys);
  const present = value !== null && value !== undefined;
  const toggle = (event) =>
    onChange(
      event.target.checked
        ? setIn(request, keys, presetOf(name, request, keys) ?? blank(schemas, schema))
        : removeIn(request, keys));
  return html`<fieldset class="group">
    <legend>${nullable
        ? html`<label><input type="checkbox" id=${idOf(keys)} checked=${present}
      onChange=${toggle} /> ${labelOf(name)}</label>`
        : labelOf(name)
    }</legend>
    ${help}
    <p class="assumed" role="status">${present ? assumptionIn(name, request, value) : ''}</p>
    ${(present || !nullable) && html`<${Fields} schema=${schema} keys=${keys} request=${request}
      onChange=${onChange} choices=${choices} />`}
  </fieldset>`;
}

/** How what is named in lines is shown and read: words, numbers or lengths of time. */
const LINES = {
  string: { show: String, read: String, example: () => t('form.exampleWords') },
  number: { show: String, read: parseNumber, example: () => t('form.exampleNumbers') },
  duration: { ...TIMES.duration, example: () => t('form.exampleDurations') },
};

function WordsField({ name, keys, request, onChange, errors, schema, help }) {
  const id = idOf(keys);
  const { additionalProperties } = schema;
  const lines = LINES[timeKind(additionalProperties) ?? additionalProperties.type];
  const value = wordLines(getIn(request, keys), lines.show);
  const [text, setText] = useState(value);
  useLayoutEffect(() => setText(value), [value]);
  const words = wordsOf(text, lines.read);
  const commit = () => {
    if (!words || wordLines(words, lines.show) === value) return;
    onChange(text.trim() ? setIn(request, keys, words) : removeIn(request, keys));
  };
  const isWrong = !words || errors.length > 0;
  return html`<div class=${`field kind-words ${isWrong ? 'invalid' : ''}`}>
    <label for=${id}>${labelOf(name)}</label>
    <textarea id=${id} rows=${Math.min(value.split('\n').length + 1, 6)} value=${text}
      aria-describedby=${`${id}-help`} aria-invalid=${isWrong}
      placeholder=${t('form.such', { example: lines.example() })} onBlur=${commit}
      onInput=${(event) => setText(event.target.value)}></textarea>
    ${help}
    ${!words && html`<p class="error">${t('form.lines', { example: lines.example() })}</p>`}
    ${errors.map((error) => html`<div class="error"><${Said} ...${error} /></div>`)}
  </div>`;
}

/** Some of few values, each with a box to check. */
function SeveralField({ name, keys, request, onChange, errors, schema, help }) {
  const values = getIn(request, keys) ?? [];
  const check = (entry, isChecked) => {
    const next = schema.items.enum.filter((each) => each === entry ? isChecked
      : values.includes(each));
    onChange(next.length ? setIn(request, keys, next) : removeIn(request, keys));
  };
  return html`<fieldset class="group" aria-describedby=${`${idOf(keys)}-help`}>
    <legend>${labelOf(name)}</legend>
    <div class="buttons">${schema.items.enum.map((entry) => html`<label key=${entry}>
      <input type="checkbox" id=${idOf([...keys, entry])} checked=${values.includes(entry)}
        onChange=${(event) => check(entry, event.target.checked)} />
      ${choiceOf(entry, name)}</label>`)}</div>
    ${help}
    ${errors.map((error) => html`<div class="error"><${Said} ...${error} /></div>`)}
  </fieldset>`;
}

/** What entries that are added are called, with a number. */
const STEMS = {
  drones: 'drone', launch_sites: 'site', shipments: 'shipment', pickups: 'pickup',
  breaks: 'break', alternatives: 'place',
};

function ListField({ name, schema, keys, request, onChange, nullable, errors, choices, help }) {
  const schemas = useStore((state) => state.schemas);
  const values = getIn(request, keys) ?? [];
  const add = () => {
    const preset = presetOf(name, request, keys);
    const entry = preset && { id: freeName(values, STEMS[name]), ...preset };
    onChange(withEntry(request, keys, entry ?? blank(schemas, schema.items)));
  };
  const remove = (index) => {
    const isLast = nullable && values.length === 1;
    onChange(isLast ? removeIn(request, keys) : withoutEntry(request, keys, index));
  };
  return html`<fieldset class="group list">
    <legend>${labelOf(name)}</legend>
    ${help}
    ${errors.map((error) => html`<div class="error"><${Said} ...${error} /></div>`)}
    ${values.map((entry, index) => html`<div class="entry" key=${index}>
      <${Fields} schema=${schema.items} keys=${[...keys, index]} request=${request}
        onChange=${onChange} choices=${choices}
        skip=${name === 'relations' ? needlessIn(entry) : []} />
      <button type="button" class="quiet"
        onClick=${() => remove(index)}>${t('form.remove', { number: index + 1 })}</button>
    </div>`)}
    <button type="button" onClick=${add}>${t(`form.addTo.${name}`, {
      defaultValue: t('form.add', { list: withinSentence(labelOf(name)) }),
    })}</button>
  </fieldset>`;
}
