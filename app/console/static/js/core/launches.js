/** How long launches take: before each of a trip but the first, a battery is swapped. */

/** Return how long each launch of a trip takes, in seconds; `sorties` are as a plan states them. */
export function launchDurations(drones, sorties) {
  const first = sorties.reduce(
    (found, sortie) => (found === null || isSooner(sortie, found) ? sortie : found),
    null,
  );
  const usual = drones?.launch_duration ?? 0;
  const swap = drones?.turnaround?.swap_duration ?? 0;
  return sorties.map((sortie) => (sortie === first ? usual : usual + swap));
}

function isSooner(one, other) {
  return (
    one.launch_stop < other.launch_stop ||
    (one.launch_stop === other.launch_stop && one.launch_time < other.launch_time)
  );
}
