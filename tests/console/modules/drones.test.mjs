import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  droneCount,
  dronesOfSortie,
  flightCount,
  needlessFields,
} from '../../../app/console/static/js/core/drones.js';
import { flownIn } from '../../../app/console/static/js/core/drones-worth.js';
import { idleAtHubs } from '../../../app/console/static/js/core/idle-drones.js';
import { launchDurations } from '../../../app/console/static/js/core/launches.js';

const small = { id: 'small', count: 2, capacity: [1], launch_duration: 10 };
const large = {
  id: 'large',
  count: 1,
  capacity: [9],
  launch_duration: 30,
  turnaround: { swap_duration: 60 },
};
const truck = { drones: [small, { id: 'none', count: 0 }, large] };

test('the number of a drone tells its type, over a list of them', () => {
  const type = (number) => dronesOfSortie(truck, { drone: `truck-1/drone-${number}` })?.id;
  assert.deepEqual([1, 2, 3, 4].map(type), ['small', 'small', 'large', 'large']);
  assert.equal(dronesOfSortie({ drones: small }, { drone: 'a/drone-1' }), small);
  assert.equal(dronesOfSortie({ drones: null }, { drone: 'a/drone-1' }), null);
});

test('drones of all types are counted', () => {
  assert.equal(droneCount(truck), 3);
  assert.equal(droneCount({ drones: large }), 1);
  assert.equal(droneCount({}), 0);
});

test('launches take the time of their type, a swap but for the first', () => {
  const sorties = [
    { drone: 'truck-1/drone-3', launch_stop: 1, launch_time: 90 },
    { drone: 'truck-1/drone-3', launch_stop: 0, launch_time: 30 },
    { drone: 'truck-1/drone-1', launch_stop: 0, launch_time: 40 },
  ];
  assert.deepEqual(launchDurations(truck, sorties), [90, 30, 10]);
});

test('trips of vehicles that fly count as flights', () => {
  const request = { fleet: [{ id: 'van' }, { id: 'quad', flies: true }] };
  const routes = [{ type: 'van', trips: [{}] }, { type: 'quad', trips: [{}, {}] }];
  assert.equal(flightCount({ request, plan: { routes, summary: { sorties: 3 } } }), 5);
});

test('drones of hubs are counted beside those aboard, and those that stay as idle', () => {
  const request = { fleet: [
    { id: 'van', drones: large }, { id: 'quad', flies: true, count: 3 },
    { id: 'hexa', flies: true, count: 1 }] };
  const served = (ids) => [...ids].map((id) => ({ kind: 'customer', id }));
  const routes = [
    { type: 'van', trips: [{ sorties: [{ drone: 'van-1/drone-1', customers: served('A') }] }] },
    { type: 'quad', trips: [{ stops: [{ kind: 'depot' }, ...served('BC')], sorties: [] }] },
    { type: 'hexa', trips: [{ stops: served('D'), sorties: [] }] },
  ];
  const entry = { request, plan: { routes } };
  assert.deepEqual(flownIn(entry), { drones: 3, customers: 4, ofHubs: 2, present: 5 });
  assert.deepEqual(idleAtHubs(entry), [{ type: 'quad', count: 2, all: 3 }]);
});

test('forms have the fields that trucks, or vehicles that fly, can have, and what is stated', () => {
  assert.ok(needlessFields({}).includes('max_range'));
  assert.ok(!needlessFields({}).includes('drones'));
  const flying = needlessFields({ flies: true, truck_waits: true });
  assert.ok(flying.includes('drones'));
  assert.ok(!flying.includes('max_range') && !flying.includes('truck_waits'));
});
