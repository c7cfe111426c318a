/** Places of a problem, and what the service says of them, in a dispatcher's words. */

import assert from 'node:assert/strict';
import test from 'node:test';

import { parsePath, pathOf } from '../../../app/console/static/js/core/paths.js';
import { plainOf, saidOf } from '../../../app/console/static/js/core/said.js';
import { whereInWords } from '../../../app/console/static/js/core/where.js';

const REQUEST = {
  customers: [{ id: 'Anna' }, { id: '' }],
  fleet: [{ id: 'van', drones: [{ id: 'small' }] }],
  depots: [{ id: 'hub' }],
  replan: {
    pinned: ['Anna'],
    unavailable: ['van-1'],
    plan: { routes: [{ vehicle: 'van-1', trips: [{ stops: [{ id: 'hub' }], sorties: [{}] }] }] },
  },
};
const where = (path) => whereInWords(REQUEST, parsePath(path));

test('a path is told by the names that people gave', () => {
  const cases = {
    '$': 'The problem',
    '$.fleet[0].profile': 'Vehicle type van › Profile',
    '$.fleet[0].drones[0].endurance': 'Vehicle type van › Drones 1 › Endurance',
    '$.customers[0].time_window.latest': 'Customer Anna › Time window › Latest',
    '$.customers[0].time_windows[1].earliest': 'Customer Anna › Window 2 › Earliest',
    '$.customers[1].location': 'Customer 2 › Location',
    '$.customers[7].demand[1]': 'Customer 8 › Demand 2',
    '$.depots[0].location': 'Depot hub › Location',
    '$.airspace.no_fly[1]': 'No-fly area 2',
    '$.options.time_limit': 'Search › Time limit',
    '$.replan.plan.routes[0].trips[0].stops[0].arrival':
      'Tour of van-1 › Trip 1 › Stop 1 hub › Arrival',
    '$.replan.plan.routes[0].trips[0].sorties[0].drone': 'Tour of van-1 › Trip 1 › Flight 1 › Drone',
    '$.replan.pinned[0]': 'Pinned Anna',
    '$.replan.unavailable[0]': 'Broken down: van-1',
    '$.replan.parcels_back': 'Parcels back',
  };
  for (const [path, words] of Object.entries(cases)) assert.equal(where(path), words, path);
});

test('no place in words has anything of the API', () => {
  for (const path of ['$.matrices.car.durations[3][4]', '$.fleet[0].costs.per_km',
    '$.roads.fallback', '$.something_new[3].else_where']) {
    assert.doesNotMatch(where(path), /[[\]_$]/, path);
  }
});

test('keys are written as the API writes them for those who ask', () => {
  assert.equal(pathOf(['fleet', 0, 'drones', 'capacity', 1]), 'fleet[0].drones.capacity[1]');
});

test('what is told in words stays, what names fields and settings is told otherwise', () => {
  const message = 'The window closes at 36000 s, before it opens.';
  assert.equal(saidOf({ code: 'WINDOW_ENDS_BEFORE_START', message }),
    'The window closes at 10:00, before it opens.');
  for (const jargon of ['State a `location`.', 'Write [x, y] in units of planar_unit.',
    'Have the service set up with TANDEM_GEOCODER.', '$.customers[3] lacks it.']) {
    assert.equal(saidOf({ code: 'MISSING_LOCATION', message: jargon }),
      'Say where this is: a place on the map, or an address.');
  }
});

test('what the API describes of a field is left to its form', () => {
  const message = 'The number must be at least 0: raise it. demand: Amount in `capacity`.';
  assert.equal(saidOf({ code: 'OUT_OF_RANGE', path: '$.customers[1].demand[0]', message }),
    'The number must be at least 0: raise it.');
});

test('settings stand in no sentence', () => {
  assert.equal(plainOf('There are 9 customers, 5 at most (TANDEM_MAX_CUSTOMERS): remove some.'),
    'There are 9 customers, 5 at most: remove some.');
});
