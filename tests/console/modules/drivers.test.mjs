import assert from 'node:assert/strict';
import { register } from 'node:module';
import test from 'node:test';

import { goOnAsTold, linksByVehicle, nextOrder, openDispatches, standingText, withMade } from '../../../app/console/static/js/core/dispatches.js';
import { pointText } from '../../../app/console/static/js/core/format.js';

register('./as-served.mjs', import.meta.url);
const { clock, windowText } = await import('../../../app/records/dispatches/static/js/clocks.js');
const { linkOf, tokenOf } = await import('../../../app/records/dispatches/static/js/link.js');
const { chosenNavigator, NAVIGATORS, navigation } = await import('../../../app/records/dispatches/static/js/navigators.js');
const { allow, isAllowed, watch } = await import('../../../app/records/dispatches/static/js/positions.js');
const { isBroken, isOther, newsOf, nextStep, standings, telephone, titleOf } = await import('../../../app/records/dispatches/static/js/steps.js');

const PLACE = { latitude: 48.1, longitude: 11.5 };

function storage(entries = {}) {
  const kept = new Map(Object.entries(entries));
  return {
    getItem: (key) => kept.get(key) ?? null,
    setItem: (key, value) => kept.set(key, value),
  };
}

test('times are those of the zone of the plan, on the day that clocks change too', () => {
  const summer = { plan_start: '2026-03-29T00:00:00+01:00', time_zone: 'Europe/Berlin' };
  assert.equal(clock(summer, 3600), '1:00');
  assert.equal(clock(summer, 2 * 3600), '3:00');
  const offset = { plan_start: '2026-03-29T00:00:00-05:30', time_zone: null };
  assert.equal(clock(offset, 8 * 3600 + 300), '8:05');
  assert.equal(clock({ plan_start: '2026-03-29T00:00:00Z', time_zone: null }, 60), '0:01');
  assert.equal(windowText(offset, { earliest: 0, latest: 3600 }), 'until 1:00');
  assert.equal(windowText(offset, { earliest: 3600, latest: null }), 'from 1:00');
});

test('navigators are told latitude before longitude', () => {
  for (const name of Object.keys(NAVIGATORS)) {
    const address = decodeURIComponent(navigation(name, { location: PLACE }));
    assert.match(address, /48\.1,11\.5/, name);
    assert.doesNotMatch(address, /11\.5,48\.1/, name);
  }
  assert.equal(chosenNavigator(storage(), 'Mozilla (iPhone)'), 'apple');
  assert.equal(chosenNavigator(storage(), 'Mozilla (Android)'), 'geo');
  const kept = storage({ 'tandem-drive-navigator': 'osm' });
  assert.equal(chosenNavigator(kept, 'Mozilla (iPhone)'), 'osm');
});

test('the navigator that can keeps off what the vehicle avoids', () => {
  const link = (name, avoid) => navigation(name, { location: PLACE, avoid });
  assert.match(link('google', ['tolls', 'motorways', 'ferries']),
    /&travelmode=driving&avoid=tolls,highways,ferries$/);
  for (const name of Object.keys(NAVIGATORS)) {
    assert.doesNotMatch(link(name, []), /avoid/, name);
    if (name !== 'google') assert.equal(link(name, ['tolls']), link(name, []));
  }
});

test('sheets say latitude before longitude, and which is which', () => {
  assert.equal(pointText([11.5, 48.1], { isGeographic: true }), 'Latitude, longitude: 48.1, 11.5');
  assert.equal(pointText([3, 4], { isGeographic: false }), 'x, y: 3, 4');
});

test('where nobody ordered, a drone is all that the driver comes for', () => {
  const launch = { kind: 'launch', drone: 'truck-1/drone-1', place: 'pier', customers: [{ id: 'C' }] };
  assert.equal(titleOf({ ...launch, place_kind: 'launch_site' }), 'Launch drone-1 to C, at pier');
  assert.equal(titleOf({ ...launch, place_kind: 'customer' }), 'Launch drone-1 to C');
});

test('what was told last of a step holds, sent or not', () => {
  const steps = [{ id: 'a' }, { id: 'b' }, { id: 'c' }];
  const found = standings(
    [{ id: 'a', state: 'done' }, { id: 'b', state: 'failed', reason: 'x' }],
    [{ step: 'a', kind: 'undone' }, { step: 'c', kind: 'failed', reason: 'y' }],
  );
  assert.deepEqual(found.get('b'), { state: 'failed', reason: 'x', isSent: true });
  assert.deepEqual(found.get('c'), { state: 'failed', reason: 'y', isSent: false });
  assert.equal(nextStep(steps, found).id, 'a');
  assert.equal(isOther(steps, [...steps]), false);
  assert.equal(isOther(steps, [...steps].reverse()), true);
});

test('the last link is opened again without its token', () => {
  const kept = storage();
  assert.equal(tokenOf('', kept), null);
  assert.equal(tokenOf('#tdm_drive_0123456789ab_ff', kept), 'tdm_drive_0123456789ab_ff');
  assert.equal(tokenOf('', kept), 'tdm_drive_0123456789ab_ff');
  assert.equal(linkOf('tdm_drive_0123456789ab_ff'), '0123456789ab');
});

test('numbers are dialled as they are written', () => {
  assert.equal(telephone('+49 (0)89 123-45'), 'tel:+498912345');
  assert.equal(telephone('089/12345'), 'tel:08912345');
});

test('links stay known by what was told when they were made', () => {
  const made = withMade({}, { links: [{ id: 'x', url: 'u', qr: 'q' }, { id: 'y', url: null }] });
  const reply = { links: [{ id: 'x', vehicle: 'van-1', url: null, qr: null, done: 1 }] };
  const link = linksByVehicle({ reply, made }).get('van-1');
  assert.deepEqual([link.url, link.qr, link.done], ['u', 'q', 1]);
  assert.deepEqual(linksByVehicle(null), new Map());
});

test('how far a driver is stands in words', () => {
  const link = { state: 'open', opened_at: null, done: 0, failed: 0, steps: 4, standing: [] };
  assert.equal(standingText(link), 'not opened yet');
  assert.equal(standingText({ ...link, opened_at: 'x' }), 'opened');
  const standing = [{ time: 29000 }, { time: 30000 }];
  const far = { ...link, done: 1, failed: 1, standing };
  assert.equal(standingText(far), '2 of 4, at 8:20, 1 failure');
  assert.equal(standingText({ ...far, state: 'revoked' }), 'revoked');
  const broken = { id: 'vehicle', kind: 'vehicle', state: 'failed', time: 0 };
  assert.match(standingText({ ...far, standing: [broken, ...far.standing] }), /^broken down; /);
});

test('a parcel that comes back is released when it is back', () => {
  const customers = [{ id: 'A', release_time: 99999 }, { id: 'B' }, { id: 'C' }];
  const plan = { routes: [] };
  const failed = [
    { customer: 'A', is_open: true, parcel_back: 500.5 },
    { customer: 'B', is_open: true, parcel_back: 500.5 },
    { customer: 'C', is_open: false, parcel_back: 500.5 },
  ];
  const asked = goOnAsTold({ customers }, { replan: { plan, freeze_before: 60 }, failed });
  assert.deepEqual(asked.customers, [
    { id: 'A', release_time: 99999 }, { id: 'B', release_time: 501 }, { id: 'C' },
    { id: 'C (again)', release_time: 501 },
  ]);
  assert.deepEqual(asked.replan, { plan, freeze_before: 60 });
});

test('whoever failed at a drone is ordered anew, each time once', () => {
  const replan = { plan: { routes: [] }, freeze_before: 60 };
  const told = (customer) => ({ customer, is_open: false, parcel_back: 500 });
  const ids = ({ customers }) => customers.map(({ id }) => id);
  const once = goOnAsTold({ customers: [{ id: 'C' }] }, { replan, failed: [told('C')] });
  assert.deepEqual(ids(once), ['C', 'C (again)']);
  const twice = goOnAsTold(once, { replan, failed: [told('C')] });
  assert.deepEqual(ids(twice), ['C', 'C (again)']);
  const failed = [told('C'), told('C (again)')];
  assert.deepEqual(ids(goOnAsTold(once, { replan, failed })), ['C', 'C (again)', 'C (again 2)']);
  assert.equal(nextOrder('C (again 2)'), 'C (again 3)');
});

test('whose drone was neither launched nor recovered is still the same order', () => {
  const replan = { plan: { routes: [] }, freeze_before: 60 };
  const told = { customer: 'C', parcel_back: 500 };
  const failed = [{ ...told, is_open: true }, { ...told, is_open: false }];
  const { customers } = goOnAsTold({ customers: [{ id: 'C' }] }, { replan, failed });
  assert.deepEqual(customers, [{ id: 'C', release_time: 500 }]);
});

test('a vehicle is broken until it is told to go on', () => {
  const told = [{ id: 'vehicle', state: 'failed' }];
  assert.equal(isBroken(standings(told, [])), true);
  assert.equal(isBroken(standings(told, [{ step: 'vehicle', kind: 'undone' }])), false);
  assert.equal(isBroken(standings([], [{ step: 'vehicle', kind: 'failed' }])), true);
  assert.equal(isBroken(standings([], [])), false);
});

test('vehicles that drivers told to be broken are so in what is planned on', () => {
  const replan = { plan: { routes: [] }, freeze_before: 60, unavailable: ['van-1'] };
  const asked = goOnAsTold({ customers: [] }, { replan, failed: [] });
  assert.deepEqual(asked.replan.unavailable, ['van-1']);
  const again = goOnAsTold(asked, { replan: { ...replan, unavailable: ['van-2'] }, failed: [] });
  assert.deepEqual(again.replan.unavailable, ['van-1', 'van-2']);
});

test('plans on the road are found again until they end', () => {
  const sent = { created_at: '2026-11-23T05:00:00Z', plan_start: '2026-11-23T00:00:00+01:00' };
  const found = openDispatches(
    [
      { id: 'a', ends_at: '2026-11-23T23:00:00Z', ...sent },
      { id: 'b', ends_at: '2026-11-22T23:00:00Z', ...sent },
    ],
    new Date('2026-11-23T08:00:00Z'),
  );
  assert.deepEqual(found.map(({ id }) => id), ['a']);
  assert.match(found[0].words, /^2026-11-23, sent out /);
});

test('what is new for a driver, and what was taken away, is told by place', () => {
  const step = (kind, place, customers = []) => ({ kind, place, customers });
  const seen = [step('depart', 'hub'), step('stop', 'A'), step('launch', 'A', [{ id: 'C' }])];
  const steps = [step('depart', 'hub'), step('stop', 'B'), step('launch', 'B', [{ id: 'C' }])];
  const { added, gone } = newsOf({ seen, steps });
  assert.deepEqual([added, gone].map((list) => list.map(({ place }) => place)), [['B'], ['A']]);
  assert.deepEqual(newsOf({ steps }).added.length, 2);
});

test('where the vehicle is is told at most every half minute, and the latest at last', (test_) => {
  test_.mock.timers.enable({ apis: ['setInterval', 'Date'] });
  let hear;
  let fail;
  const geolocation = {
    watchPosition: (onPlace, onError) => {
      [hear, fail] = [onPlace, onError];
      return 7;
    },
    clearWatch: test_.mock.fn(),
  };
  globalThis.navigator ??= {};
  Object.defineProperty(navigator, 'geolocation', { value: geolocation, configurable: true });
  const told = [];
  const refused = test_.mock.fn();
  const end = watch((place) => told.push(place), refused);
  const at = (longitude) => hear({ coords: { longitude, latitude: 48.1 } });
  at(11.5000012);
  at(11.51);
  at(11.52);
  assert.deepEqual(told, [[11.5, 48.1]]);
  test_.mock.timers.tick(30_000);
  assert.deepEqual(told, [[11.5, 48.1], [11.52, 48.1]]);
  test_.mock.timers.tick(60_000);
  assert.equal(told.length, 2);
  fail({ code: 2, PERMISSION_DENIED: 1 });
  assert.equal(refused.mock.callCount(), 0);
  fail({ code: 1, PERMISSION_DENIED: 1 });
  assert.equal(refused.mock.callCount(), 1);
  end();
  assert.deepEqual(geolocation.clearWatch.mock.calls[0].arguments, [7]);
});

test('nobody allows it who was not asked', () => {
  const kept = storage();
  assert.equal(isAllowed(kept), false);
  allow(kept, true);
  assert.equal(isAllowed(kept), true);
  allow(kept, false);
  assert.equal(isAllowed(kept), false);
});
