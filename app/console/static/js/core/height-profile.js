/** How high a drone is when, on a sortie. */

import { dronesOfSortie } from './drones.js';

const DEFAULT_ALTITUDE = 100;

/**
 * Return the corners of a sortie's heights, `{time, height}` each, and whom it serves when.
 *
 * It climbs and descends as its energy says, at once where that says nothing; at customers it lands
 * or hovers. Times in seconds since plan start, heights in metres above the ground.
 *
 * @param rules those of the reply, which say the altitude where drones name one
 */
export function heightsOf(sortie, rules = []) {
  const { type } = sortie.trip.vehicle;
  const drones = dronesOfSortie(type, sortie.reply);
  const named = rules.find(
    (rule) => rule.vehicle_type === type?.id && rule.drone_type === drones?.id,
  );
  const altitude = drones?.altitude ?? named?.planned.altitude ?? DEFAULT_ALTITUDE;
  const { lands = true, climb } = drones?.energy ?? {};
  const { up_seconds: up = 0, down_seconds: down = 0 } = climb ?? {};
  const corners = [];
  const add = (time, height) =>
    corners.push({ time: Math.max(time, corners.at(-1)?.time ?? time), height });
  const takeOff = (time) => {
    add(time, 0);
    add(time + up, altitude);
  };
  const land = (time) => {
    add(time - down, altitude);
    add(time, 0);
  };
  takeOff(sortie.reply.launch_time);
  for (const { arrival, departure } of lands ? sortie.visits : []) {
    land(arrival);
    takeOff(departure);
  }
  land(sortie.reply.recovery_time - (drones?.recovery_duration ?? 0));
  const visits = sortie.visits.map(({ id, arrival, departure }) => ({ id, arrival, departure }));
  return { altitude, lands, corners, visits };
}
