/** What a customer, stop or sortie is, as pairs of a term and its value. */

import { amounts, clock, duration, km, length, money, number, percent } from './format.js';
import { lengthOf, planeOf } from './geometry.js';
import { partsOf } from './plan.js';
import { saidOf } from './said.js';
import { choiceOf } from './schema.js';
import { nameOfVehicle, titleOfVehicle } from './vehicle-labels.js';
import { isVisit, leftOutOf, visitsOf } from './visits.js';
import { windowsInWords, windowsOf } from './windows.js';
import { describeZone } from './zone-words.js';
import { zoneOf } from './zones.js';
import { t } from '../texts.js';

/** So many reasons why a customer is left out are told at once. */
const MOST_REASONS = 3;

/** What of a customer's `info` imports name, and so has words. */
const CARRIED = new Set(['address', 'order', 'phone', 'email', 'contact', 'notes']);

/** Return what a part of a customer's `info` is called. */
export function carriedInWords(name) {
  return CARRIED.has(name) ? t(`import.meaning.${name}`) : name;
}

/** Return title and facts of what a key names: `{title, facts: [[term, value]], late}`. */
export function describe(request, index, key) {
  if (!key) return null;
  if (key[0] === 's') return describeSortie(index, key);
  if (key[0] === 't') return describeTrip(index, key);
  if (key[0] === 'l') return describeLeg(request, index, key);
  if (key[0] === 'v') return describeVehicle(index, key);
  const zone = zoneOf(request, key);
  if (zone) return describeZone(zone);
  const halt = index?.halts.get(key);
  if (key[0] === 'd') return halt ? { title: titleOf(halt), facts: haltFacts(halt) } : null;
  const customer = visitsOf(request).find(({ id }) => id === key.slice(2)) ?? halt?.source;
  if (!customer) return null;
  return {
    title: customer.id,
    facts: [...customerFacts(customer), ...servedFacts(index, halt, key)],
    late: halt?.lateness > 0,
  };
}

/** What stops are for that serve no customer, or a part of a shipment. */
const NOTES = { launch_site: 'site', break: 'rest', pickup: 'pickup', delivery: 'delivery' };

/** Return what a stop is for, null where it serves a customer or is a depot. */
export function noteOf({ kind }) {
  return kind in NOTES ? t(`routes.${NOTES[kind]}`) : null;
}

function titleOf({ kind, id }) {
  return kind === 'launch_site' ? t('where.launchSite', { id }) : id;
}

function customerFacts(customer) {
  const facts = [
    [t('about.demand'), amounts(customer.demand)],
    [t('about.window'), windowsInWords(windowsOf(customer))]];
  if (customer.pickup) facts.push([t('about.pickup'), amounts(customer.pickup)]);
  if (customer.service_duration) {
    facts.push([t('about.service'), duration(customer.service_duration)]);
  }
  for (const [type, seconds] of Object.entries(customer.service_duration_by_type ?? {})) {
    facts.push([t('about.by', { type }), duration(seconds)]);
  }
  if (customer.served_by && customer.served_by !== 'either') {
    facts.push([t('about.for'), t(`servedBy.${customer.served_by}`)]);
  }
  if (customer.skills?.length) facts.push([t('about.skills'), customer.skills.join(', ')]);
  if (customer.max_time_aboard != null) {
    facts.push([
      t('about.aboard'),
      t('about.atMost', { time: duration(customer.max_time_aboard) })]);
  }
  if (customer.approach) {
    facts.push([t('field.approach'), choiceOf(customer.approach, 'approach')]);
  }
  if (customer.setup_duration) facts.push([t('about.setup'), duration(customer.setup_duration)]);
  if (customer.goods?.length) facts.push([t('about.goods'), customer.goods.join(', ')]);
  if (customer.release_time) {
    const from = clock(customer.release_time);
    facts.push([t('about.parcel'), t('format.from', { from })]);
  }
  const { allowed, forbidden } = customer.vehicles ?? {};
  if (allowed) facts.push([t('about.onlyBy'), allowed.join(', ')]);
  if (forbidden) facts.push([t('about.notBy'), forbidden.join(', ')]);
  for (const [name, price] of Object.entries(customer.vehicle_costs ?? {})) {
    facts.push([`${t('about.costsBy')} ${name}`, money(price)]);
  }
  if (customer.alternatives?.length) {
    facts.push([t('field.alternatives'), customer.alternatives.map(({ id }) => id).join(', ')]);
  }
  for (const [name, told] of Object.entries(customer.info ?? {})) {
    facts.push([carriedInWords(name), told]);
  }
  const price = customer.unassigned_cost;
  if (price !== null && price !== undefined) {
    facts.push([t('about.leftOut'), t('about.costs', { price: money(price) })]);
  }
  return facts;
}

function servedFacts(index, halt, key) {
  if (!index) return [];
  if (halt) return haltFacts(halt);
  const out = leftOutOf(index.plan).find(({ id }) => id === key.slice(2));
  return [
    [t('about.served'), out ? t('about.isOut') : t('about.notYet')],
    ...(out?.reasons ?? []).slice(0, MOST_REASONS).map((reason) => [
      t('about.notBecause', { type: reason.vehicle_type }), saidOf(reason)])];
}

/** Return what happens at a halt. */
export function haltFacts(halt) {
  const facts = [
    [t('about.servedBy'), nameOfVehicle(halt.sortie ? halt.sortie.drone : halt.vehicle.name)],
    [t('about.arrival'), clock(halt.arrival)]];
  if (!isVisit(halt)) facts[0][0] = t('about.vehicle');
  if (halt.alternative) {
    const { alternative: place, window } = halt;
    facts.push([t('about.servedAt'), window ? `${place}, ${windowsInWords([window])}` : place]);
  }
  if (halt.part) facts.push([t('about.part'), halt.part]);
  if (halt.setup > 0) facts.push([t('about.setsUp'), duration(halt.setup)]);
  if (halt.waiting > 0) {
    facts.push([
      t('about.waits'),
      t('about.waitsUntil', { time: duration(halt.waiting), until: clock(halt.serviceStart) })]);
  }
  facts.push([t('about.departure'), clock(halt.departure)]);
  if (halt.lateness > 0) facts.push([t('about.lateBy'), duration(halt.lateness)]);
  if (halt.chance) facts.push([t('about.chance'), percent(halt.chance)]);
  facts.push([halt.sortie ? t('about.payload') : t('about.load'), amounts(halt.load)]);
  if (halt.energyLeft !== null) facts.push([t('about.energyLeft'), wattHours(halt.energyLeft)]);
  return facts;
}

function describeSortie(index, key) {
  const sortie = sortieOf(index, key);
  if (!sortie) return null;
  const { reply } = sortie;
  return {
    title: t('about.flight', { drone: nameOfVehicle(sortie.drone) }),
    facts: [
      ...(reply.drone_type ? [[t('about.type'), reply.drone_type]] : []),
      [t('about.from'), sortie.from.id],
      [t('about.to'), sortie.visits.map(({ id }) => id).join(', ')],
      [t('about.backAt'), sortie.to.id],
      [t('about.takeOff'), clock(reply.launch_time)],
      [t('about.recovered'), clock(reply.recovery_time)],
      [t('about.flown'), t('about.kmIn', {
        way: km(reply.distance),
        time: duration(reply.duration),
      })]],
  };
}

/** Return the sortie that a key names, null if there is none. */
function sortieOf(index, key) {
  const [vehicle, trip, sortie] = key.slice(2).split('/').map(Number);
  return index?.vehicles[vehicle]?.trips[trip]?.sorties[sortie] ?? null;
}

function describeTrip(index, key) {
  const [vehicle, number] = key.slice(2).split('/').map(Number);
  const trip = index?.vehicles[vehicle]?.trips[number];
  if (!trip) return null;
  return {
    title: t('about.trip', { vehicle: nameOfVehicle(trip.vehicle.name), number: number + 1 }),
    facts: [
      [t('about.loaded'), `${amounts(trip.reply.load)} (${percent(trip.reply.load_rate)})`],
      [trip.vehicle.flies ? t('about.flown') : t('about.driven'), km(trip.reply.distance)],
      [t('about.takes'), duration(trip.reply.duration)],
      [t('about.stops'), String(trip.stops.filter(isVisit).length)],
      trip.vehicle.flies
        ? [t('about.energy'), wattHours(trip.reply.energy_wh)]
        : [t('about.flights'), String(trip.sorties.length)]],
  };
}

/** Return what is known of the drive that leads to a stop. */
function describeLeg(request, index, key) {
  const { trip, leg } = partsOf(index, key);
  const before = trip?.stops[leg?.stop - 1];
  if (!before) return null;
  const { flies } = trip.vehicle;
  const metres = lengthOf(leg.line.map(planeOf(request).toPlane));
  return {
    title: `${before.id} \u2192 ${leg.id}`,
    facts: [
      [flies ? t('about.flownBy') : t('about.drivenBy'), nameOfVehicle(trip.vehicle.name)],
      [flies ? t('about.flown') : drivenInWords(leg), length(metres)],
      [t('about.takes'), duration(leg.arrival - before.departure)],
      [t('about.departure'), clock(before.departure)],
      [t('about.arrival'), clock(leg.arrival)]],
  };
}

function drivenInWords({ line }) {
  return line.length > 2 ? t('about.road') : t('about.straight');
}

function wattHours(energy) {
  return energy == null ? t('about.notKnown') : t('routes.energy', { energy: number(energy, 1) });
}

function describeVehicle(index, key) {
  const vehicle = index?.vehicles[Number(key.slice(2))];
  if (!vehicle) return null;
  return {
    title: titleOfVehicle(vehicle),
    facts: [
      [t('about.type'), vehicle.route.type],
      [t('about.trips'), String(vehicle.trips.length)],
      [t('about.works'), duration(vehicle.route.working_duration)]],
  };
}
