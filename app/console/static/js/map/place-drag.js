/** A customer's own place is changed by dragging. */

import { edit, select } from '../actions.js';
import { moveCustomer, moveSite } from '../core/changes.js';
import { leaflet } from '../libraries.js';

const L = leaflet();

/** Pixels of a drag, below which it is a click. */
export const LEAST_DRAG = 6;

/** Return what follows a drag by which a customer gets another place. */
export function placeDrag(view, id) {
  const drop = (place) => edit((request) => moveCustomer(request, id, place));
  return marksDrag(view, view.marksOf(`c:${id}`), drop);
}

/** Return what follows a drag of marks; `drop` is told where they end. */
function marksDrag(view, marks, drop) {
  const former = marks.map((mark) => mark.getLatLng());
  let last = null;
  return {
    follow(point) {
      last = view.map.containerPointToLatLng(point);
      marks.forEach((mark) => mark.setLatLng(last));
    },
    drop: () => drop([last.lng, last.lat]),
    clear: () => marks.forEach((mark, index) => mark.setLatLng(former[index])),
  };
}

/** Let a customer whose mark is pressed be dragged with the mouse. */
export function pressPlace(view, id, { originalEvent }) {
  press(view, placeDrag(view, id), originalEvent, () => select(`c:${id}`));
}

/** Let a launch site whose mark is pressed be dragged with the mouse. */
export function pressSite(view, { id, mark }, event) {
  const drop = (place) => edit((request) => moveSite(request, id, place));
  press(view, marksDrag(view, [mark], drop), event);
}

/** Let the work of a drag follow the mouse until its button is let go. */
function press(view, work, originalEvent, onDrop = () => {}) {
  const { map } = view;
  const pointOf = (event) => map.mouseEventToContainerPoint(event);
  const from = pointOf(originalEvent);
  const ending = new AbortController();
  let isDrag = false;
  const move = (event) => {
    isDrag ||= pointOf(event).distanceTo(from) > LEAST_DRAG;
    if (isDrag) work.follow(pointOf(event));
  };
  const up = (event) => {
    move(event);
    ending.abort();
    map.dragging.enable();
    work.clear();
    if (!isDrag) return;
    work.drop();
    onDrop();
  };
  map.dragging.disable();
  document.addEventListener('mousemove', move, { signal: ending.signal });
  document.addEventListener('mouseup', up, { signal: ending.signal });
  L.DomEvent.stop(originalEvent);
}
