/** Changes by hand, and best places, in words. */

import { clock, timesInWords } from './format.js';

/** Return what a change does, such as `B to truck-2, after C`. */
export function moveInWords(index, id, place) {
  if (!place) return `${id} left out`;
  const vehicle = index.vehicles.find(({ name }) => name === place.vehicle);
  if (!vehicle) return `${id} to ${place.vehicle}`;
  const stops = vehicle.trips[place.trip].stops;
  const own = stops[place.stop - 1].key === `c:${id}` ? place.stop - 2 : place.stop - 1;
  return `${id} to ${place.vehicle}, after ${stops[Math.max(own, 0)].id}`;
}

/** Return who serves a customer at a place that the service found, and where in its work. */
export function placeInWords({ vehicle, by, position, service_start: start }) {
  const at = clock(start);
  if (by === 'drone') {
    const own = position.own_trip ? 'a trip of its own, ' : '';
    return [`a drone of ${vehicle}`,
      `${own}from ${position.after}, back at ${position.recovered_at}, ${at}`];
  }
  const where = position.own_trip ? 'a trip of its own' : `after ${position.after}`;
  return [vehicle, `${where}, ${at}`];
}

/** Return broken rules in words, each once; `routes` name the vehicles that break them. */
export function rulesInWords(rules, routes = []) {
  return [...new Set(rules.map(({ message, path }) => {
    const [, index] = /\.routes\[(\d+)\]/.exec(path ?? '') ?? [];
    const vehicle = routes[index]?.vehicle;
    const text = timesInWords(message);
    return vehicle ? `${vehicle}: ${sentence(text, false)}` : sentence(text);
  }))];
}

function sentence(text, isFirst = true) {
  const first = text.charAt(0);
  const end = /[.!?]$/.test(text) ? '' : '.';
  return `${isFirst ? first.toUpperCase() : first}${text.slice(1)}${end}`;
}
