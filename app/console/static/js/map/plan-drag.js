/** Customers of the plan are dragged onto the leg of another trip, or another one of their own. */

import { indexOf, settledOf, shownPlan } from '../actions.js';
import { distanceToLine } from '../core/geometry.js';
import { isHere } from '../core/moving.js';
import { vehicleColour } from '../core/palette.js';
import { standingIn } from '../core/replanning.js';
import { leaflet } from '../libraries.js';
import { store } from '../store.js';
import { move } from '../views/stop-moves.js';
import { labelIcon, latLng, legKey, pixelsOf } from './layers.js';

const L = leaflet();
const LEAST = 6; // pixels of a drag, below which it is a click
const NEAREST = 40; // pixels to the leg that takes a stop

/** Let a map take stops elsewhere while nothing is drawn. */
export function attachPlanDrag(view) {
  view.onPress = (key, layer, event) => {
    const state = store.get();
    const entry = shownPlan(state);
    const halt = indexOf(entry)?.halts.get(key);
    if (state.tool || halt?.kind !== 'customer' || event.originalEvent.button !== 0) return;
    if (standingIn(settledOf(entry, state.request), halt) === 'settled') return;
    begin(view, indexOf(entry), halt, event);
  };
}

function begin(view, index, halt, event) {
  const { map } = view;
  // Events on a customer tell its own place, not the pointer's.
  const pointOf = ({ originalEvent }) => map.mouseEventToContainerPoint(originalEvent);
  const from = pointOf(event);
  let [target, ghost, isDrag] = [null, null, false];
  map.dragging.disable();
  const clear = () => {
    ghost?.remove();
    ghost = null;
    view.light(null);
  };
  const follow = (moved) => {
    const point = pointOf(moved);
    isDrag ||= point.distanceTo(from) > LEAST;
    if (!isDrag) return;
    clear();
    target = nearestLeg(map, index, halt, point);
    ghost = ghostOf(view, target, halt, map.containerPointToLatLng(point)).addTo(map);
    if (target) view.light(target.key);
  };
  const end = (isDone) => () => {
    map.off('mousemove', follow);
    map.off('mouseup', drop);
    document.removeEventListener('keydown', onKey);
    map.dragging.enable();
    clear();
    if (!isDrag) return;
    view.ignoreClick();
    if (isDone && target) move(index, halt.id, target.place);
  };
  // The last moves before it may not have been told.
  const drop = (event) => {
    follow(event);
    end(true)();
  };
  const cancel = end(false);
  const onKey = ({ key }) => key === 'Escape' && cancel();
  map.on('mousemove', follow);
  map.on('mouseup', drop);
  document.addEventListener('keydown', onKey);
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
