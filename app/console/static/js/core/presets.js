/** What is assumed of a part of the fleet when it is added, for a person to correct. */

import { amounts, duration } from './format.js';
import { getIn, removeIn, setIn } from './paths.js';
import { placeOf } from './places.js';
import { t } from '../texts.js';

/** Which of the orders a drone is assumed to carry: the lightest quarter, per dimension. */
const SHARE = 0.25;

/** Return the drones that a vehicle type gets when they are switched on. */
export function assumedDrones({ customers = [], fleet = [] }) {
  const dimensions = customers[0]?.demand?.length ?? fleet[0]?.capacity?.length ?? 1;
  const capacity = Array.from({ length: dimensions }, (_, dimension) => {
    const orders = customers
      .map(({ demand }) => demand?.[dimension] ?? 0)
      .filter((amount) => amount > 0)
      .sort((first, second) => first - second);
    return orders[Math.floor((orders.length - 1) * SHARE)] ?? 1;
  });
  return { count: 1, capacity, endurance: 1800, launch_duration: 60, recovery_duration: 60 };
}

/** Return a shipment that is picked up and delivered at a depot, until places are stated. */
function blankShipment({ depots = [], fleet = [] }) {
  const location = placeOf(depots[0]) ?? [0, 0];
  const amount = Array(fleet[0]?.capacity?.length ?? 1).fill(1);
  return { amount, pickup: { location }, delivery: { location } };
}

/** Return one of several pickups: the only one so far, else one at a depot. */
function blankPickup(request, keys) {
  const blank = blankShipment(request);
  const shipment = getIn(request, keys.slice(0, -1)) ?? {};
  return { amount: shipment.amount ?? blank.amount, ...shipment.pickup ?? blank.pickup };
}

/** Return the problem with an entry more in a list; the first pickup is instead of the only one. */
export function withEntry(request, keys, entry) {
  const added = setIn(request, keys, [...(getIn(request, keys) ?? []), entry]);
  if (keys[keys.length - 1] !== 'pickups') return added;
  const { amount: _, pickup: __, ...shipment } = getIn(added, keys.slice(0, -1));
  return setIn(added, keys.slice(0, -1), shipment);
}

/** Return the problem without an entry of a list; the last of several pickups is the only one. */
export function withoutEntry(request, keys, index) {
  const less = removeIn(request, [...keys, index]);
  if (keys[keys.length - 1] !== 'pickups' || getIn(less, keys).length) return less;
  const { id: _, amount, ...pickup } = getIn(request, [...keys, index]);
  const { pickups: __, ...shipment } = getIn(less, keys.slice(0, -1));
  return setIn(less, keys.slice(0, -1), { ...shipment, amount, pickup });
}

/** Return another place of a customer, at his own until it is stated. */
function blankAlternative(request, keys) {
  const location = placeOf(getIn(request, keys.slice(0, -1)) ?? {});
  return location ? { location: [...location] } : {};
}

/** What parts of a problem begin with, whatever else it says. */
const PRESETS = {
  breaks: { duration: 1800, start: { latest: 21_600 }, after_departure: true },
  driving_rules: { preset: 'eu-561' },
  balance: { measure: 'duration', cost: 1 },
};

/** Return what a field of a problem begins with when it is added, undefined for nothing known. */
export function presetOf(name, request, keys) {
  if (name in PRESETS) return PRESETS[name];
  if (name === 'alternatives') return blankAlternative(request, keys);
  if (name === 'drones') return assumedDrones(request);
  if (name === 'shipments') return blankShipment(request);
  if (name === 'pickups') return blankPickup(request, keys);
  const [depot] = request.depots ?? [];
  return name === 'launch_sites' && placeOf(depot) ? { location: placeOf(depot) } : undefined;
}

/** Return what is assumed, in words, as long as nothing of it was corrected; else an empty text. */
export function assumptionIn(name, request, value) {
  if (name !== 'drones') return '';
  const assumed = assumedDrones(request);
  if ( JSON.stringify(assumed) !== JSON.stringify(value)) return '';
  return t('form.assumed', {
    amounts: amounts(assumed.capacity),
    endurance: duration(assumed.endurance),
    handling: duration(assumed.launch_duration),
  });
}
