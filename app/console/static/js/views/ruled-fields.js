/** Fields of which a few are used every day; the others are found by what they are about. */

import { getIn, keyOf } from '../core/paths.js';
import { helpOf, labelOf, resolve } from '../core/schema.js';
import { html, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { Fields } from './form.js';
import { t } from '../texts.js';

/**
 * Fields of an object.
 *
 * @param everyday names of those that are always there
 * @param topics names of the others by what they are about; those of none come last
 * @param others as for `Fields`
 */
export function RuledFields({ schema, keys, request, everyday, topics, skip = [], ...others }) {
  const schemas = useStore((state) => state.schemas);
  const errors = useStore((state) => state.errors);
  const [opened, setOpened] = useState(new Set());
  const { properties } = resolve(schemas, schema).schema;
  const known = Object.keys(properties).filter((name) => !skip.includes(name));
  const rules = known.filter((name) => !everyday.includes(name));
  const isWrong = (name) =>
    errors.some((error) => keyOf(error.keys.slice(0, keys.length + 1)) === keyOf([...keys, name]));
  const isOpen = (name) => opened.has(name) || isWrong(name);
  const inUse = rules.filter((name) => getIn(request, [...keys, name]) !== undefined);
  const toggle = (name) => {
    const next = new Set(opened);
    if (!next.delete(name)) next.add(name);
    setOpened(next);
  };
  const button = (name) => html`<button type="button" key=${name} class="chip"
    aria-pressed=${isOpen(name)} data-rule=${`${keys.join('-')}-${name}`}
    onClick=${() => toggle(name)}>${labelOf(name)}</button>`;
  const hidden = known.filter((name) => !everyday.includes(name) && !isOpen(name));
  return html`<${Fields} schema=${schema} keys=${keys} request=${request}
      skip=${[...skip, ...hidden]} ...${others} />
    ${inUse.length > 0 && html`<div class="rule-chips" role="group"
      aria-label=${t('rules.inUse')}>${inUse.map(button)}</div>`}
    <${Finder} rules=${rules.filter((name) => !inUse.includes(name))} topics=${topics}
      button=${button} textOf=${(name) =>
        `${labelOf(name)} ${helpOf(resolve(schemas, schema).schema.title, name, properties[name])}`}
      onAll=${() => setOpened(new Set(rules))} />`;
}

/** The rules that aren't in use, by topic, as far as they have what is typed. */
function Finder({ rules, topics, button, textOf, onAll }) {
  const [sought, setSought] = useState('');
  const isSought = (name) => textOf(name).toLowerCase().includes(sought.trim().toLowerCase());
  const found = rules.filter(isSought);
  const named = new Set(Object.values(topics).flat());
  const groups = [
    ...Object.entries(topics).map(([topic, names]) => [
      topic, found.filter((name) => names.includes(name))]),
    ['other', found.filter((name) => !named.has(name))],
  ].filter(([, names]) => names.length > 0);
  return html`<details class="finder"><summary>${t('rules.find')}</summary>
    <input type="text" value=${sought} placeholder=${t('rules.find')} aria-label=${t('rules.find')}
      onInput=${(event) => setSought(event.target.value)} />
    ${groups.map(([topic, names]) => html`<div key=${topic} role="group"
      aria-label=${t(`rules.${topic}`)}><h4>${t(`rules.${topic}`)}</h4>
      <div class="rule-chips">${names.map(button)}</div></div>`)}
    ${!groups.length && html`<p class="help">${t('rules.none')}</p>`}
    <button type="button" onClick=${onAll}>${t('rules.all')}</button></details>`;
}
