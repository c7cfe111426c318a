/** The lines that flights of a plan take: as they are flown, and as the map draws them. */

import { Airspace } from './detour.js';
import { dronesOfSortie } from './drones.js';
import { arc, planeOf } from './geometry.js';

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

/**
 * Return a function that gives a sortie's legs as they are drawn.
 *
 * A clear flight is straight and drawn as an arc, so that out and back are told apart; one around
 * no-fly areas is drawn as it is flown.
 */
export function flightLines(request) {
  const { legsOf, airspaceOf, bowOf } = flying(request);
  return (sortie) => legsOf(sortie).map((line) => bowOf(line, airspaceOf(sortie)));
}

/**
 * Return what tells the lines of vehicles that fly by themselves, `{flown, drawn}`: that of a leg
 * as `(type, from, to)` are flown, and as `(type, line)` is drawn.
 */
export function linesByAir(request) {
  const { plane, airspaceAt, bowOf } = flying(request);
  return {
    flown: ({ speed_kmh: speed }, from, to) =>
      airspaceAt(speed).flight(plane.toPlane(from), plane.toPlane(to)).map(plane.fromPlane),
    drawn: ({ speed_kmh: speed }, line) => bowOf(line, airspaceAt(speed)),
  };
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
  const bowOf = (line, airspace) => {
    if (line.length !== 2) return line;
    const bow = arc(...line.map(plane.toPlane));
    const crosses = bow.some((point, index) => index > 0 && airspace.blocks(bow[index - 1], point));
    return crosses ? line : bow.map(plane.fromPlane);
  };
  const flown = (sortie, from, to) =>
    airspaceOf(sortie).flight(plane.toPlane(from), plane.toPlane(to)).map(plane.fromPlane);
  const legsOf = (sortie) => {
    const places = [sortie.from, ...sortie.visits, sortie.to].map((halt) => halt.location);
    if (places.includes(null)) return [];
    return places
      .slice(1)
      .map((to, index) => sortie.lines?.[index] ?? flown(sortie, places[index], to));
  };
  return { plane, airspaceAt, airspaceOf, bowOf, legsOf };
}
