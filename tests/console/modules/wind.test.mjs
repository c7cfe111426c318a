import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  addHour, changeKind, forecastOf, kindOfWind, removeHour, staysDown, windHours, withWind,
} from '../../../app/console/static/js/core/wind.js';

const FORECAST = {
  latitude: 52.5,
  utc_offset_seconds: 3600,
  hourly_units: { time: 'iso8601', wind_speed_10m: 'm/s', wind_gusts_10m: 'km/h' },
  hourly: {
    time: ['2026-11-27T07:00', '2026-11-27T08:00', '2026-11-27T09:00'],
    wind_speed_10m: [2, 5, 10],
    wind_direction_10m: [270, 280, 290],
    wind_gusts_10m: [12, null, 61.5],
    temperature_2m: [1, 2, 3],
  },
};
const DAY = { plan_start: '2026-11-27T08:00:00+01:00', time_zone: 'Europe/Berlin' };

test('a forecast is told from other files, and what the service reads of it is kept', () => {
  const { open_meteo: kept } = forecastOf(FORECAST);
  assert.deepEqual(Object.keys(kept.hourly), [
    'time', 'wind_speed_10m', 'wind_direction_10m', 'wind_gusts_10m']);
  assert.deepEqual(kept.hourly_units, { wind_speed_10m: 'm/s', wind_gusts_10m: 'km/h' });
  assert.equal(kept.utc_offset_seconds, 3600);
  for (const other of [null, {}, { hourly: { time: [] } }, { depots: [] }]) {
    assert.equal(forecastOf(other), null);
  }
});

test('hours of a forecast are told in km/h, since plan start', () => {
  const request = withWind(DAY, forecastOf(FORECAST));
  assert.equal(kindOfWind(request), 'forecast');
  const hours = [
    { from: -3600, speed_kmh: 7.2, direction_deg: 270, gust_kmh: 12 },
    { from: 0, speed_kmh: 18, direction_deg: 280, gust_kmh: null },
    { from: 3600, speed_kmh: 36, direction_deg: 290, gust_kmh: 61.5 },
  ];
  assert.deepEqual(windHours(request), hours);
  const unix = [1795759200, 1795762800, 1795766400];
  const same = { ...FORECAST, hourly: { ...FORECAST.hourly, time: unix } };
  assert.equal(new Date(unix[1] * 1000).toISOString(), '2026-11-27T07:00:00.000Z');
  assert.deepEqual(windHours(withWind(DAY, forecastOf(same))), hours);
  // What has begun before the plan doesn't matter, but for what holds as it begins.
  assert.deepEqual(changeKind(request, 'hourly').airspace.wind, hours.slice(1));
  assert.deepEqual(windHours(withWind({}, forecastOf(FORECAST)))[0].from, null);
});

test('a wind is stated in another way and back, and gets hours more and fewer', () => {
  const steady = { airspace: { wind: { speed_kmh: 20, direction_deg: 90 } } };
  const hourly = changeKind(steady, 'hourly');
  assert.deepEqual(hourly.airspace.wind, [{ from: 0, speed_kmh: 20, direction_deg: 90 }]);
  assert.equal(kindOfWind(hourly), 'hourly');
  const two = addHour(hourly);
  assert.deepEqual(two.airspace.wind.map(({ from }) => from), [0, 3600]);
  assert.deepEqual(removeHour(two, 1), hourly);
  assert.deepEqual(removeHour(hourly, 0), hourly);
  assert.deepEqual(changeKind(two, 'steady'), steady);
  assert.deepEqual(changeKind({}, 'hourly').airspace.wind, [
    { from: 0, speed_kmh: 0, direction_deg: 0 }]);
});

test('drones stay down in wind or gusts above their limit', () => {
  const fleet = [
    { id: 'van', drones: { count: 1, max_wind_kmh: 30 } },
    { id: 'quad', flies: true, max_wind_kmh: 45 },
    { id: 'truck', drones: { count: 1 } },
  ];
  const down = (speed, gust) => staysDown({ fleet }, { speed_kmh: speed, gust_kmh: gust });
  assert.deepEqual(down(20, 50), ['van', 'quad']);
  assert.deepEqual(down(30, 20), []);
  assert.deepEqual(down(40, 30), ['van']);
  assert.deepEqual(down(31, null), ['van']);
});
