/** Sheets of customers: which column means what, and what is wrong in which cell. */

import { parseClock, parseNumber } from './format.js';

/** Names that columns go by, in lower case with `_` between words. */
const NAMES = {
  id: ['id', 'name', 'customer', 'customer_id', 'number', 'no', 'stop', 'reference', 'ref'],
  x: ['x', 'x_coord', 'xcoord', 'easting', 'east'],
  y: ['y', 'y_coord', 'ycoord', 'northing', 'north'],
  longitude: ['longitude', 'lon', 'lng', 'long'],
  latitude: ['latitude', 'lat'],
  demand: ['demand', 'quantity', 'qty', 'amount', 'weight', 'kg', 'load', 'demand_1'],
  demand_2: ['demand_2', 'demand2', 'volume', 'litres', 'liters'],
  demand_3: ['demand_3', 'demand3', 'pallets', 'pieces'],
  service_duration: ['service_duration', 'service', 'service_time', 'service_s', 'servicetime'],
  service_minutes: ['service_minutes', 'service_min', 'service_duration_min', 'stop_minutes'],
  earliest: [
    'earliest',
    'open',
    'opens',
    'from',
    'ready',
    'ready_time',
    'tw_start',
    'window_start',
    'start',
  ],
  latest: [
    'latest',
    'close',
    'closes',
    'until',
    'to',
    'due',
    'due_date',
    'due_time',
    'tw_end',
    'window_end',
    'end',
  ],
  time_windows: ['time_windows', 'windows', 'opening_hours'],
  late_cost_per_hour: ['late_cost_per_hour', 'late_cost'],
  early_cost_per_hour: ['early_cost_per_hour', 'early_cost'],
  served_by: ['served_by', 'vehicle', 'by', 'mode'],
  skills: ['skills', 'skill', 'requires'],
  vehicles: ['vehicles', 'allowed_vehicles', 'vehicles_allowed'],
  forbidden_vehicles: ['forbidden_vehicles', 'vehicles_forbidden'],
  release_time: ['release_time', 'release', 'released'],
  unassigned_cost: ['unassigned_cost', 'cost_of_leaving_out', 'penalty', 'prize'],
  kind: ['kind', 'type'],
};

const SERVED_BY = ['truck', 'drone', 'either'];
const DAY = 86400;

/** Return the meaning of each column of a line of names, null for columns that mean nothing. */
export function recogniseColumns(names) {
  const taken = new Set();
  return names.map((name) => {
    const plain = String(name ?? '')
      .trim()
      .toLowerCase()
      .replace(/[\s.-]+/g, '_')
      .replace(/_?[([].*$/, '');
    const [meaning] = Object.entries(NAMES).find(([, others]) => others.includes(plain)) ?? [null];
    if (meaning === null || taken.has(meaning)) return null;
    taken.add(meaning);
    return meaning;
  });
}

/**
 * Return what a sheet holds: `{columns, customers, depots, geographic, errors}`.
 *
 * An error is `{row, column, message}`, the row counted from 0 with the names; column null means
 * the whole row or sheet.
 */
export function readSheet(rows, columns = recogniseColumns(rows[0])) {
  const sheet = {
    columns,
    customers: [],
    depots: [],
    errors: missingColumns(columns),
    geographic: columns.includes('longitude'),
  };
  const ids = new Set();
  rows.slice(1).forEach((cells, index) => {
    const line = readLine(cells, columns, index + 1, sheet.errors);
    const isDepot = String(line.kind ?? '').toLowerCase() === 'depot';
    const id = line.id ?? String(index + 1);
    if (ids.has(id) && !isDepot) {
      const column = columns.indexOf('id');
      sheet.errors.push({
        row: index + 1,
        column: column < 0 ? null : column,
        message: `"${id}" is there twice: give each customer a name of its own.`,
      });
    }
    ids.add(id);
    if (isDepot) sheet.depots.push({ id, location: locationOf(line) });
    else sheet.customers.push(customerOf(id, line));
  });
  return sheet;
}

function missingColumns(columns) {
  const has = (name) => columns.includes(name);
  const errors = [];
  if (!(has('x') && has('y')) && !(has('longitude') && has('latitude'))) {
    errors.push({
      row: 0,
      column: null,
      message: 'No columns with locations: name two of them x and y, or longitude and latitude.',
    });
  }
  return errors;
}

function readLine(cells, columns, row, errors) {
  const line = {};
  columns.forEach((meaning, column) => {
    const cell = cells[column];
    if (meaning === null || cell === null || cell === undefined || String(cell).trim() === '') {
      if (REQUIRED.has(meaning))
        errors.push({ row, column, message: 'This cell is empty: fill it in.' });
      return;
    }
    const { value, message } = READERS[meaning](cell);
    if (message) errors.push({ row, column, message });
    else line[meaning] = value;
  });
  return line;
}

const REQUIRED = new Set(['x', 'y', 'longitude', 'latitude']);

function numeric(least, most, what = 'number') {
  return (cell) => {
    const value = typeof cell === 'number' ? cell : parseNumber(cell);
    if (value === null) return { message: `"${cell}" is not a ${what}: state one.` };
    if (value < least || value > most) {
      return { message: `${value} is not between ${least} and ${most}: correct it.` };
    }
    return { value };
  };
}

/** Read a time of day: `8:30`, seconds, or what Excel holds as a time. */
function time(cell) {
  if (cell instanceof Date) {
    return { value: cell.getUTCHours() * 3600 + cell.getUTCMinutes() * 60 + cell.getUTCSeconds() };
  }
  // Excel writes times as shares of a day.
  const seconds =
    typeof cell === 'number' && cell > 0 && cell < 1 ? Math.round(cell * DAY) : parseClock(cell);
  return seconds === null || seconds < 0
    ? { message: `"${cell}" is not a time: state one such as 8:30, or seconds.` }
    : { value: seconds };
}

/** Read windows such as `8:00-9:30; 14:00-15:00`. */
function windows(cell) {
  const stated = String(cell)
    .split(/[;|]/)
    .filter((part) => part.trim());
  const read = stated.map((part) => part.split(/\s*(?:-|\u2013|\bto\b)\s*/).map(parseClock));
  return read.length && read.every((times) => times.length === 2 && !times.includes(null))
    ? { value: read.map(([earliest, latest]) => ({ earliest, latest })) }
    : { message: `"${cell}" are no windows: state them as 8:00-9:30; 14:00-15:00.` };
}

function names(cell) {
  const parts = String(cell).split(/[,;|]/);
  return { value: parts.map((name) => name.trim()).filter(Boolean) };
}

const text = (cell) => ({ value: String(cell).trim() });
const amount = numeric(0, 1e9);
const READERS = {
  id: text,
  x: numeric(-1e12, 1e12),
  y: numeric(-1e12, 1e12),
  longitude: numeric(-180, 180, 'longitude'),
  latitude: numeric(-90, 90, 'latitude'),
  demand: amount,
  demand_2: amount,
  demand_3: amount,
  service_duration: numeric(0, 1e9),
  service_minutes: numeric(0, 1e7),
  earliest: time,
  latest: time,
  time_windows: windows,
  late_cost_per_hour: numeric(0, 1e12),
  early_cost_per_hour: numeric(0, 1e12),
  served_by(cell) {
    const value = String(cell).trim().toLowerCase();
    return SERVED_BY.includes(value)
      ? { value }
      : { message: `"${cell}" is none of ${SERVED_BY.join(', ')}: use one of these.` };
  },
  skills: names,
  vehicles: names,
  forbidden_vehicles: names,
  release_time: time,
  unassigned_cost: numeric(0, 1e12),
  kind: text,
};

function locationOf(line) {
  return line.longitude !== undefined
    ? [line.longitude, line.latitude ?? 0]
    : [line.x ?? 0, line.y ?? 0];
}

function customerOf(id, line) {
  const demand = [line.demand ?? 1, line.demand_2, line.demand_3].filter(
    (value) => value !== undefined,
  );
  const customer = { id, location: locationOf(line), demand };
  const service = line.service_duration ?? (line.service_minutes ?? 0) * 60;
  if (service) customer.service_duration = service;
  const named = (names) =>
    Object.fromEntries(
      names.filter((name) => line[name] !== undefined).map((name) => [name, line[name]]),
    );
  const early = named(['early_cost_per_hour']);
  const late = named(['late_cost_per_hour']);
  if (line.time_windows) {
    const last = line.time_windows.length - 1;
    customer.time_windows = line.time_windows.map((window, position) => ({
      ...window,
      ...early,
      ...(position === last && late),
    }));
  } else {
    const window = { ...named(['earliest', 'latest']), ...late, ...early };
    if (Object.keys(window).length) customer.time_window = window;
  }
  for (const name of ['served_by', 'skills', 'release_time', 'unassigned_cost']) {
    if (line[name] !== undefined) customer[name] = line[name];
  }
  if (line.vehicles) customer.vehicles = { allowed: line.vehicles };
  else if (line.forbidden_vehicles) customer.vehicles = { forbidden: line.forbidden_vehicles };
  return customer;
}

/** Return a request with a sheet's customers, and its depots or one in their middle. */
export function requestWithSheet(request, sheet) {
  const system = sheet.geographic ? 'geographic' : 'planar';
  const same = (request.coordinate_system ?? 'planar') === system;
  const depots = sheet.depots.length
    ? sheet.depots
    : same
      ? request.depots
      : [{ id: 'depot', location: middleOf(sheet.customers) }];
  const known = new Set(depots.map(({ id }) => id));
  const dimensions = Math.max(1, ...sheet.customers.map(({ demand }) => demand.length));
  const customers = sheet.customers.map((customer) => ({
    ...customer,
    demand: fitted(customer.demand, dimensions, 0),
  }));
  const fleet = request.fleet.map((type) => ({
    ...type,
    capacity: fitted(type.capacity, dimensions),
    ...(type.drones && {
      drones: { ...type.drones, capacity: fitted(type.drones.capacity, dimensions) },
    }),
    depot: known.has(type.depot) ? type.depot : null,
  }));
  const { matrices, ...rest } = request;
  const airspace = same ? rest.airspace : { ...rest.airspace, no_fly: [] };
  return {
    ...rest,
    coordinate_system: system,
    depots,
    customers,
    fleet,
    ...(airspace && { airspace }),
  };
}

/** Return as many values as there are dimensions; new ones as stated, else like the last. */
function fitted(values, dimensions, other = values[values.length - 1]) {
  return Array.from({ length: dimensions }, (_, index) => values[index] ?? other);
}

function middleOf(customers) {
  const mean = (axis) =>
    customers.reduce((sum, { location }) => sum + location[axis], 0) / customers.length;
  return [0, 1].map((axis) => Number(mean(axis).toFixed(6)));
}
