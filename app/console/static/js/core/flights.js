/** The lines that flights of a plan take. */

import { Airspace } from './detour.js';
import { dronesOfSortie } from './drones.js';
import { planeOf } from './geometry.js';

const DEFAULT_DRONE_SPEED_KMH = 60;

/**
 * Return a function that gives a sortie's legs as they are flown, each a list of coordinates as in
 * the request: those of the reply if it has them. Sorties with a place that has no location have
 * no legs.
 */
export function flownLines(request) {
  const { legsOf } = flying(request);
  return legsOf;
}

/** Return what tells the lines of types that fly by themselves, as `(type, from, to)` are flown. */
export function linesByAir(request) {
  const { plane, airspaceAt } = flying(request);
  return ({ speed_kmh: speed }, from, to) =>
    airspaceAt(speed).flight(plane.toPlane(from), plane.toPlane(to)).map(plane.fromPlane);
}

/** Return what tells how a request's drones fly. */
function flying(request) {
  const plane = planeOf(request);
  const rings = (request.airspace?.no_fly ?? []).map((ring) => ring.map(plane.toPlane));
  const airspaces = new Map();
  const airspaceAt = (stated) => {
    const speed = stated ?? DEFAULT_DRONE_SPEED_KMH;
    if (!airspaces.has(speed)) {
      airspaces.set(speed, new Airspace(rings, request.airspace?.wind, speed));
    }
    return airspaces.get(speed);
  };
  const airspaceOf = ({ trip, reply }) =>
    airspaceAt(dronesOfSortie(trip.vehicle.type, reply)?.speed_kmh);
  const flown = (sortie, from, to) =>
    airspaceOf(sortie).flight(plane.toPlane(from), plane.toPlane(to)).map(plane.fromPlane);
  const legsOf = (sortie) => {
    const places = [sortie.from, ...sortie.visits, sortie.to].map((halt) => halt.location);
    if (places.includes(null)) return [];
    return places
      .slice(1)
      .map((to, index) => sortie.lines?.[index] ?? flown(sortie, places[index], to));
  };
  return { plane, airspaceAt, legsOf };
}
