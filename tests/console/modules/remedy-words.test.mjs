/** Whatever the service says of who is left out is said in the page's language. */

import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import test from 'node:test';

import { endWindows, partsOf } from '../../../app/console/static/js/core/remedy-parts.js';
import { remedyInWords } from '../../../app/console/static/js/core/remedy-words.js';
import { applyRemedy } from '../../../app/console/static/js/core/remedy-changes.js';
import { choose } from '../../../app/console/static/js/texts.js';
import german from '../../../app/console/static/texts/de.js';

const JUDGE = new URL('../../../model/judge/', import.meta.url);
const SOURCES = readdirSync(JUDGE)
  .filter((name) => name.endsWith('.py'))
  .map((name) => readFileSync(new URL(name, JUDGE), 'utf8'));

/** What a browser has to choose a language with; other tests run beside, and have none. */
const BROWSER = {
  localStorage: { getItem: () => null, setItem() {} },
  document: { documentElement: {} },
};

/** What stands in words of the service for what is within braces. */
const VALUES = [
  [/in_minutes/, '5 minutes'],
  [/in_km/, '3.0 km'],
  [/_flyers|_drones/, ' of small'],
  [/_number/, '2 stops'],
  [/_amounts|decimal|quantity/, '7'],
  [/where/, ''],
  [/_window\b/, 'last window'],
];

function sample(text) {
  const said = text.replaceAll(/\{([^{}]*)\}/g, (_, value) =>
    VALUES.find(([pattern]) => pattern.test(value))?.[1] ?? 'van');
  return `${/unassigned_cost/.test(text) ? 'served' : 'fits'} ${said}`;
}

/** Every remedy that the judge words, but for windows of ends. */
const REMEDIES = [...readFileSync(new URL('remedy.py', JUDGE), 'utf8')
  .matchAll(/"((?:if|with|without) [^"\n]+[^"\n ])"/g)].map(([, text]) => sample(text));

const OF_ENDS = [
  'fits if the window of its pickup closed 1 minute later',
  'fits if the last window of its delivery closed 5 minutes later',
  'fits if the window of its pickup farm closed 1 minute later and the last window of its pickup ' +
    'mill closed 2.5 minutes later and the window of its delivery closed 3 minutes later',
  'fits if max_time_between were at least 5 minutes and max_detour were at least 2',
  'fits if its window 2 at A/kiosk closed 5 minutes later',
  'fits if its last window at A/kiosk closed 5 minutes later',
];

const SEVERAL = "fits if trips could be 3.0 km longer and if van's shift ended 5 minutes later " +
  'and with a battery of 7 Wh more';

test('every remedy of the judge is found in its sources', () => {
  assert.ok(REMEDIES.length > 35, String(REMEDIES.length));
});

test('every remedy is said in German, one of several limits as one sentence', async () => {
  Object.assign(globalThis, BROWSER);
  await choose('de');
  try {
    const left = [...REMEDIES, ...OF_ENDS].filter((remedy) =>
      !/^(passt|würde)/.test(remedyInWords(remedy)));
    assert.deepEqual(left, []);
    assert.equal(
      remedyInWords(SEVERAL),
      'passt, wenn Fahrten 3.0 km länger sein dürften und wenn die Schicht von van 5 min später ' +
        'endete und mit einem um 7 Wh größeren Akku',
    );
    assert.equal(
      remedyInWords(OF_ENDS[2]),
      'passt, wenn das Zeitfenster der Abholung farm 1 min später schlösse und das Zeitfenster ' +
        'der Abholung mill 2 min 30 s später schlösse und das Zeitfenster der Zustellung 3 min ' +
        'später schlösse',
    );
  } finally {
    await choose('en');
    for (const name of Object.keys(BROWSER)) delete globalThis[name];
  }
});

test('every reason of the judge has words in German', () => {
  const codes = new Set(SOURCES.flatMap((source) =>
    [...source.matchAll(/Diagnosis\(\s*"([A-Z_]+)"|Reason\(index, "([A-Z_]+)"/g)]
      .map(([, one, other]) => one ?? other)));
  assert.ok(codes.size > 20, String(codes.size));
  assert.deepEqual([...codes].filter((code) => !(code in german.said)), []);
});

const REQUEST = {
  customers: [
    { id: 'A', location: [0, 0], demand: [1], skills: [], time_window: { latest: 60 },
      time_windows: null, unassigned_cost: 1, max_time_aboard: 60,
      alternatives: [{ id: 'kiosk', time_windows: [{ latest: 60 }, { latest: 90 }] }] },
    { id: 'B', location: [0, 0], demand: [1] },
  ],
  shipments: [{ id: 'S', delivery: {}, pickups: [{ id: 'farm', amount: [1] },
    { id: 'mill', amount: [2], time_window: { latest: 60 } }] }],
  relations: [
    { kind: 'before', customers: ['A', 'B'], max_lag: 60 },
    { kind: 'before', customers: ['B', 'S/delivery'], max_lag: 600 },
  ],
  depots: [{ id: 'van', location: [0, 0] }],
  fleet: [{ id: 'van', count: 1, capacity: [5], shift: { latest: 60 }, driving_rules: {},
    max_trip_distance: 1000, turnaround: {}, breaks: [{ id: 'van', start: { latest: 60 } }],
    drones: [{ id: 'small', capacity: [1], endurance: 60, energy: { battery_wh: 5 } }] }],
};

test('every remedy changes the problem', () => {
  for (const remedy of REMEDIES) {
    const code = remedy === 'fits if van may serve it' ? 'VEHICLE' : 'SHIFT';
    const changed = applyRemedy(REQUEST, 'A', { vehicle_type: 'van', code, remedy });
    assert.ok(changed && changed !== REQUEST, remedy);
  }
});

test('several limits are changed together, as are windows of several pickups', () => {
  const reason = { vehicle_type: 'van', code: 'RANGE', remedy: SEVERAL };
  assert.equal(partsOf(SEVERAL).length, 3);
  const [van] = applyRemedy(
    { ...REQUEST, fleet: [{ ...REQUEST.fleet[0], drones: { energy: { battery_wh: 5 } } }] },
    'A', reason).fleet;
  assert.deepEqual(
    [van.max_trip_distance, van.shift.latest, van.drones.energy.battery_wh], [4000, 360, 12]);
  assert.equal(endWindows('fits if its window closed 5 minutes later'), null);
  const [shipment] = applyRemedy(REQUEST, 'S', { vehicle_type: 'van', code: 'TIME_WINDOW',
    remedy: 'fits if the window of its pickup mill closed 2 minutes later' }, 'shipment').shipments;
  assert.equal(shipment.pickups[1].time_window.latest, 180);
});

test('the orders of one are given more time, and none is given less', () => {
  const longer = (id, kind, minutes) => applyRemedy(REQUEST, id, { vehicle_type: 'van',
    code: 'RELATION', remedy: `fits if max_lag of its orders were at least ${minutes} minutes` },
  kind).relations.map(({ max_lag: lag }) => lag);
  assert.deepEqual(longer('A', 'customer', 5), [300, 600]);
  assert.deepEqual(longer('B', 'customer', 5), [300, 600]);
  assert.deepEqual(longer('S', 'shipment', 20), [60, 1200]);
});
