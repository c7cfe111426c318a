/** What is assumed of a part of the fleet when it is added, for a person to correct. */

import { amounts, duration } from './format.js';
import { getIn } from './paths.js';
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

/** Return one of several pickups, at a depot until its place is stated. */
function blankPickup(request) {
  const { amount, pickup } = blankShipment(request);
  return { amount, ...pickup };
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
  if (name === 'pickups') return blankPickup(request);
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
