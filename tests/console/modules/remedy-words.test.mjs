/** What the service offers to who is left out is said in the page's language. */

import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import test from 'node:test';

import { remedyInWords } from '../../../app/console/static/js/core/remedy-words.js';
import { choose } from '../../../app/console/static/js/texts.js';
import german from '../../../app/console/static/texts/de.js';

const COUNSEL = new URL('../../../model/counsel/', import.meta.url);
const SOURCES = readdirSync(COUNSEL)
  .filter((name) => name.endsWith('.py'))
  .map((name) => readFileSync(new URL(name, COUNSEL), 'utf8'));

/** What a browser has to choose a language with; other tests run beside, and have none. */
const BROWSER = {
  localStorage: { getItem: () => null, setItem() {} },
  document: { documentElement: {} },
};

const REQUEST = {
  customers: [{ id: 'A', time_windows: [{ latest: 60 }, { latest: 90 }] }],
  shipments: [{ id: 'S' }],
  fleet: [{ id: 'van', skills: ['lift'], max_trip_distance: 1000, drones: { endurance: 600 } }],
};

const of = (code, who, path, change) => ({ code, who, changes: [{ path, ...change }] });
const whole = (...parts) => ({ parts, suffices: true, text: 'as the service says it',
  changes: parts.flatMap(({ changes }) => changes) });

const TRIP = of('TRIP_DISTANCE', 'van', '$.fleet[0].max_trip_distance', { by: 3000 });
const WINDOW = of('WINDOW', 'A', '$.customers[0].time_windows[1].latest', { by: 300 });

async function inGerman(parts) {
  Object.assign(globalThis, BROWSER);
  await choose('de');
  try {
    return parts.map((part) => remedyInWords(whole(part), REQUEST));
  } finally {
    await choose('en');
    for (const name of Object.keys(BROWSER)) delete globalThis[name];
  }
}

const SAID = [
  [TRIP, 'fits if trips could be 3 km longer', 'passt, wenn Fahrten 3 km länger sein dürften'],
  [WINDOW, 'fits if its window 2 closed 5 min later',
    'passt, wenn sein Zeitfenster 2 5 min später schlösse'],
  [of('WINDOW', 'A/kiosk', '$.customers[0].alternatives[0].time_window.latest', { by: 90 }),
    'fits if its window at kiosk closed 1 min 30 s later',
    'passt, wenn sein Zeitfenster bei kiosk 1 min 30 s später schlösse'],
  [of('END_WINDOW', 'S/pickup/farm', '$.shipments[0].pickups[0].time_window.latest', { by: 60 }),
    'fits if the window of its pickup farm closed 1 min later',
    'passt, wenn das Zeitfenster der Abholung farm 1 min später schlösse'],
  [of('SKILLS', 'van', '$.fleet[0].skills', { to: ['lift', 'crane'] }),
    'fits if van had crane', 'passt, wenn van crane hätte'],
  [of('CAPACITY', 'van', '$.fleet[0].capacity', { to: [9.5, 2] }),
    'fits if capacity were at least 9.5 / 2',
    'passt, wenn die Ladekapazität mindestens 9,5 / 2 wäre'],
  [of('ENDURANCE', 'van', '$.fleet[0].drones.endurance', { by: 60 }),
    'fits if endurance of van were at least 11 min',
    'passt, wenn die Flugdauer von van mindestens 11 min wäre'],
  [of('STOPS', 'van', '$.fleet[0].max_stops', { to: 1 }),
    'fits if van could make 1 stop', 'passt, wenn van 1 Stopp machen dürfte'],
  [of('UNASSIGNED_COST', null, '$.unassigned_cost', { to: 3.01 }),
    'fits if leaving anybody out cost at least 3.01',
    'passt, wenn Auslassen mindestens 3,01 kostete'],
];

test('remedies are said in English and in German', async () => {
  assert.deepEqual(SAID.map(([part]) => remedyInWords(whole(part), REQUEST)),
    SAID.map(([, english]) => english));
  assert.deepEqual(await inGerman(SAID.map(([part]) => part)), SAID.map(([, , told]) => told));
});

test('several limits are said as one sentence', () => {
  assert.equal(remedyInWords(whole(TRIP, WINDOW), REQUEST),
    'fits if trips could be 3 km longer and its window 2 closed 5 min later');
});

test('what is not known to suffice is not said to', () => {
  const buffer = { ...of('BUFFER', null, '$.airspace.buffer', { to: 990 }), suffices: false };
  assert.equal(remedyInWords(buffer, REQUEST), 'helps if flights kept 990 m from zones');
});

test('a remedy that is not known is said as the service says it', () => {
  const unknown = of('SUNDAYS', 'van', '$.fleet[0].sundays', { to: true });
  assert.equal(remedyInWords(whole(unknown), REQUEST), 'as the service says it');
  assert.equal(remedyInWords({ ...whole(), code: 'SHIFT' }, REQUEST), 'as the service says it');
});

test('every reason that is given has words in German', () => {
  const codes = new Set(SOURCES.flatMap((source) =>
    [...source.matchAll(/Diagnosis\(\s*"([A-Z_]+)"|Reason\(index, "([A-Z_]+)"/g)]
      .map(([, one, other]) => one ?? other)));
  assert.ok(codes.size > 20, String(codes.size));
  assert.deepEqual([...codes].filter((code) => !(code in german.said)), []);
});
