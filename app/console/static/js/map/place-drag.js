/** A customer's own place is changed by dragging. */

import { edit, select } from '../actions.js';
import { moveCustomer, moveSite } from '../core/changes.js';
import { leaflet } from '../libraries.js';

const L = leaflet();

const LEAST_DRAG = 6; // pixels, below which it is a click

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

/** Let a launch site whose mark is pressed be dragged with mouse, pen or finger. */
export function pressSite(view, { id, mark }, event) {
  if (event.button !== 0) return;
  const drop = (place) => edit((request) => moveSite(request, id, place));
  press(view, marksDrag(view, [mark], drop), event);
}

/** Let the work of a drag follow the pointer until it is let go; Escape gives it up. */
export function press(view, work, originalEvent, onDrop = () => {}) {
  const { map } = view;
  const pointOf = (event) => map.mouseEventToContainerPoint(event);
  const from = pointOf(originalEvent);
  const ending = new AbortController();
  let isDrag = false;
  // Presses of a mouse come without the pointer's id.
  const isOther = ({ pointerId }) => pointerId !== (originalEvent.pointerId ?? pointerId);
  const move = (event) => {
    if (isOther(event)) return;
    isDrag ||= pointOf(event).distanceTo(from) > LEAST_DRAG;
    if (isDrag) work.follow(pointOf(event));
  };
  const end = () => {
    ending.abort();
    map.dragging.enable();
    work.clear();
  };
  const up = (event) => {
    if (isOther(event)) return;
    move(event);
    end();
    if (!isDrag) return;
    work.drop();
    onDrop();
  };
  map.dragging.disable();
  const on = (name, react) => document.addEventListener(name, react, { signal: ending.signal });
  on('pointermove', move);
  on('pointerup', up);
  on('pointercancel', (event) => isOther(event) || end());
  on('keydown', ({ key }) => key === 'Escape' && end());
  L.DomEvent.stop(originalEvent);
}
