import assert from 'node:assert/strict';
import test from 'node:test';
import { describe } from '../../../app/console/static/js/core/describe.js';
import {
  movedCustomers,
  requestDifferences,
} from '../../../app/console/static/js/core/differences.js';
import { geoJson, gpx, stopsCsv } from '../../../app/console/static/js/core/exports.js';
import { contains, indexPlan, keysWithin, spanOf } from '../../../app/console/static/js/core/plan.js';
import { playback } from '../../../app/console/static/js/core/playback.js';
import {
  ACTIVITIES, closedOf, rowWindows, tickStep, timelineRows,
} from '../../../app/console/static/js/core/timeline.js';

const REQUEST = {
  depots: [{ id: 'hub', location: [0, 0] }],
  customers: [
    {
      id: '=A',
      location: [10, 0],
      demand: [2],
      service_duration: 10,
      time_window: { earliest: 30, latest: 90 },
    },
    { id: 'B', location: [10, 10], demand: [1] },
    { id: 'C', location: [90, 90], demand: [9] },
  ],
  fleet: [
    {
      id: 'van',
      count: 1,
      capacity: [5],
      drones: { count: 1, capacity: [1], recovery_duration: 2 },
    },
  ],
};
const stop = (kind, id, arrival, serviceStart, departure, load) => ({
  kind,
  id,
  arrival,
  service_start: serviceStart,
  departure,
  waiting: serviceStart - arrival,
  lateness: 0,
  load,
});
const PLAN = {
  routes: [
    {
      vehicle: 'van-1',
      type: 'van',
      cost: 1,
      working_duration: 100,
      working_rate: null,
      trips: [
        {
          load: [3],
          load_rate: 0.6,
          distance: 20,
          duration: 100,
          stops: [
            stop('depot', 'hub', 0, 0, 0, [3]),
            stop('customer', '=A', 20, 30, 60, [0]),
            stop('depot', 'hub', 100, 100, 100, [0]),
          ],
          sorties: [
            {
              drone: 'van-1/drone-1',
              launch_stop: 1,
              recovery_stop: 1,
              launch_time: 40,
              recovery_time: 60,
              distance: 20,
              duration: 20,
              customers: [{ id: 'B', arrival: 50, service_start: 50, departure: 50, lateness: 0 }],
            },
          ],
        },
      ],
    },
  ],
  unassigned: [{ id: 'C', reasons: [] }],
  cost: { total: 5 },
  summary: { customers: 3, served: 2, vehicles: 1, trips: 1, sorties: 1 },
};
const index = indexPlan(REQUEST, PLAN);

test('what belongs to a vehicle or a trip is told by its keys, each of which it contains', () => {
  for (const outer of ['v:0', 't:0/0']) {
    const keys = keysWithin(index, outer);
    assert.deepEqual(keys, ['t:0/0', 'c:=A', 's:0/0/0', 'c:B']);
    assert.ok(keys.every((key) => contains(index, outer, key)));
  }
  assert.deepEqual(keysWithin(index, 't:7/0'), []);
});

test('a key contains the keys of its parts', () => {
  assert.ok(contains(index, 'v:0', 'c:B'));
  assert.ok(contains(index, 't:0/0', 's:0/0/0'));
  assert.ok(contains(index, 's:0/0/0', 'c:B'));
  assert.ok(!contains(index, 's:0/0/0', 'c:=A'));
  assert.deepEqual(spanOf(index), [0, 100]);
});

test('a truck and its drone have a row each, waiting and service as bars', () => {
  const [truck, drone] = timelineRows(index);
  assert.deepEqual(
    truck.bars.map(({ kind, from, until }) => [kind, from, until]),
    [
      ['drive', 0, 20],
      ['wait', 20, 30],
      ['serve', 30, 40],
      ['handle', 40, 60],
      ['drive', 60, 100],
    ],
  );
  assert.deepEqual(
    drone.bars.map(({ kind, from, until }) => [kind, from, until]),
    [
      ['fly', 40, 50],
      ['serve', 50, 50],
      ['fly', 50, 58],
      ['handle', 58, 60],
    ],
  );
  assert.deepEqual(rowWindows(truck), [
    { key: 'c:=A', earliest: 30, latest: 90, arrival: 20, late: false },
  ]);
});

test('trucks drive and drones fly along with the clock', () => {
  const places = playback(index);
  assert.deepEqual(places(10).trucks[0].location, [5, 0]);
  assert.equal(places(10).drones.length, 0);
  assert.equal(places(50).drones[0].doing, 'flies');
  assert.deepEqual(places(50).drones[0].location, [10, 10]);
  assert.equal(places(101).trucks.length, 0);
});

test('stops become CSV that no sheet takes for a formula', () => {
  const lines = stopsCsv(index).trim().split('\r\n');
  assert.equal(lines.length, 5);
  assert.ok(lines[2].startsWith("van-1,1,1,customer,'=A,,0:00:20"));
  assert.ok(lines[3].includes('B,van-1/drone-1'));
});

test('GeoJSON has places, trips and flights, and tells a plane as such', () => {
  const { features, coordinate_system: system } = geoJson(index);
  assert.deepEqual(
    features.map(({ properties: { kind } }) => kind),
    ['depot', 'customer', 'customer', 'customer', 'trip', 'flight'],
  );
  assert.equal(system, 'planar');
});

test('files say what drivers are to know', () => {
  const info = { address: 'Mozartstr. 17', kind: '=ramp', notes: '5 < 6' };
  const [first, ...others] = REQUEST.customers;
  const request = { ...REQUEST, customers: [{ ...first, info }, ...others] };
  const told = indexPlan(request, PLAN);
  const lines = stopsCsv(told).trim().split('\r\n');
  assert.ok(lines[0].endsWith(',load,address,info_kind,notes'));
  assert.ok(lines[2].endsWith(",Mozartstr. 17,'=ramp,5 < 6"));
  assert.ok(lines[3].endsWith(',,,'));
  assert.deepEqual(geoJson(told).features[1].properties.info, info);
  assert.ok(gpx(told.vehicles[0]).includes('notes: 5 &lt; 6</desc>'));
});

test('GPX and SVG write names so that they stay names', () => {
  const vehicle = { ...index.vehicles[0], name: 'a<b&"c"' };
  assert.ok(gpx(vehicle).includes('a&lt;b&amp;&quot;c&quot;, trip 1'));
});

test('differences name what changed and who is served by another', () => {
  const changed = { ...REQUEST, fleet: [{ ...REQUEST.fleet[0], count: 2, drones: null }] };
  assert.deepEqual(
    requestDifferences(REQUEST, changed).map(({ path }) => path),
    ['fleet[van].count', 'fleet[van].drones'],
  );
  const [first, second] = [
    { request: REQUEST, plan: PLAN },
    {
      request: REQUEST,
      plan: { ...PLAN, routes: [], unassigned: ['=A', 'B', 'C'].map((id) => ({ id })) },
    },
  ];
  assert.deepEqual(movedCustomers(first, second), [
    { id: '=A', before: 'van-1', now: 'nobody' },
    { id: 'B', before: 'van-1/drone-1', now: 'nobody' },
  ]);
});

test('an open route begins at its place and is drawn to its last stop', () => {
  const request = {
    ...REQUEST,
    fleet: [{ ...REQUEST.fleet[0], start_location: [5, 5], end: 'open' }],
  };
  const trip = { ...PLAN.routes[0].trips[0], sorties: [] };
  trip.stops = [{ ...trip.stops[0], kind: 'start', id: 'van' }, trip.stops[1]];
  const plan = { ...PLAN, routes: [{ ...PLAN.routes[0], trips: [trip] }] };
  const { features } = geoJson(indexPlan(request, plan));
  const of = (kind) => features.find(({ properties }) => properties.kind === kind);
  assert.deepEqual(of('start').geometry.coordinates, [5, 5]);
  assert.deepEqual(of('trip').geometry.coordinates, [
    [5, 5],
    [10, 0],
  ]);
});

test('a vehicle that flies is drawn, told and played as what it is', () => {
  const request = { ...REQUEST, fleet: [{ id: 'van', count: 1, capacity: [5], flies: true }] };
  const trip = { ...PLAN.routes[0].trips[0], sorties: [], energy_wh: 12.34 };
  const plan = { ...PLAN, routes: [{ ...PLAN.routes[0], trips: [trip] }] };
  const flown = indexPlan(request, plan);
  const [{ label, bars }] = timelineRows(flown);
  assert.equal(label, 'van-1 (flies)');
  assert.deepEqual(
    bars.filter(({ to }) => to).map(({ kind }) => kind),
    ['fly', 'fly'],
  );
  const [, there] = flown.vehicles[0].trips[0].stops;
  assert.deepEqual(there.line, [[0, 0], [10, 0]]);
  const [{ doing, location }] = playback(flown)(10).trucks;
  assert.equal(doing, 'flies');
  assert.equal(location[1], 0, 'straight, as it is flown');
  const facts = new Map(describe(request, flown, 't:0/0').facts);
  assert.equal(facts.get('Energy'), '12.3 Wh');
  assert.ok(facts.has('Flown') && !facts.has('Driven'));
  assert.equal(new Map(describe(request, flown, 'l:0/0/1').facts).get('Flown by'), 'van-1');
  const { features } = geoJson(flown);
  assert.equal(features.find(({ properties }) => properties.kind === 'trip').properties.flies, true);
});

test('a vehicle that flies is charged before its trip, which is a bar of its own', () => {
  const request = { ...REQUEST, fleet: [{ id: 'van', count: 1, capacity: [5], flies: true }] };
  const trip = { ...PLAN.routes[0].trips[0], sorties: [], charging: [{ start: -90, end: -30 }] };
  const [{ bars }] = timelineRows(indexPlan(request, {
    ...PLAN, routes: [{ ...PLAN.routes[0], trips: [trip] }],
  }));
  assert.deepEqual([bars[0].kind, bars[0].from, bars[0].until], ['charge', -90, -30]);
  assert.ok(ACTIVITIES.includes('charge'));
});

test('a stop at a launch site is told as one, with its own window', () => {
  const request = {
    ...REQUEST,
    launch_sites: [{ id: 'pier', location: [5, 5], time_window: { latest: 80 } }],
  };
  const [first, , last] = PLAN.routes[0].trips[0].stops;
  const stops = [
    first,
    stop('launch_site', 'pier', 20, 30, 60, [0]),
    stop('launch_site', '=A', 70, 70, 70, [0]),
    last,
  ];
  const trip = { ...PLAN.routes[0].trips[0], stops };
  const plan = { ...PLAN, routes: [{ ...PLAN.routes[0], trips: [trip] }] };
  const told = indexPlan(request, plan);
  const [, pier, back] = told.vehicles[0].trips[0].stops;
  assert.deepEqual([pier.location, pier.window], [[5, 5], { latest: 80 }]);
  assert.deepEqual([back.location, back.window], [[10, 0], null]);
  assert.equal(describe(request, told, pier.key).title, 'Launch site pier');
  const { features } = geoJson(told);
  assert.ok(features.some(({ properties }) => properties.kind === 'launch_site'));
});

test('a row is dark while its vehicle does not work or its depot is closed', () => {
  const depots = [{ id: 'hub', time_window: { earliest: 100, latest: null } },
    { id: 'yard', time_window: { earliest: 0, latest: 800 } }];
  const closed = (type) => closedOf({ type }, { depots }, [0, 1000]);
  assert.deepEqual(closed({ shift: null }), [[0, 100]]);
  assert.deepEqual(closed({ depot: 'yard', shift: { earliest: 300, latest: 900 } }),
    [[0, 300], [900, 1000], [800, 1000]]);
  assert.deepEqual(closed({ depot: 'yard', shift: { earliest: 2000, latest: 3000 } }),
    [[0, 1000], [800, 1000]]);
});

test('a row is dark while all depots that its vehicle may use are closed, in between, too', () => {
  const depots = [{ id: 'hub', time_window: { earliest: 600, latest: 900 } },
    { id: 'yard', time_window: { earliest: 100, latest: 300 } },
    { id: 'other', time_window: { earliest: 0, latest: 1000 } }];
  const closed = (type) => closedOf({ type }, { depots }, [0, 1000]);
  assert.deepEqual(closed({ reload_depots: ['yard'] }), [[0, 100], [300, 600], [900, 1000]]);
  assert.deepEqual(closed({ depot: 'hub', reload_depots: ['hub', 'other'] }), []);
});

test('a time axis has a step of at least a minute, also where there is no room for it', () => {
  assert.equal(tickStep(3600, 10), 600);
  assert.equal(tickStep(30 * 86400, 10), 3 * 86400);
  for (const room of [-2, 0, 0.5]) assert.equal(tickStep(3600, room), 3600);
});
