/** Places of a problem: coordinates, or addresses that are still to be looked up. */

import { t } from '../texts.js';
import { getIn, setIn } from './paths.js';
import { endsOf } from './visits.js';

/**
 * Return a place's coordinates, null where it has none, or only an address.
 *
 * @param {{location?: any}} [place]
 * @returns {Point | null}
 */
export function placeOf({ location } = {}) {
  return Array.isArray(location) ? /** @type {Point} */ (location) : null;
}

/**
 * Return the address that a place has in place of coordinates, null if it has none.
 *
 * @param {{location?: any}} [place]
 * @returns {string | null}
 */
export function addressOf({ location } = {}) {
  return location?.address ?? null;
}

/** Return the places that are addresses: `{key, keys, address}`, keys those of the location. */
export function soughtIn(request) {
  const found = [];
  const add = (location, key, keys) => {
    if (location?.address) found.push({ key, keys, address: location.address });
  };
  request?.depots.forEach(({ id, location }, at) =>
    add(location, `depot ${id}`, ['depots', at, 'location']));
  request?.launch_sites?.forEach(({ id, location }, at) =>
    add(location, `launch_site ${id}`, ['launch_sites', at, 'location']));
  request?.customers.forEach(({ id, location, alternatives }, at) => {
    add(location, `c:${id}`, ['customers', at, 'location']);
    alternatives?.forEach((place, nth) =>
      add(place.location, `c:${id}/${place.id}`,
        ['customers', at, 'alternatives', nth, 'location']));
  });
  request?.shipments?.forEach((shipment, at) =>
    endsOf(shipment).forEach(({ name, keys, end }) =>
      add(end?.location, `c:${name}`, ['shipments', at, ...keys, 'location'])));
  request?.fleet.forEach(({ id, start_location: start, end }, at) => {
    add(start, `start ${id}`, ['fleet', at, 'start_location']);
    add(end?.location, `end ${id}`, ['fleet', at, 'end', 'location']);
  });
  return found;
}

/**
 * Return `{request, doubts}`: a problem with the places that were found for its addresses.
 *
 * What isn't found, or may be several places, stays an address. Doubts, by key, are of places that
 * were found and may be wrong: `{address, doubt, location}`.
 *
 * @param replies what the service found, by address
 */
export function withFound(request, replies) {
  const doubts = {};
  let found = request;
  for (const { key, keys, address } of soughtIn(request)) {
    const { places = [], doubt } = replies.get(address) ?? {};
    if (places.length !== 1 || places[0].quality === 'town') continue;
    const { location } = places[0];
    found = setIn(found, keys, location);
    if (doubt) doubts[key] = { address, doubt, location };
  }
  return { request: found, doubts };
}

/** Return doubts about customers of an imported sheet whose addresses were looked up. */
export function doubtsOfImport({ request, looked_up: lookedUp }) {
  const doubted = new Map(
    (lookedUp?.places ?? []).filter(({ doubt }) => doubt).map((place) => [place.address, place]));
  return Object.fromEntries(
    (request?.customers ?? []).flatMap(({ id, location, info }) => {
      const place = doubted.get(info?.address);
      if (!place || !isSame(place.location, location)) return [];
      return [[`c:${id}`, { address: place.address, doubt: place.doubt, location }]];
    }));
}

/**
 * Return what is doubtful about where customers are: `{id, key, address, doubt}`, the doubt null
 * where an address has no place at all.
 *
 * @param doubts by key; whoever was put elsewhere since is no longer doubted
 */
export function doubtedPlaces(request, doubts) {
  return request.customers.flatMap((customer) => {
    const { id, location } = customer;
    const key = `c:${id}`;
    const address = addressOf(customer);
    if (address) return [{ id, key, address, doubt: null }];
    const known = doubts[key];
    if (!known || !isSame(known.location, location)) return [];
    return [{ id, key, address: known.address, doubt: known.doubt }];
  });
}

/** Return a problem whose customer is at a place, as exactly as it was found. */
export function withPlace(request, id, location) {
  const at = request.customers.findIndex((customer) => customer.id === id);
  return at < 0 ? request : setIn(request, ['customers', at, 'location'], location);
}

/** Return a problem whose first depot is at a place. */
export function withDepot(request, location) {
  const first = getIn(request, ['depots', 0]);
  if (!first) return { ...request, depots: [{ id: 'depot', location }] };
  return setIn(request, ['depots', 0, 'location'], location);
}

/** Return a candidate in words. */
export function candidateInWords({ label, quality }) {
  return quality === 'house' ? label : `${label} (${t(`places.quality.${quality}`)})`;
}

function isSame(one, other) {
  return Array.isArray(one) && Array.isArray(other) && one.every((part, at) => part === other[at]);
}
