import assert from 'node:assert/strict';
import test from 'node:test';
import {
  readSheet,
  recogniseColumns,
  requestWithSheet,
} from '../../../app/console/static/js/core/table.js';

const REQUEST = {
  depots: [{ id: 'hub', location: [0, 0] }],
  customers: [],
  fleet: [{ id: 'van', count: 1, capacity: [10], depot: 'hub' }],
};

test('columns are recognised by the names that people give them', () => {
  assert.deepEqual(
    recogniseColumns(['Customer', 'Lat', 'Lng', 'Qty', 'Service (s)', 'Opens', 'TW end', 'x?']),
    ['id', 'latitude', 'longitude', 'demand', 'service_duration', 'earliest', 'latest', null],
  );
});

test('a line becomes a customer', () => {
  const { customers, errors } = readSheet([
    ['id', 'x', 'y', 'demand', 'service_min', 'from', 'until', 'served_by', 'skills', 'Prize', 'Vehicles'],
    ['A', '1.5', '2', '3', '5', '8:00', '36000', 'Drone', 'cooled; heavy', '12.5', 'van-1; truck'],
  ]);
  assert.deepEqual(errors, []);
  assert.deepEqual(customers, [
    {
      id: 'A',
      location: [1.5, 2],
      demand: [3],
      service_duration: 300,
      time_window: { earliest: 28800, latest: 36000 },
      served_by: 'drone',
      skills: ['cooled', 'heavy'],
      unassigned_cost: 12.5,
      vehicles: { allowed: ['van-1', 'truck'] },
    },
  ]);
});

test('times that Excel holds as shares of a day or as dates are read', () => {
  const { customers, errors } = readSheet([
    ['id', 'x', 'y', 'from', 'until'],
    ['A', 1, 2, 1 / 3, new Date(Date.UTC(1899, 11, 30, 10, 30))],
  ]);
  assert.deepEqual(errors, []);
  assert.deepEqual(customers[0].time_window, { earliest: 28800, latest: 37800 });
});

test('several windows stand in one cell', () => {
  const { customers, errors } = readSheet([
    ['id', 'x', 'y', 'Windows', 'early cost', 'late cost'],
    ['A', 1, 2, '8:00-9:30; 14:00 to 50400', '2', '5'],
    ['B', 1, 2, '8:00', '', ''],
  ]);
  assert.deepEqual(
    errors.map(({ row, column }) => [row, column]),
    [[2, 3]],
  );
  assert.deepEqual(customers[0].time_windows, [
    { earliest: 28800, latest: 34200, early_cost_per_hour: 2 },
    { earliest: 50400, latest: 50400, early_cost_per_hour: 2, late_cost_per_hour: 5 },
  ]);
});

test('every wrong cell is told, with its place', () => {
  const { errors } = readSheet([
    ['id', 'lat', 'lon', 'demand', 'by'],
    ['A', '91', '8', '1', 'truck'],
    ['A', '47', '', 'much', 'bike'],
  ]);
  assert.deepEqual(
    errors.map(({ row, column }) => [row, column]),
    [
      [1, 1],
      [2, 2],
      [2, 3],
      [2, 4],
      [2, 0],
    ],
  );
});

test('a sheet without locations is refused', () => {
  assert.equal(
    readSheet([
      ['id', 'demand'],
      ['A', '1'],
    ]).errors[0].column,
    null,
  );
});

test('depots of a sheet are used, or one is put in the middle of the customers', () => {
  const rows = [
    ['kind', 'id', 'lon', 'lat'],
    ['depot', 'D', '8', '47'],
    ['', 'A', '8.2', '47.2'],
  ];
  assert.deepEqual(requestWithSheet(REQUEST, readSheet(rows)).depots, [
    { id: 'D', location: [8, 47] },
  ]);
  const request = requestWithSheet(
    REQUEST,
    readSheet([rows[0], rows[2], ['', 'B', '8.4', '47.4']]),
  );
  assert.deepEqual(request.depots, [{ id: 'depot', location: [8.3, 47.3] }]);
  assert.equal(request.coordinate_system, 'geographic');
  assert.equal(request.fleet[0].depot, null);
});

test('capacities get as many dimensions as the demands', () => {
  const sheet = readSheet([
    ['id', 'x', 'y', 'kg', 'volume'],
    ['A', '1', '2', '3', '4'],
  ]);
  assert.deepEqual(requestWithSheet(REQUEST, sheet).fleet[0].capacity, [10, 10]);
});
