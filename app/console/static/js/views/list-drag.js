/** Stops of the list of routes are dragged by a grip, or moved by its arrow keys. */

import { isHere, placeAt, placeBeside } from '../core/moving.js';
import { html } from '../libraries.js';
import { focusFirst } from './focus.js';
import { move } from './stop-moves.js';
import { t } from '../texts.js';

const EDGE = 40; // pixels from the list's edge, where it scrolls
const SCROLL = 12;
const MARKS = ['drop-before', 'drop-after', 'drop-into'];

/** Return what lets a row of the list take stops: the place before it, as an attribute. */
export function dropOn(halt) {
  if (halt.stop === null) return {};
  return { 'data-drop': `${halt.vehicle.index}/${halt.trip.index}/${halt.stop}` };
}

/** The grip of a customer's row. */
export function Grip({ index, halt }) {
  const onKeyDown = (event) => {
    const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const place = placeBeside(halt, step);
    if (place) move(index, halt.id, place).then(() => focusOn(halt.key));
  };
  return html`<button type="button" class="grip" aria-label=${t('stop.move', { id: halt.id })}
    title=${t('stop.drag')} onKeyDown=${onKeyDown}
    onPointerDown=${(event) => begin(event, index, halt)}>\u2807</button>`;
}

/** Bring the focus back to a row's grip, once it is drawn where it came. */
function focusOn(key) {
  requestAnimationFrame(() => focusFirst(`tr[data-key="${CSS.escape(key)}"] .grip`));
}

function begin(event, index, halt) {
  if (event.button !== 0) return;
  const grip = event.currentTarget;
  const list = grip.closest('.tab');
  let target = null;
  grip.setPointerCapture(event.pointerId);
  const mark = (next) => {
    target?.element.classList.remove(...MARKS);
    target = next;
    target?.element.classList.add(target.mark);
  };
  const follow = ({ clientX, clientY }) => {
    const { top, bottom } = list.getBoundingClientRect();
    if (clientY < top + EDGE) list.scrollBy(0, -SCROLL);
    if (clientY > bottom - EDGE) list.scrollBy(0, SCROLL);
    mark(targetAt(index, halt, clientX, clientY));
  };
  const end = (isDone) => () => {
    const place = target?.place;
    mark(null);
    stop.abort();
    if (isDone && place) move(index, halt.id, place);
  };
  const stop = new AbortController();
  const options = { signal: stop.signal };
  grip.addEventListener('pointermove', follow, options);
  const drop = (last) => {
    follow(last);
    end(true)();
  };
  grip.addEventListener('pointerup', drop, options);
  grip.addEventListener('pointercancel', end(false), options);
  document.addEventListener('keydown', ({ key }) => key === 'Escape' && end(false)(), options);
}

/** Return where a stop would come if it were dropped at a point: `{element, mark, place}`. */
function targetAt(index, halt, x, y) {
  const under = document.elementFromPoint(x, y);
  const row = /** @type {HTMLElement} */ (under?.closest('[data-drop]'));
  const [vehicle, trip, stop] = (row?.dataset.drop ?? '').split('/').map(Number);
  if (!row) return intoVehicle(index, halt, under?.closest('[data-drop-vehicle]'));
  const { trips, name } = index.vehicles[vehicle];
  const { top, height } = row.getBoundingClientRect();
  const { stops } = trips[trip];
  const isLast = stop === stops.length - 1 && stops[stop].kind !== 'customer';
  const isAfter = stop === 0 || (!isLast && y > top + height / 2);
  const place = { vehicle: name, trip, stop: stop + (isAfter ? 1 : 0) };
  if (isHere(halt, place)) return null;
  return { element: row, mark: isAfter ? 'drop-after' : 'drop-before', place };
}

function intoVehicle(index, halt, element) {
  if (!element) return null;
  const vehicle = index.vehicles[Number(element.dataset.dropVehicle)];
  if (vehicle === halt.vehicle) return null;
  return { element, mark: 'drop-into', place: placeAt(vehicle, halt.serviceStart, halt) };
}
