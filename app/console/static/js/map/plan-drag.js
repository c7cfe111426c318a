/** Customers of the plan are dragged onto the leg of another trip, or another one of their own. */

import { distanceToLine } from '../core/geometry.js';
import { isHere } from '../core/moving.js';
import { vehicleColour } from '../core/palette.js';
import { leaflet } from '../libraries.js';
import { store } from '../store.js';
import { move } from '../views/stop-moves.js';
import { labelIcon, latLng, legKey, pixelsOf } from './layers.js';

const L = leaflet();
const NEAREST = 40; // pixels to the leg that takes a stop

/** Return what follows a drag that puts a customer of the plan onto the leg of a trip. */
export function stopDrag(view, index, halt) {
  let [target, ghost] = [null, null];
  const clear = () => {
    ghost?.remove();
    ghost = null;
    view.light(null);
  };
  return {
    clear,
    follow(point) {
      clear();
      target = nearestLeg(view.map, index, halt, point);
      ghost = ghostOf(view, target, halt, view.map.containerPointToLatLng(point)).addTo(view.map);
      if (target) view.light(target.key);
    },
    drop: () => target && move(index, halt.id, target.place),
  };
}

/** Return the leg nearest to a point of the map: `{key, place, halt}`; null: none is near. */
function nearestLeg(map, index, moved, point) {
  let [best, least] = [null, NEAREST];
  for (const { trips } of index.vehicles) {
    for (const { stops } of trips) {
      stops.slice(1).forEach((halt) => {
        const place = { vehicle: halt.vehicle.name, trip: halt.trip.index, stop: halt.stop };
        if (isHere(moved, place)) return;
        const distance = distanceToLine([point.x, point.y], pixelsOf(map, halt.line));
        if (distance < least) [best, least] = [{ halt, place, key: legKey(halt) }, distance];
      });
    }
  }
  return best;
}

/** Return the way that a trip would take by the pointer. */
function ghostOf(view, target, halt, pointer) {
  const ends = target
    ? [target.halt.trip.stops[target.place.stop - 1].location, target.halt.location]
    : [halt.location];
  const vehicle = target?.halt.vehicle ?? halt.vehicle;
  const [before, after] = ends.map(latLng);
  return L.polyline([before, pointer, ...(after ? [after] : [])], {
    color: vehicleColour(vehicle.number, view.dark),
    weight: 3,
    dashArray: '5 5',
    interactive: false,
  });
}

/** Mark for whom best places are sought, until the returned function ends it. */
export function followFit(view) {
  let [last, mark] = [null, null];
  const follow = ({ fit }) => {
    if (fit?.customer === last) return;
    last = fit?.customer ?? null;
    mark?.remove();
    mark = last?.location ? markOf(last).addTo(view.map) : null;
  };
  follow(store.get());
  const end = store.subscribe(follow);
  return () => {
    end();
    mark?.remove();
  };
}

function markOf({ id, location }) {
  return L.marker(latLng(location), {
    interactive: false, keyboard: false, zIndexOffset: 600, icon: labelIcon('fit-mark', id),
  });
}
