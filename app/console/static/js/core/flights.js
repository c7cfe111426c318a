/** The lines that flights of a plan take on the map. */

import { Airspace } from './detour.js';
import { arc, planeOf } from './geometry.js';

const DEFAULT_DRONE_SPEED_KMH = 60;

/**
 * Return a function that gives a sortie's legs, each a list of coordinates as in the request.
 *
 * A clear flight is straight and drawn as an arc, so that out and back are told apart; one around
 * no-fly areas is drawn as it is flown. Sorties with a place that has no location have no legs.
 */
export function flightLines(request) {
  const plane = planeOf(request);
  const rings = (request.airspace?.no_fly ?? []).map((ring) => ring.map(plane.toPlane));
  const airspaces = new Map();
  const airspaceOf = (type) => {
    const speed = type?.drones?.speed_kmh ?? DEFAULT_DRONE_SPEED_KMH;
    if (!airspaces.has(speed)) {
      airspaces.set(speed, new Airspace(rings, request.airspace?.wind, speed));
    }
    return airspaces.get(speed);
  };
  return (sortie) => {
    const places = [sortie.from, ...sortie.visits, sortie.to].map((halt) => halt.location);
    if (places.includes(null)) return [];
    const points = places.map(plane.toPlane);
    const airspace = airspaceOf(sortie.trip.vehicle.type);
    return points
      .slice(1)
      .map((point, index) => flightLine(airspace, points[index], point).map(plane.fromPlane));
  };
}

function flightLine(airspace, from, to) {
  const flown = airspace.flight(from, to);
  if (flown.length > 2) return flown;
  const drawn = arc(from, to);
  const crosses = drawn.some(
    (point, index) => index > 0 && airspace.blocks(drawn[index - 1], point),
  );
  return crosses ? flown : drawn;
}
