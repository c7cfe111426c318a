/** What a customer, stop or sortie is, as pairs of a term and its value. */

import { amounts, clock, duration, km, length, money, percent } from './format.js';
import { lengthOf, planeOf } from './geometry.js';
import { partsOf } from './plan.js';
import { windowsInWords, windowsOf } from './windows.js';

const SERVED_BY = { truck: 'truck only', drone: 'drone only', either: 'truck or drone' };

/** Return title and facts of what a key names: `{title, facts: [[term, value]], late}`. */
export function describe(request, index, key) {
  if (!key) return null;
  if (key[0] === 's') return describeSortie(index, key);
  if (key[0] === 't') return describeTrip(index, key);
  if (key[0] === 'l') return describeLeg(request, index, key);
  if (key[0] === 'v') return describeVehicle(index, key);
  const halt = index?.halts.get(key);
  if (key[0] === 'd') return halt ? { title: halt.id, facts: haltFacts(halt) } : null;
  const customer = request.customers.find(({ id }) => id === key.slice(2)) ?? halt?.source;
  if (!customer) return null;
  return {
    title: customer.id,
    facts: [...customerFacts(customer), ...servedFacts(index, halt, key)],
    late: halt?.lateness > 0,
  };
}

function customerFacts(customer) {
  const facts = [
    ['Demand', amounts(customer.demand)],
    ['Window', windowsInWords(windowsOf(customer))],
  ];
  if (customer.pickup) facts.push(['Pickup', amounts(customer.pickup)]);
  if (customer.service_duration) facts.push(['Service', duration(customer.service_duration)]);
  for (const [type, seconds] of Object.entries(customer.service_duration_by_type ?? {})) {
    facts.push([`By ${type}`, duration(seconds)]);
  }
  if (customer.served_by && customer.served_by !== 'either') {
    facts.push(['For', SERVED_BY[customer.served_by]]);
  }
  if (customer.skills?.length) facts.push(['Skills', customer.skills.join(', ')]);
  if (customer.max_time_aboard != null) {
    facts.push(['Aboard', `at most ${duration(customer.max_time_aboard)}`]);
  }
  if (customer.setup_duration) facts.push(['Setup', duration(customer.setup_duration)]);
  if (customer.goods?.length) facts.push(['Goods', customer.goods.join(', ')]);
  if (customer.release_time) facts.push(['Parcel there', `from ${clock(customer.release_time)}`]);
  const { allowed, forbidden } = customer.vehicles ?? {};
  if (allowed) facts.push(['Only by', allowed.join(', ')]);
  if (forbidden) facts.push(['Not by', forbidden.join(', ')]);
  facts.push(...Object.entries(customer.info ?? {}));
  const price = customer.unassigned_cost;
  if (price !== null && price !== undefined) facts.push(['Left out', `costs ${money(price)}`]);
  return facts;
}

function servedFacts(index, halt, key) {
  if (!index) return [];
  if (halt) return haltFacts(halt);
  const isOut = index.plan.unassigned.some(({ id }) => id === key.slice(2));
  return [['Served', isOut ? 'not: see Unassigned' : 'not planned yet']];
}

/** Return what happens at a halt. */
export function haltFacts(halt) {
  const facts = [
    ['Served by', halt.sortie ? halt.sortie.drone : halt.vehicle.name],
    ['Arrival', clock(halt.arrival, { precise: true })],
  ];
  if (halt.kind !== 'customer') facts[0][0] = 'Vehicle';
  if (halt.setup > 0) facts.push(['Sets up', duration(halt.setup)]);
  if (halt.waiting > 0) {
    facts.push([
      'Waits',
      `${duration(halt.waiting)}, until ` + clock(halt.serviceStart, { precise: true }),
    ]);
  }
  facts.push(['Departure', clock(halt.departure, { precise: true })]);
  if (halt.lateness > 0) facts.push(['Late by', duration(halt.lateness)]);
  facts.push([halt.sortie ? 'Payload' : 'Load on leaving', amounts(halt.load)]);
  return facts;
}

function describeSortie(index, key) {
  const sortie = sortieOf(index, key);
  if (!sortie) return null;
  const { reply } = sortie;
  return {
    title: `Flight of ${sortie.drone}`,
    facts: [
      ...(reply.drone_type ? [['Type', reply.drone_type]] : []),
      ['From', sortie.from.id],
      ['To', sortie.visits.map(({ id }) => id).join(', ')],
      ['Back at', sortie.to.id],
      ['Take-off', clock(reply.launch_time, { precise: true })],
      ['Recovered', clock(reply.recovery_time, { precise: true })],
      ['Flown', `${km(reply.distance)} in ${duration(reply.duration)}`],
    ],
  };
}

function sortieOf(index, key) {
  const [vehicle, trip, sortie] = key.slice(2).split('/').map(Number);
  return index?.vehicles[vehicle]?.trips[trip]?.sorties[sortie] ?? null;
}

function describeTrip(index, key) {
  const [vehicle, number] = key.slice(2).split('/').map(Number);
  const trip = index?.vehicles[vehicle]?.trips[number];
  if (!trip) return null;
  return {
    title: `${trip.vehicle.name}, trip ${number + 1}`,
    facts: [
      ['Load', `${amounts(trip.reply.load)} (${percent(trip.reply.load_rate)})`],
      ['Driven', km(trip.reply.distance)],
      ['Takes', duration(trip.reply.duration)],
      ['Stops', String(trip.stops.filter(({ kind }) => kind === 'customer').length)],
      ['Flights', String(trip.sorties.length)],
    ],
  };
}

/** Return what is known of the drive that leads to a stop. */
function describeLeg(request, index, key) {
  const { trip, leg } = partsOf(index, key);
  const before = trip?.stops[leg?.stop - 1];
  if (!before) return null;
  const metres = lengthOf(leg.line.map(planeOf(request).toPlane));
  return {
    title: `${before.id} \u2192 ${leg.id}`,
    facts: [
      ['Driven by', trip.vehicle.name],
      [leg.line.length > 2 ? 'Road' : 'Straight', length(metres)],
      ['Takes', duration(leg.arrival - before.departure)],
      ['Departure', clock(before.departure, { precise: true })],
      ['Arrival', clock(leg.arrival, { precise: true })],
    ],
  };
}

function describeVehicle(index, key) {
  const vehicle = index?.vehicles[Number(key.slice(2))];
  if (!vehicle) return null;
  return {
    title: vehicle.name,
    facts: [
      ['Type', vehicle.route.type],
      ['Trips', String(vehicle.trips.length)],
      ['Works', duration(vehicle.route.working_duration)],
    ],
  };
}
