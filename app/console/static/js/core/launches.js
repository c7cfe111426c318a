/** How long launches take: before each of a trip but the first, a battery is swapped. */

import { dronesOfSortie } from './drones.js';

/** Return how long each launch of a trip takes, in seconds; `sorties` are as a plan states them. */
export function launchDurations(type, sorties) {
  const first = sorties.reduce(
    (found, sortie) => (found === null || isSooner(sortie, found) ? sortie : found),
    null);
  return sorties.map((sortie) => {
    const drones = dronesOfSortie(type, sortie);
    const usual = drones?.launch_duration ?? 0;
    return sortie === first ? usual : usual + (drones?.turnaround?.swap_duration ?? 0);
  });
}

function isSooner(one, other) {
  return (
    one.launch_stop < other.launch_stop ||
    (one.launch_stop === other.launch_stop && one.launch_time < other.launch_time));
}
