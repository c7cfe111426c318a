/** Addresses of a problem, looked up by the service before it is planned. */

import { edit, select } from './actions.js';
import * as api from './api.js';
import { freeName } from './core/changes.js';
import { doubtedPlaces, soughtIn, withDepot, withFound, withPlace } from './core/places.js';
import { store } from './store.js';
import { t } from './texts.js';

const known = new Map(); // what was found, by address

/** Return what an address may mean: `{places, doubt}`; asked for once. */
export async function find(address) {
  if (!known.has(address)) await ask([address]);
  return known.get(address) ?? { places: [], doubt: null };
}

/**
 * Look addresses up until all are known; throws what hinders it.
 *
 * @param {string[]} addresses
 * @param {(known: number, all: number) => void} [onProgress]
 */
async function ask(addresses, onProgress = () => {}) {
  let open = [...new Set(addresses)].filter((address) => !known.has(address));
  while (open.length) {
    const reply = await api.postAddresses(open);
    reply.addresses
      .filter(({ is_known: isKnown }) => isKnown)
      .forEach((found) => known.set(found.address, found));
    const left = open.filter((address) => !known.has(address));
    if (left.length === open.length) {
      throw new api.ApiError(0, t('failed.addresses'), reply.error ?? '');
    }
    open = left;
    onProgress(addresses.length - open.length, addresses.length);
  }
}

/**
 * Put what the problem states by addresses where they are; what isn't found stays an address.
 *
 * @param onProgress called with how many are known, and how many there are
 */
export async function placeAddresses(onProgress) {
  const { request, config } = store.get();
  const sought = soughtIn(request);
  if (!sought.length || !config.finds_addresses) return;
  await ask(
    sought.map(({ address }) => address),
    onProgress);
  const { request: placed, doubts } = withFound(request, known);
  store.set((state) => {
    if (state.request !== request) return {};
    const { saved } = state;
    return {
      request: placed,
      doubts: { ...state.doubts, ...doubts },
      saved: saved?.request === request ? { ...saved, request: placed } : saved,
    };
  });
}

/** Take a place for that of a customer. */
export function putAt(id, location) {
  edit((request) => withPlace(request, id, location));
  settle(id);
}

/** Begin to place a customer by a click on the map. */
export function beginPlacing(key) {
  select(key);
  store.set({ tool: 'place' });
}

/** Put the selected customer at a place; the next one that has none follows, if any. */
export function placeSelected(location) {
  const { selection, request } = store.get();
  const id = selection?.startsWith('c:') ? selection.slice(2) : null;
  const isUnplaced = unplacedKeys(request).includes(selection);
  if (id !== null) putAt(id, location);
  const [next] = isUnplaced ? unplacedKeys(store.get().request) : [];
  if (next) select(next);
  else store.set({ tool: null });
}

function unplacedKeys(request) {
  return doubtedPlaces(request, {}).map(({ key }) => key);
}

/** Take the place of a customer for right. */
export function settle(id) {
  store.set(({ doubts: { [`c:${id}`]: settled, ...doubts } }) => ({ doubts }));
}

/** Take a place for that of the first depot. */
export function putDepotAt(location) {
  edit((request) => withDepot(request, location));
}

/** Add a customer at a place that was found. */
export function addAt(address, { location }) {
  const { request, brush } = store.get();
  const dimensions = request.fleet[0]?.capacity.length ?? 1;
  const name = address.split(',')[0].trim();
  const isFree = request.customers.every(({ id }) => id !== name);
  const customer = {
    id: isFree ? name : freeName(request.customers, name),
    location,
    demand: Array.from({ length: dimensions }, (_, at) => brush.demand[at] ?? 0),
    service_duration: brush.service_duration,
    served_by: brush.served_by,
    info: { address },
  };
  edit({ ...request, customers: [...request.customers, customer] });
  select(`c:${customer.id}`);
}

/** Remove the customers whose addresses have no place. */
export function leaveOutUnplaced() {
  edit((request) => {
    const out = new Set(
      doubtedPlaces(request, {})
        .filter(({ doubt }) => doubt === null)
        .map(({ id }) => id));
    return { ...request, customers: request.customers.filter(({ id }) => !out.has(id)) };
  });
}
