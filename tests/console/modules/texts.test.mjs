/** Texts of the console and of drivers' page: complete in every language, and none in vain. */

import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { register } from 'node:module';
import { test } from 'node:test';
import { speaking } from '../../../app/console/static/js/language.js';

register('./as-served.mjs', import.meta.url);

const APP = new URL('../../../app/', import.meta.url);
const PAGES = ['console/static/', 'records/dispatches/static/', 'records/days/static/'];
const PLURAL = /_(one|other)$/;

async function textsOf(page, language) {
  return (await import(new URL(`${page}texts/${language}.js`, APP))).default;
}

/** Return `[key, text]` of all texts. */
function flat(texts, before = '') {
  return Object.entries(texts).flatMap(([name, value]) =>
    typeof value === 'string' ? [[before + name, value]] : flat(value, `${before}${name}.`),
  );
}

function placeholders(text) {
  return [...new Set([...text.matchAll(/\{\{(\w+)\}\}/g)].map(([, name]) => name))].sort();
}

function sources(page) {
  const folder = new URL(`${page}js/`, APP);
  return readdirSync(folder, { recursive: true })
    .filter((name) => name.endsWith('.js') && name !== 'language.js')
    .map((name) => [name, readFileSync(new URL(name, folder), 'utf8')]);
}

/** Return patterns of the keys that a module asks for; `${}` in a key stands for one name. */
function asked(source) {
  const calls = source.matchAll(/(?<![\w.$])(?:t|parts)\(\s*(['`])((?:\$\{[^}]*\}|[^'`])*?)\1/g);
  return [...calls].map(([, , key]) => {
    const pattern = key
      .split(/\$\{[^}]*\}/)
      .map((part) => part.replaceAll('.', '\\.'))
      .join('\\w+');
    return { key, pattern: new RegExp(`^${pattern}$`) };
  });
}

for (const page of PAGES) {
  test(`${page}: both languages have the same keys and placeholders`, async () => {
    const [english, german] = await Promise.all(['en', 'de'].map((name) => textsOf(page, name)));
    const told = (texts) => flat(texts).map(([key, text]) => `${key} ${placeholders(text)}`);
    assert.deepEqual(told(german), told(english));
  });

  test(`${page}: no text is empty, and every text in one number is there in the other`, async () => {
    for (const language of ['en', 'de']) {
      const texts = new Map(flat(await textsOf(page, language)));
      for (const [key, text] of texts) {
        assert.ok(text.trim(), key);
        const sisters = ['_one', '_other'].map((end) => key.replace(PLURAL, end));
        if (PLURAL.test(key)) assert.ok(sisters.every((name) => texts.has(name)), key);
      }
    }
  });

  test(`${page}: every key that is asked for exists, and every text is asked for`, async () => {
    const keys = flat(await textsOf(page, 'en')).map(([key]) => key.replace(PLURAL, ''));
    const uses = sources(page).flatMap(([name, source]) =>
      asked(source).map((use) => ({ ...use, name })),
    );
    const missing = uses.filter(({ pattern }) => !keys.some((key) => pattern.test(key)));
    assert.deepEqual(missing.map(({ name, key }) => `${name}: ${key}`), []);
    const unused = keys.filter((key) => !uses.some(({ pattern }) => pattern.test(key)));
    assert.deepEqual(unused, []);
  });

  test(`${page}: keys stand where texts are asked for`, () => {
    const hidden = sources(page).flatMap(([name, source]) =>
      [...source.matchAll(/(?<![\w.$])(?:t|parts)\((?!\s*['`]).*/g)].map(
        ([call]) => `${name}: ${call}`,
      ),
    );
    assert.deepEqual(hidden, []);
  });
}

test('texts take numbers as the language writes them, and are chosen by them', () => {
  const texts = { ride: { stops_one: '{{count}} stop', stops_other: '{{count}} stops' } };
  const { t } = speaking({ en: texts });
  assert.equal(t('ride.stops', { count: 1 }), '1 stop');
  assert.equal(t('ride.stops', { count: 1234 }), '1,234 stops');
});

test('texts of another language are fetched once it is chosen', async () => {
  globalThis.localStorage = { setItem() {} };
  const fetched = [];
  const load = async (name) => {
    fetched.push(name);
    return { ride: { stops_one: '{{count}} Stopp', stops_other: '{{count}} Stopps' } };
  };
  const spoken = speaking({ en: { ride: { stops_one: '1 stop', stops_other: 'stops' } } }, load);
  for (const name of ['de', 'en', 'de']) await spoken.choose(name);
  delete globalThis.localStorage;
  assert.deepEqual(fetched, ['de']);
  assert.equal(spoken.language(), 'de');
  assert.equal(spoken.t('ride.stops', { count: 1234 }), '1.234 Stopps');
});

test('names are told as they are, whatever stands in them', () => {
  const { t } = speaking({ en: { to: 'To {{name}}' } });
  assert.equal(t('to', { name: '<b>$t(to) {{name}} & co' }), 'To <b>$t(to) {{name}} & co');
});

test('a text has elements of the page where they stand in the language', () => {
  const { parts } = speaking({ en: { cost: 'Cost {{sum}} for {{who}}' } });
  const node = { type: 'strong' };
  assert.deepEqual(parts('cost', { sum: node, who: 'A' }), ['Cost ', node, ' for A']);
});
