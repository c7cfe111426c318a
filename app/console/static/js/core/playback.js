/** Where trucks and drones are at an instant. */

import { flownLegs } from './flights.js';
import { pointAlong } from './geometry.js';

/**
 * Return a function that gives everything's place at an instant.
 *
 * @param index of a plan
 */
export function playback(index) {
  const trucks = index.vehicles.map((vehicle) => ({ vehicle, spans: vehicleSpans(vehicle) }));
  const drones = index.vehicles.flatMap((vehicle) =>
    vehicle.trips.flatMap((trip) =>
      trip.sorties.map((sortie) => ({ sortie, spans: flightSpans(sortie, flownLegs(sortie)) }))));
  return (time) => ({
    trucks: trucks.flatMap(({ vehicle, spans }) => at(spans, time, { vehicle })),
    drones: drones.flatMap(({ sortie, spans }) => at(spans, time, { sortie })),
  });
}

function at(spans, time, what) {
  const span = spans.find(({ from, until }) => time >= from && time <= until);
  if (!span) return [];
  const share = span.until > span.from ? (time - span.from) / (span.until - span.from) : 1;
  return [{ ...what, doing: span.doing, location: pointAlong(span.line, share) }];
}

/** Return what a vehicle does, its idle time between trips included. */
function vehicleSpans(vehicle) {
  const stops = vehicle.trips.flatMap((trip) => trip.stops).filter((halt) => halt.location);
  return stops.flatMap((halt, position) => {
    const before = stops[position - 1];
    const standing = {
      from: halt.arrival, until: halt.departure, doing: 'stands', line: [halt.location],
    };
    if (!before) return [standing];
    const doing =
      before.kind === 'depot' && halt.kind === 'depot' && before.trip !== halt.trip
        ? 'stands'
        : (vehicle.flies && 'flies') || 'drives';
    const way = {
      from: before.departure,
      until: halt.arrival,
      doing,
      line: halt.trip === before.trip ? halt.line : [before.location, halt.location],
    };
    return [way, standing];
  });
}

function flightSpans(sortie, legs) {
  if (!legs.length) return [];
  const spans = [];
  let since = sortie.reply.launch_time;
  sortie.visits.forEach((halt, position) => {
    spans.push(
      { from: since, until: halt.arrival, doing: 'flies', line: legs[position] },
      { from: halt.arrival, until: halt.departure, doing: 'serves', line: [halt.location] });
    since = halt.departure;
  });
  spans.push({
    from: since, until: sortie.reply.recovery_time, doing: 'flies', line: legs[legs.length - 1],
  });
  return spans;
}
