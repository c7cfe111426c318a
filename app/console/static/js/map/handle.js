/**
 * The handle beside the customer who is selected. It alone moves anybody, by mouse, pen or finger:
 * whoever takes hold of it means to, and whatever else is dragged on a map pans it.
 */

import { indexOf, settledOf, shownPlan } from '../actions.js';
import { placeOf } from '../core/places.js';
import { standingIn } from '../core/replanning.js';
import { leaflet } from '../libraries.js';
import { store } from '../store.js';
import { latLng } from './layers.js';
import { placeDrag, press } from './place-drag.js';
import { stopDrag } from './plan-drag.js';
import { t } from '../texts.js';

const L = leaflet();
const ROOM = 66; // pixels that it needs beside a customer
const ARROWS = [
  'M8 1v14M1 8h14', 'M5.5 3.5 8 1l2.5 2.5', 'M5.5 12.5 8 15l2.5-2.5', 'M3.5 5.5 1 8l2.5 2.5',
  'M12.5 5.5 15 8l-2.5 2.5',
].join('');

/** Show the handle wherever somebody may be moved; returns a function that ends it. */
export function attachHandle(view) {
  let [shown, marker, isHeld] = [null, null, false];
  const hide = () => {
    marker?.remove();
    [shown, marker] = [null, null];
  };
  const follow = (state) => {
    if (isHeld) return;
    const what = movable(state);
    if (shown && what && SAME.every((name) => shown[name] === what[name])) return;
    hide();
    if (!what) return;
    shown = what;
    marker = handleAt(what).addTo(view.map);
    turnInwards(view.map, marker);
    listen(view, marker, what, (isNow) => {
      isHeld = isNow;
      if (isNow) return;
      hide();
      follow(store.get());
    });
  };
  const turn = () => marker && !isHeld && turnInwards(view.map, marker);
  follow(store.get());
  view.map.on('moveend', turn);
  const end = store.subscribe(follow);
  return () => {
    view.map.off('moveend', turn);
    end();
    hide();
  };
}

/** Put the handle on the side of its customer where the map has room for it. */
function turnInwards(map, marker) {
  const { x } = map.latLngToContainerPoint(marker.getLatLng());
  const isAtEdge = x > map.getSize().x - ROOM;
  marker.getElement().firstElementChild.classList.toggle('leftwards', isAtEdge);
}

const SAME = ['id', 'location', 'entry', 'tool'];

/** Return who may be moved, and how: `{id, location, title, drag}`; null: nobody. */
function movable({ selection, tool, request, ...state }) {
  if (!selection?.startsWith('c:') || (tool && tool !== 'change')) return null;
  const id = selection.slice(2);
  if (tool) {
    const location = placeOf(request.customers.find((customer) => customer.id === id) ?? {});
    const title = t('map.dragPlace', { id });
    return location && { id, location, tool, title, drag: (view) => placeDrag(view, id) };
  }
  const entry = shownPlan(state);
  const halt = indexOf(entry)?.halts.get(selection);
  if (halt?.kind !== 'customer' || !halt.location) return null;
  if (standingIn(settledOf(entry, request), halt) === 'settled') return null;
  const title = t('map.dragStop', { id });
  const drag = (view) => stopDrag(view, indexOf(entry), halt);
  return { id, location: halt.location, entry, tool, title, drag };
}

function handleAt({ location, title }) {
  const element = document.createElement('span');
  element.title = title;
  element.innerHTML = `<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${ARROWS}" /></svg>`;
  const icon = L.divIcon({ className: 'map-handle', html: element, iconSize: null });
  // Buttons of the panel and keys in its lists do the same.
  const options = { icon, interactive: false, keyboard: false, zIndexOffset: 1100 };
  return L.marker(latLng(location), options);
}

/** Let the handle be dragged; `hold` is told when that begins and ends. */
function listen(view, marker, { drag }, hold) {
  const element = marker.getElement().firstElementChild;
  L.DomEvent.disableClickPropagation(element);
  element.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    hold(true);
    const work = drag(view);
    press(view, {
      follow(point) {
        element.classList.add('held');
        marker.setLatLng(view.map.containerPointToLatLng(point));
        work.follow(point);
      },
      clear() {
        work.clear();
        hold(false);
      },
      drop: work.drop,
    }, event);
  });
}
