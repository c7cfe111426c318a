/**
 * Colours of vehicles and line patterns of trips.
 *
 * The colours follow those of Okabe and Ito and of Tol, which colour-blind people tell apart:
 * darker on light ground, so that white text on them is read, and lighter on dark ground. Whatever
 * they show is also told by a label or a pattern.
 */

const ON_LIGHT = [
  '#0072b2', '#c24f00', '#00805e', '#b0508a', '#8a6a00', '#7b3fb5', '#882255', '#6b6b1a', '#44358f',
  '#1f7a6f'];
const ON_DARK = [
  '#56b4e9', '#ff8a3d', '#35c99b', '#e79bc6', '#e6b422', '#b98cff', '#e0719f', '#c2c24a', '#9fb4ff',
  '#5fd3c4'];
const TRIP_DASHES = [null, '9 5', '2 5', '14 4 2 4'];

/** Return the colour of a vehicle, counted from 0. */
export function vehicleColour(vehicle, dark) {
  const colours = dark ? ON_DARK : ON_LIGHT;
  return colours[vehicle % colours.length];
}

/** Return how a trip's line is dashed, null for a solid line. */
export function tripDash(trip) {
  return TRIP_DASHES[trip % TRIP_DASHES.length];
}

/** Return the colour of a share from 0 to 1 on a scale from low (light) to high (dark blue). */
export function heatColour(share) {
  const stops = [
    [254, 249, 217], [199, 228, 195], [111, 188, 190], [44, 127, 184], [30, 60, 120]];
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const low = Math.min(Math.floor(place), stops.length - 2);
  const mixed = stops[low].map((value, channel) =>
    Math.round(value + (stops[low + 1][channel] - value) * (place - low)));
  return { background: `rgb(${mixed.join(',')})`, text: share > 0.55 ? '#ffffff' : '#14202b' };
}
