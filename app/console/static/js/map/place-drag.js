/** A customer's own place is changed by dragging. */

import { edit, select } from '../actions.js';
import { moveCustomer } from '../core/changes.js';
import { leaflet } from '../libraries.js';

const L = leaflet();

/** Pixels of a drag, below which it is a click. */
export const LEAST_DRAG = 6;

/** Return what follows a drag by which a customer gets another place. */
export function placeDrag(view, id) {
  const marks = view.marksOf(`c:${id}`);
  const former = marks.map((mark) => mark.getLatLng());
  let last = null;
  return {
    follow(point) {
      last = view.map.containerPointToLatLng(point);
      marks.forEach((mark) => mark.setLatLng(last));
    },
    drop: () => edit((request) => moveCustomer(request, id, [last.lng, last.lat])),
    clear: () => marks.forEach((mark, index) => mark.setLatLng(former[index])),
  };
}

/** Let a customer whose mark is pressed be dragged with the mouse. */
export function pressPlace(view, id, { originalEvent }) {
  const { map } = view;
  const pointOf = (event) => map.mouseEventToContainerPoint(event);
  const from = pointOf(originalEvent);
  const work = placeDrag(view, id);
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
    select(`c:${id}`);
  };
  map.dragging.disable();
  document.addEventListener('mousemove', move, { signal: ending.signal });
  document.addEventListener('mouseup', up, { signal: ending.signal });
  L.DomEvent.stop(originalEvent);
}
