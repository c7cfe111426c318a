/**
 * Changes of a plan by hand: a customer is put elsewhere, or left out.
 *
 * Each returns the decisions of a plan as `POST /check` takes them. Vehicles that changed are
 * without times, which are then made; the others are as they were. A flight that began or ended at
 * a stop that goes does so at the one before.
 */

import { isVisit, leftOutOf, visitName } from './visits.js';

/** Return where a vehicle of a type begins its first trip and ends its last, as stops of a plan. */
function endsOf(request, type) {
  const home = { kind: 'depot', id: type.depot ?? request.depots[0].id };
  const hasStart = type.start_location != null || type.start_location_index != null;
  const begin = hasStart ? { kind: 'start', id: type.id } : home;
  if (type.end === 'open') return [begin];
  return [begin, type.end && typeof type.end === 'object' ? { kind: 'end', id: type.id } : home];
}

/** Return how many places a trip has for another stop: their indices are from 1 to this. */
export function lastPlace(trip) {
  const { stops } = trip;
  return isVisit(stops[stops.length - 1]) ? stops.length : stops.length - 1;
}

/**
 * Return the plan with a customer at a place.
 *
 * @param request that the plan was made for
 * @param plan as a reply has it
 * @param id of the customer
 * @param place `{vehicle, trip, stop}`: before this stop of a truck's trip, as the plan has them;
 *   `{vehicle, type}`: with a vehicle that the plan doesn't use; null: nowhere
 */
export function withCustomerAt(request, plan, id, place) {
  const used = plan.routes.some(({ vehicle }) => vehicle === place?.vehicle);
  const added = plan.routes.map((route) => (route.vehicle === place?.vehicle
    ? bare(route, (trip, index) => (index === place.trip ? withStop(trip, place.stop, id) : trip))
    : route));
  if (place && !used) added.push(routeOf(request, place, id));
  return changed(plan, [id], added.flatMap((route) => leftOf(route, [id])), !place);
}

/**
 * Return the plan with another route in place of a vehicle's, or beside the others.
 *
 * @param names whom it serves now: a customer, or all ends of a shipment
 */
export function withRoute(plan, names, route) {
  const former = plan.routes.find(({ vehicle }) => vehicle === route.vehicle);
  const others = plan.routes
    .filter((other) => other !== former)
    .flatMap((other) => leftOf(other, names));
  const at = former ? plan.routes.indexOf(former) : others.length;
  others.splice(Math.min(at, others.length), 0, route);
  return changed(plan, names, others);
}

/** Return what is left of a route where some were, nothing if nobody else is on it. */
function leftOf(route, names) {
  if (!names.some((name) => serves(route, name))) return [route];
  const left = bare(route, (trip) => names.reduce(withoutOld, trip));
  const trips = left.trips.filter(isWorth);
  return trips.length ? [{ ...left, trips }] : [];
}

/** Return the plan with other routes, in which some are served, or one customer is left out. */
function changed(plan, names, routes, isLeftOut = false) {
  const others = plan.unassigned.filter(
    (other) => !leftOutOf({ unassigned: [other] }).some(({ id }) => names.includes(id)));
  return {
    routes: routes.map(withoutMarks),
    unassigned: [
      ...others.map(({ reasons: _, ...other }) => other),
      ...(isLeftOut ? names.map((id) => ({ id })) : [])],
  };
}

function routeOf(request, { vehicle, type }, id) {
  const [begin, ...end] = endsOf(request, request.fleet.find((other) => other.id === type));
  const stops = [begin, { kind: 'customer', id, isNew: true }, ...end];
  return { vehicle, type, trips: [{ stops, sorties: [] }] };
}

function serves(route, id) {
  return route.trips.some(
    ({ stops, sorties = [] }) =>
      stops.some((stop) => isOld(stop, id)) ||
      sorties.some(({ customers }) => customers.some((visit) => visitName(visit) === id)));
}

function isOld(stop, id) {
  return isVisit(stop) && visitName(stop) === id && !stop.isNew;
}

/** Return a route's decisions, its trips being changed; each keeps when its loading was done. */
function bare({ vehicle, type, trips }, change) {
  return {
    vehicle,
    type,
    trips: trips.map((trip, index) => change({
      stops: trip.stops.map(({ kind, id, part, alternative, arrival, isNew }, position) => ({
        kind,
        id,
        ...(part && { part }),
        ...(alternative && { alternative }),
        ...(position === 0 && arrival !== undefined && { arrival }),
        ...(isNew && { isNew }),
      })),
      sorties: (trip.sorties ?? []).map((sortie) => ({
        drone: sortie.drone,
        launch_stop: sortie.launch_stop,
        recovery_stop: sortie.recovery_stop,
        customers: sortie.customers.map(({ kind, id, part, alternative }) => ({
          ...(kind && { kind }), id, ...(part && { part }), ...(alternative && { alternative }),
        })),
      })),
    }, index)),
  };
}

function withStop({ stops, sorties }, place, id) {
  const shifted = (stop) => stop + (stop >= place ? 1 : 0);
  return {
    stops: [...stops.slice(0, place), { kind: 'customer', id, isNew: true }, ...stops.slice(place)],
    sorties: sorties.map((sortie) => ({
      ...sortie,
      launch_stop: shifted(sortie.launch_stop),
      recovery_stop: shifted(sortie.recovery_stop),
    })),
  };
}

/** Return a trip without the stop or visit of a customer; one that was just put there stays. */
function withoutOld({ stops, sorties }, id) {
  const gone = stops.findIndex((stop) => isOld(stop, id));
  const shifted = (stop) => (gone >= 0 && stop >= gone ? stop - 1 : stop);
  return {
    stops: stops.filter((_, position) => position !== gone),
    sorties: sorties
      .map((sortie) => ({
        ...sortie,
        launch_stop: shifted(sortie.launch_stop),
        recovery_stop: shifted(sortie.recovery_stop),
        customers: sortie.customers.filter((visit) => visitName(visit) !== id),
      }))
      .filter(({ customers }) => customers.length),
  };
}

function isWorth({ stops, sorties }) {
  return sorties.length > 0 || stops.some(isVisit);
}

function withoutMarks(route) {
  if (!route.trips.some(({ stops }) => stops.some(({ isNew }) => isNew))) return route;
  return {
    ...route,
    trips: route.trips.map((trip) => ({
      ...trip,
      stops: trip.stops.map(({ isNew: _, ...stop }) => stop),
    })),
  };
}

/** Return the place one earlier (-1) or later (1) in the order of a truck's stop; null: none. */
export function placeBeside(halt, step) {
  const { vehicle, trip, stop } = halt;
  if (stop === null) return null;
  const inTrip = stop + (step > 0 ? 2 : -1);
  if (inTrip >= 1 && inTrip <= lastPlace(trip.reply)) {
    return { vehicle: vehicle.name, trip: trip.index, stop: inTrip };
  }
  const other = vehicle.trips[trip.index + step];
  if (!other) return null;
  const at = step > 0 ? 1 : lastPlace(other.reply);
  return { vehicle: vehicle.name, trip: other.index, stop: at };
}

/** Tell whether a place is where a halt is already. */
export function isHere(halt, place) {
  return halt.stop !== null && halt.vehicle.name === place.vehicle
    && halt.trip.index === place.trip && (place.stop === halt.stop || place.stop === halt.stop + 1);
}

/** Return the place in a vehicle's order at an instant: before the first stop served later. */
export function placeAt(vehicle, time, moved = null) {
  for (const trip of vehicle.trips) {
    const last = lastPlace(trip.reply);
    const end = trip.stops[trip.stops.length - 1];
    if (time > end.departure && trip !== vehicle.trips[vehicle.trips.length - 1]) continue;
    const inner = trip.stops.slice(1, last);
    const next = inner.find((halt) => halt !== moved && middle(halt) > time);
    return { vehicle: vehicle.name, trip: trip.index, stop: next ? next.stop : last };
  }
  return null;
}

function middle({ serviceStart, departure }) {
  return (serviceStart + departure) / 2;
}

/** Return the vehicles that a customer may be given to: those in use, and one more of a type. */
export function vehiclesFor(request, index) {
  const used = index.vehicles.map((vehicle) => ({ name: vehicle.name, vehicle }));
  const names = new Set(used.map(({ name }) => name));
  const idle = request.fleet.flatMap(({ id, count }) => {
    const free = Array.from({ length: count }, (_, at) => `${id}-${at + 1}`)
      .find((name) => !names.has(name));
    return free ? [{ name: free, type: id }] : [];
  });
  return [...used, ...idle];
}

/** Return the plan of an entry with what was decided and how it was judged. */
export function judgedPlan(plan, decided, verdict) {
  const reasons = new Map(plan.unassigned.map((each) => [each.id, each.reasons]));
  const unassigned = decided.unassigned.map(
    (each) => ({ ...each, reasons: reasons.get(each.id) ?? [] }));
  return {
    ...plan,
    status: unassigned.length ? 'partial' : 'complete',
    cost: verdict.cost,
    summary: verdict.summary,
    routes: verdict.routes?.filter(Boolean) ?? decided.routes,
    unassigned,
  };
}
