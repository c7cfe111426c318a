/** How high a drone is when, on a sortie or a trip of its own, and what its battery has left. */

import { dronesOfSortie } from './drones.js';

const DEFAULT_ALTITUDE = 100;

/**
 * Return a sortie as a flight: of which `type` of vehicle and by which `flyer`, when it takes off
 * and lands, whom it `visits`, and what is `left` in its battery: `{id, time, wh}`, first at the
 * take-off and last at the landing, both without an id. None of it is known where one isn't.
 */
export function flightOfSortie({ trip, reply, visits }) {
  const { type } = trip.vehicle;
  const flyer = dronesOfSortie(type, reply);
  const [takeOff, landing] = [
    reply.launch_time,
    reply.recovery_time - (flyer?.recovery_duration ?? 0)];
  const atEnd = reply.energy_left_wh ?? null;
  const atFirst = atEnd === null ? null : atEnd + reply.energy_wh;
  const left = leftOf({ time: takeOff, wh: atFirst }, visits, { time: landing, wh: atEnd });
  return { type, flyer, droneType: flyer?.id, takeOff, landing, visits, left };
}

/** Return a trip of a vehicle that flies by itself as a flight; see `flightOfSortie`. */
export function flightOfTrip({ vehicle: { type }, stops }) {
  const [first, last] = [stops[0], stops.at(-1)];
  const visits = stops.slice(1, -1);
  const left = leftOf(
    { time: first.departure, wh: first.energyLeft },
    visits,
    { time: last.arrival, wh: last.energyLeft });
  const [takeOff, landing] = [first.departure, last.arrival];
  return { type, flyer: type, droneType: undefined, takeOff, landing, visits, left };
}

function leftOf(first, visits, last) {
  const points = [
    first,
    ...visits.map(({ id, departure: time, energyLeft: wh }) => ({ id, time, wh })),
    last];
  return points.some(({ wh }) => wh === null) ? [] : points;
}

/**
 * Return the corners of a flight's heights, `{time, height}` each, and whom it serves when.
 *
 * It climbs and descends as its energy says, at once where that says nothing; at customers it lands
 * or hovers. Times in seconds since plan start, heights in metres above the ground.
 *
 * @param rules those of the reply, which say the altitude where drones name one
 */
export function heightsOf({ type, flyer, droneType, takeOff, landing, visits }, rules = []) {
  const named = rules.find(
    (rule) => rule.vehicle_type === type?.id && rule.drone_type === droneType);
  const altitude = flyer?.altitude ?? named?.planned.altitude ?? DEFAULT_ALTITUDE;
  const { lands = true, climb } = flyer?.energy ?? {};
  const { up_seconds: up = 0, down_seconds: down = 0 } = climb ?? {};
  const corners = [];
  const add = (time, height) =>
    corners.push({ time: Math.max(time, corners.at(-1)?.time ?? time), height });
  const rise = (time) => {
    add(time, 0);
    add(time + up, altitude);
  };
  const land = (time) => {
    add(time - down, altitude);
    add(time, 0);
  };
  rise(takeOff);
  for (const { arrival, departure } of lands ? visits : []) {
    land(arrival);
    rise(departure);
  }
  land(landing);
  const served = visits.map(({ id, arrival, departure }) => ({ id, arrival, departure }));
  return { altitude, lands, corners, visits: served };
}
