/** Changes by hand, and best places, in words. */

import { endsInWords } from './end-words.js';
import { clock } from './format.js';
import { saidOf } from './said.js';
import { t } from '../texts.js';
import { nameOfVehicle } from './vehicle-labels.js';

/** Return what a change does, such as `B to truck-2, after C`. */
export function moveInWords(index, id, place) {
  if (!place) return t('hand.leftOut', { id });
  const vehicle = index.vehicles.find(({ name }) => name === place.vehicle);
  const called = nameOfVehicle(place.vehicle);
  if (!vehicle) return t('hand.to', { id, vehicle: called });
  const stops = vehicle.trips[place.trip].stops;
  const own = stops[place.stop - 1].key === `c:${id}` ? place.stop - 2 : place.stop - 1;
  const { id: after } = stops[Math.max(own, 0)];
  return t('hand.after', { id, vehicle: called, after });
}

/** Return who serves a customer or shipment at a place that was found, and where in its work. */
export function placeInWords(place) {
  const { alternative, position, service_start: start, companions } = place;
  const vehicle = nameOfVehicle(place.vehicle);
  const along = (who) => (
    companions ? t('why.goingAlong', { who, names: companions.join(', ') }) : who);
  const ends = endsInWords(place);
  if (ends) return [along(vehicle), ends];
  const other = alternative ? `${t('place.at', { place: alternative })}, ` : '';
  const at = clock(start);
  if (position.recovered_at) {
    const own = position.own_trip ? `${t('place.ownTrip')}, ` : '';
    const flight = { from: position.after, back: position.recovered_at, at };
    return [along(t('place.drone', { vehicle })), other + own + t('place.flight', flight)];
  }
  const where = position.own_trip
    ? t('place.ownTrip')
    : t('place.after', { stop: position.after });
  return [along(vehicle), `${other}${where}, ${at}`];
}

/** Return broken rules in words, each once; `routes` name the vehicles that break them. */
export function rulesInWords(rules, routes = []) {
  return [...new Set(rules.map(({ code, message, path }) => {
    const [, index] = /\.routes\[(\d+)\]/.exec(path ?? '') ?? [];
    const vehicle = routes[index]?.vehicle;
    const text = saidOf({ code, message });
    return vehicle ? `${nameOfVehicle(vehicle)}: ${sentence(text, false)}` : sentence(text);
  }))];
}

function sentence(text, isFirst = true) {
  const first = text.charAt(0);
  const end = /[.!?]$/.test(text) ? '' : '.';
  return `${isFirst ? first.toUpperCase() : first}${text.slice(1)}${end}`;
}
