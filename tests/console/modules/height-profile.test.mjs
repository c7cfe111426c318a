import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  flightOfSortie, flightOfTrip, heightsOf,
} from '../../../app/console/static/js/core/height-profile.js';

const REPLY = { drone: 'van-1/drone-1', launch_time: 100, recovery_time: 500 };
const VISITS = [{ id: 'A', arrival: 200, departure: 260 }];

function sortie(drones, energies = {}) {
  const type = { id: 'van', drones: { count: 1, ...drones } };
  const visits = VISITS.map((visit) => ({ ...visit, energyLeft: energies.atA ?? null }));
  const reply = { ...REPLY, ...energies.reply };
  return flightOfSortie({ reply, visits, trip: { vehicle: { type } } });
}

function told({ corners }) {
  return corners.map(({ time, height }) => [time, height]);
}

test('a drone climbs, lands at its customer, and descends to its truck', () => {
  const climb = { up_seconds: 20, down_seconds: 30 };
  const found = heightsOf(
    sortie({ altitude: 80, recovery_duration: 40, energy: { climb, lands: true } }),
  );
  assert.deepEqual(told(found), [
    [100, 0], [120, 80], [170, 80], [200, 0], [260, 0], [280, 80], [430, 80], [460, 0],
  ]);
  assert.equal(found.altitude, 80);
});

test('one that hovers stays up', () => {
  const found = heightsOf(sortie({ energy: { lands: false } }));
  assert.deepEqual(told(found), [[100, 0], [100, 100], [500, 100], [500, 0]]);
  assert.deepEqual(found.visits, VISITS);
});

test('the rule that drones name tells their altitude unless it is stated', () => {
  const rules = [{ vehicle_type: 'van', planned: { altitude: 120 } }];
  assert.equal(heightsOf(sortie({}), rules).altitude, 120);
  assert.equal(heightsOf(sortie({ altitude: 60 }), rules).altitude, 60);
  assert.equal(heightsOf(sortie({ id: 'other' }), rules).altitude, 100);
});

test('times never go back, however short the flight', () => {
  const climb = { up_seconds: 300, down_seconds: 300 };
  const times = heightsOf(sortie({ energy: { climb } })).corners.map(({ time }) => time);
  assert.deepEqual(times, [...times].sort((a, b) => a - b));
});

test('what is left is told from take-off over each customer to the landing', () => {
  const reply = { energy_wh: 60, energy_left_wh: 440 };
  assert.deepEqual(sortie({ recovery_duration: 30 }, { atA: 480, reply }).left, [
    { time: 100, wh: 500 }, { id: 'A', time: 260, wh: 480 }, { time: 470, wh: 440 },
  ]);
  assert.deepEqual(sortie({}).left, []);
});

test('a trip of a vehicle that flies is a flight from its take-off to its landing', () => {
  const stop = (id, arrival, departure, energyLeft) => ({ id, arrival, departure, energyLeft });
  const flight = flightOfTrip({
    vehicle: { type: { id: 'quad', flies: true, altitude: 60 } },
    stops: [stop('hub', 0, 90, 800), stop('A', 200, 260, 700), stop('hub', 400, 460, 650)],
  });
  assert.deepEqual(flight.left, [
    { time: 90, wh: 800 }, { id: 'A', time: 260, wh: 700 }, { time: 400, wh: 650 },
  ]);
  assert.deepEqual(told(heightsOf(flight)), [
    [90, 0], [90, 60], [200, 60], [200, 0], [260, 0], [260, 60], [400, 60], [400, 0],
  ]);
});
