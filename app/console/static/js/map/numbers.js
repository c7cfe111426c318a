/** Numbers of stops in their order, where there is room for them, and all of whose is selected. */

import { vehicleColour } from '../core/palette.js';
import { contains, isByAir } from '../core/plan.js';
import { standingIn } from '../core/replanning.js';
import { isVisit } from '../core/visits.js';
import { leaflet } from '../libraries.js';
import { labelIcon, latLng } from './layers.js';

const L = leaflet();
const ROOM = 22; // pixels from a stop to the next
const MOST = 250; // stops that are seen

/**
 * Return the numbers of a view's stops as marks.
 *
 * @param {any} view
 * @param {string | null} outer key of whose they are to be; null: of all who have room
 */
export function stopNumbers(view, outer) {
  const { map, index, entries, parts, dark } = view;
  if (!index) return [];
  const roomy = outer ? null : withRoom(map, entries);
  const trips = index.vehicles.flatMap(({ trips: some }) => some);
  return trips.flatMap((trip) => trip.stops.flatMap((halt, number) => {
    const isShown = outer ? contains(index, outer, trip.key) : roomy.has(halt.key);
    if (!isShown || !isVisit(halt) || !halt.location) return [];
    const kind = [standingIn(parts, halt), isByAir(halt) && 'air', halt.lateness > 0 && 'late'];
    const icon = labelIcon(`stop-mark ${kind.filter(Boolean).join(' ')}`, String(number));
    icon.options.html.style.setProperty('--hue', vehicleColour(trip.vehicle.number, dark));
    return L.marker(latLng(halt.location), {
      icon, interactive: false, keyboard: false, zIndexOffset: 150, key: trip.key });
  }));
}

/** Return the keys of customers that are seen and so far from all others that a number fits. */
function withRoom(map, entries) {
  const bounds = map.getBounds();
  const seen = entries.filter(({ layer, key }) =>
    key[0] === 'c' && bounds.contains(layer.getLatLng()));
  if (seen.length > MOST) return new Set();
  const points = seen.map(({ layer }) => map.latLngToLayerPoint(layer.getLatLng()));
  const isAlone = (point) => points.filter((other) => other.distanceTo(point) < ROOM).length === 1;
  return new Set(seen.filter((_, at) => isAlone(points[at])).map(({ key }) => key));
}
