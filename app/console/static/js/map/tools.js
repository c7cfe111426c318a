/** Drawing on the map: customers, depots, windows and no-fly areas. */

import { edit, select } from '../actions.js';
import { placeSelected } from '../addressing.js';
import {
  addCustomer, addDepot, addSite, customersWithin, eraseAreasAt, giveWindows, removeSite, rounded,
  setArea,
} from '../core/changes.js';
import { placeText } from '../core/orders.js';
import { askFit, askFitAt } from '../hands.js';
import { choicesOf, setPinned } from '../core/replanning.js';
import { drawing } from '../libraries.js';
import { cancelOrders, noteOrder } from '../ordering.js';
import { store } from '../store.js';
import { pressPlace, pressSite } from './place-drag.js';

/** What can be drawn, in the order of the buttons. */
export const TOOLS = [
  'customer', 'depot', 'site', 'window', 'windowArea', 'area', 'fit', 'change', 'place', 'order',
  'pin', 'erase'];

/** Tools for which it doesn't matter what is on the map already. */
const ON_GROUND = new Set(['customer', 'depot', 'site', 'windowArea', 'area', 'place', 'order']);

const isCustomer = (key) => key?.startsWith('c:');
const idOf = (key) => key.slice(2);

/** Give customers the window that is chosen. */
function paint(request, ids) {
  const { earliest, latest } = store.get().brush;
  return giveWindows(request, ids, [{ earliest, latest }]);
}

/** Let a map follow the chosen tool; returns a function that ends it. */
export function attachTools(view) {
  let end = () => {};
  let active = null;
  const unfollow = store.subscribe(({ tool }) => {
    if (tool === active) return;
    end();
    active = tool;
    end = start(view, tool);
  });
  return () => {
    unfollow();
    end();
  };
}

/** Take up a tool; returns a function that puts it down. */
function start(view, tool) {
  const former = { onSelect: view.onSelect, onGround: view.onGround, onPress: view.onPress };
  view.map.getContainer().classList.toggle('drawing', Boolean(tool));
  const end = tool ? BEGIN[tool](view) : () => {};
  // Whoever draws on the ground may click where somebody's mark, or a line, is.
  view.letThrough(ON_GROUND.has(tool));
  return () => {
    end?.();
    view.letThrough(false);
    Object.assign(view, former);
  };
}

const BEGIN = {
  customer(view) {
    view.onGround = (point) =>
      edit((request) => addCustomer(request, point, store.get().brush));
  },
  depot(view) {
    view.onGround = (point) => edit((request) => addDepot(request, point));
  },
  site(view) {
    view.onGround = (point) => edit((request) => addSite(request, point));
  },
  window(view) {
    view.onSelect = (key) => isCustomer(key) && edit((request) => paint(request, [idOf(key)]));
  },
  windowArea: (view) =>
    drawShape(view, 'Rectangle', (layer) => {
      const bounds = layer.getBounds();
      /** @type {Bounds} */
      const box = [bounds.getWest(), bounds.getSouth(), bounds.getEast(), bounds.getNorth()];
      edit((request) => paint(request, customersWithin(request, box)));
    }),
  area: (view) =>
    drawShape(view, 'Polygon', (layer) => edit((request) => setArea(request, ringOf(layer)))),
  fit(view) {
    view.onGround = askFitAt;
    view.onSelect = (key, point) => (isCustomer(key) ? askFit({ id: idOf(key) }) : askFitAt(point));
  },
  change(view) {
    view.onGround = () => {}; // The click that ends a drag selects nothing else.
    view.onPress = (key, event) => isCustomer(key) && pressPlace(view, idOf(key), event);
    const ends = [changeAreas(view), changeSites(view)];
    return () => ends.forEach((end) => end());
  },
  place(view) {
    view.onGround = (point) => {
      placeSelected(rounded(store.get().request, point));
    };
  },
  order(view) {
    view.onGround = (point) => {
      const { request } = store.get();
      noteOrder({ place: placeText(request, rounded(request, point)) });
      store.set({ tool: null });
      requestAnimationFrame(() => document.getElementById('order-amount')?.focus());
    };
  },
  pin(view) {
    view.onSelect = (key) => {
      select(key);
      if (isCustomer(key)) edit((request) => togglePin(request, idOf(key)));
    };
  },
  erase(view) {
    view.onSelect = (key, point) =>
      isCustomer(key)
        ? cancelOrders([idOf(key)])
        : view.onGround(point);
    view.onGround = (point) => {
      const site = siteAt(view, point);
      edit((request) => (site ? removeSite(request, site.id) : eraseAreasAt(request, point)));
    };
  },
};

function togglePin(request, id) {
  if (!request.replan || !choicesOf(request, id).mayPin) return request;
  return setPinned(request, [id], !(request.replan.pinned ?? []).includes(id));
}

function ringOf(layer) {
  return layer.getLatLngs()[0].map(({ lng, lat }) => [lng, lat]);
}

/** Load what drawing needs; maps and shapes made before get it too. */
async function prepareDrawing(view) {
  const library = await drawing();
  view.map.pm ??= new library.Map(view.map);
  return library;
}

/** Draw shapes one after another; returns a function that ends it. */
function drawShape(view, shape, onShape) {
  let ended = false;
  const create = ({ layer }) => {
    layer.remove();
    onShape(layer);
  };
  view.onGround = () => {};
  view.map.on('pm:create', create);
  prepareDrawing(view).then(() => {
    if (ended) return;
    view.map.pm.enableDraw(shape, { continueDrawing: true, snappable: false, tooltips: false });
  });
  return () => {
    ended = true;
    view.map.off('pm:create', create);
    view.map.pm?.disableDraw();
  };
}

/** Return the launch site whose mark is at a point of the ground. */
function siteAt({ map, sites }, [lng, lat]) {
  const point = map.latLngToContainerPoint({ lng, lat });
  const { left, top } = map.getContainer().getBoundingClientRect();
  return sites.find(({ mark }) => {
    const box = mark.getElement().firstElementChild.getBoundingClientRect();
    const [x, y] = [point.x + left, point.y + top];
    return x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
  });
}

/** Let launch sites be dragged; returns a function that ends it. */
function changeSites(view) {
  const ending = new AbortController();
  const take = () =>
    view.sites.forEach((site) => {
      const element = site.mark.getElement();
      element.classList.add('movable');
      element.addEventListener('pointerdown', (event) => pressSite(view, site, event),
        { signal: ending.signal });
    });
  // Marks are drawn anew with each edit.
  view.map.on('drawn', take);
  take();
  return () => {
    ending.abort();
    view.map.off('drawn', take);
    view.sites.forEach(({ mark }) => mark.getElement().classList.remove('movable'));
  };
}

/** Let corners of no-fly areas be dragged; returns a function that ends it. */
function changeAreas(view) {
  let ended = false;
  const take = async () => {
    const library = await prepareDrawing(view);
    if (ended) return;
    view.noFly.forEach((shape, position) => {
      if (!shape.pm) library.reInitLayer(shape);
      shape.pm.enable({ allowSelfIntersection: false, snappable: false });
      shape.on('pm:markerdragend pm:vertexremoved', () =>
        edit((request) => setArea(request, ringOf(shape), position)));
    });
  };
  // Shapes are drawn anew with each edit.
  view.map.on('drawn', take);
  take();
  return () => {
    ended = true;
    view.map.off('drawn', take);
    view.noFly.forEach((shape) => shape.pm?.disable());
  };
}
