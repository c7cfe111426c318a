/** The drones of a vehicle type: one type of them, or a list of types. */

/** Return the types of drones of a vehicle type, of which there is at least one drone. */
export function droneTypes(type) {
  const stated = type?.drones ?? [];
  return (Array.isArray(stated) ? stated : [stated]).filter(({ count }) => count > 0);
}

/** Return how many drones a vehicle of a type carries. */
export function droneCount(type) {
  return droneTypes(type).reduce((sum, { count }) => sum + count, 0);
}

/** Return the drones one of which flies a sortie of a plan, null where there are none. */
export function dronesOfSortie(type, { drone }) {
  const carried = droneTypes(type);
  let number = Number(drone.slice(drone.lastIndexOf('-') + 1));
  for (const drones of carried) {
    if (number <= drones.count) return drones;
    number -= drones.count;
  }
  return carried.at(-1) ?? null;
}

/** Fields of a vehicle type that only trucks have, and that only those have that fly. */
const OF_TRUCKS = [
  'drones', 'speed_profile', 'start_location', 'start_location_index', 'end', 'max_sorties',
  'max_airborne', 'truck_waits', 'revisits', 'avoid'];
const OF_FLYING = [
  'altitude', 'endurance', 'max_range', 'max_wind_kmh', 'preset', 'launch_duration',
  'recovery_duration', 'energy', 'turnaround'];

/** Return the fields that a vehicle type can't have; one that is stated stays, to be taken out. */
export function needlessFields(type) {
  return (type.flies ? OF_TRUCKS : OF_FLYING).filter((name) => type[name] == null);
}

/** Return how often a plan flies: its sorties, and trips of vehicles that fly by themselves. */
export function flightCount({ request, plan }) {
  const flying = new Set(request.fleet.filter(({ flies }) => flies).map(({ id }) => id));
  const own = plan.routes.filter(({ type }) => flying.has(type));
  return own.reduce((sum, { trips }) => sum + trips.length, plan.summary.sorties);
}
