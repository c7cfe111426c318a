/** One map: a problem, a plan on it, and where everything is at an instant. */

import { contains, partsOf } from '../core/plan.js';
import { boundsOf } from '../core/geometry.js';
import { vehicleColour } from '../core/palette.js';
import { placeOf } from '../core/places.js';
import { standsOf } from '../core/stands.js';
import { leaflet } from '../libraries.js';
import {
  customerMarks,
  depotMarks,
  doubtMarks,
  isCrowded,
  labelIcon,
  latLng,
  legLines,
  noFlyShapes,
  pinMarks,
  planLines,
  stopNumbers,
  tripLabels,
} from './layers.js';
import { ScaleBar } from './scale.js';
import { StreetsLayer } from './streets.js';

const L = leaflet();
const DIM = 0.18;
const LEAST_FOCUS = 0.9;
const LIT = 5; // pixels
const MOST_DIMMED = 3000; // layers; of more, those that are marked stand out and the rest stays
const MOST_LEGS = 3000; // at a time, of the vehicles in view
const TIP_GAP = 14; // pixels between a place and its tip
const TIP_EDGE = 4; // pixels between a tip and the map's edge

/** Draws into an element until `destroy` is called. */
export class MapView {
  /**
   * @param element where to draw
   * @param options `geographic`, `config` with the tiles' address, `onHover(key)`, `onSelect(key)`
   */
  constructor(element, { geographic, config, planarUnit, onHover, onSelect }) {
    this.map = L.map(element, {
      crs: geographic ? L.CRS.EPSG3857 : L.CRS.Simple,
      renderer: L.canvas({ padding: 0.5, tolerance: 4 }),
      zoomSnap: 0.25,
      zoomDelta: 0.5,
      wheelPxPerZoomLevel: 90,
      minZoom: geographic ? 1 : -16,
      maxZoom: geographic ? 20 : 16,
      attributionControl: false,
      zoomControl: false,
    });
    L.control.zoom({ position: 'topright' }).addTo(this.map);
    this.map.setView([0, 0], 2);
    this.grounds = geographic ? groundsOf(config) : [];
    if (this.grounds.length) L.control.attribution({ prefix: false }).addTo(this.map);
    this.grounds.forEach((ground) => ground.addTo(this.map));
    element.classList.toggle('with-streets', this.grounds.length > 0);
    new ScaleBar({ metresPerUnit: geographic ? null : planarUnit }).addTo(this.map);
    this.areas = L.layerGroup().addTo(this.map);
    this.shapes = L.featureGroup().addTo(this.map);
    this.labels = L.layerGroup().addTo(this.map);
    this.numbers = L.layerGroup().addTo(this.map);
    this.movers = L.layerGroup().addTo(this.map);
    this.entries = new Map(); // by key
    this.legs = new Map(); // entries by vehicle, of those in view
    this.touched = new Set(); // keys of what is drawn otherwise than its base
    this.trucks = new Map();
    this.tooltip = L.tooltip({ direction: 'top', offset: [0, -6], opacity: 1 });
    this.#listen(onHover, onSelect);
    this.resizes = new ResizeObserver(() => this.map.invalidateSize({ animate: false }));
    this.resizes.observe(element);
  }

  #listen(onHover, onSelect) {
    this.onHover = onHover;
    this.onSelect = onSelect;
    this.onGround = () => this.onSelect(null);
    this.onPress = () => {};
    this.map.on('click', ({ latlng }) => {
      if (!this.isDeaf) this.onGround([latlng.lng, latlng.lat]);
    });
    this.map.on('moveend', () => this.#showLegs());
    // One listener for all: a problem may have many thousands of marks.
    const keyOf = ({ propagatedFrom: layer }) => layer.options.key;
    this.shapes.on('mouseover', (event) => this.onHover(keyOf(event)));
    this.shapes.on('mouseout', () => this.onHover(null));
    this.shapes.on('mousedown', (event) =>
      this.onPress(keyOf(event), event.propagatedFrom, event),
    );
    this.shapes.on('click', (event) => {
      L.DomEvent.stopPropagation(event);
      if (!this.isDeaf) this.onSelect(keyOf(event), [event.latlng.lng, event.latlng.lat]);
    });
  }

  destroy() {
    this.resizes.disconnect();
    this.map.remove();
    this.isGone = true;
  }

  /** Show a problem and, if there is one, its plan; `parts` of it are settled. */
  draw(request, index, parts, dark, doubts = {}) {
    const former = this.request;
    const isSamePlan =
      former &&
      this.index === index &&
      this.parts === parts &&
      this.dark === dark &&
      isCrowded(former) === isCrowded(request);
    Object.assign(this, { request, index, parts, dark });
    this.grounds.forEach((ground) => ground.setDark?.(dark));
    [this.areas, this.labels, this.numbers].forEach((group) => group.clearLayers());
    this.noFly = noFlyShapes(request, dark);
    this.noFly.forEach((shape) => this.areas.addLayer(shape));
    if (!isSamePlan) this.#clear();
    if (index && !isSamePlan) planLines(index, parts, dark).forEach((entry) => this.#add(entry));
    this.#drawCustomers(isSamePlan ? former.customers : []);
    depotMarks(request).forEach((mark) => this.labels.addLayer(mark));
    pinMarks(request).forEach((mark) => this.labels.addLayer(mark));
    doubtMarks(request, doubts).forEach((mark) => this.labels.addLayer(mark));
    if (index) tripLabels(index, dark).forEach((mark) => this.labels.addLayer(mark));
    this.#showLegs();
    this.marked = '';
    this.map.fire('drawn');
  }

  #clear() {
    this.shapes.clearLayers();
    this.entries.clear();
    this.legs.clear();
    this.touched.clear();
  }

  /** Draw the customers, of whom some may be drawn as they were: they are told by identity. */
  #drawCustomers(former) {
    const { request, index, parts, dark } = this;
    const [drawn, wanted] = [new Set(former), new Set(request.customers)];
    const gone = new Set(former.filter((one) => !wanted.has(one)).map(({ id }) => id));
    gone.forEach((id) => this.#drop(this.entries.get(`c:${id}`) ?? []));
    const fresh = request.customers.filter((one) => !drawn.has(one) || gone.has(one.id));
    customerMarks(fresh, request, index, parts, dark).forEach((entry) => this.#add(entry));
  }

  #add(entry) {
    if (!this.entries.has(entry.key)) this.entries.set(entry.key, []);
    this.entries.get(entry.key).push(entry);
    this.shapes.addLayer(entry.layer);
  }

  #drop(entries) {
    for (const { key, layer } of [...entries]) {
      this.shapes.removeLayer(layer);
      this.entries.delete(key);
    }
  }

  /** Have the legs of vehicles in view, unless these are too many to tell one from another. */
  #showLegs() {
    if (!this.index) return;
    const bounds = this.map.getBounds();
    const all = this.index.halts.size <= MOST_LEGS;
    const isSeen = ({ trips }) =>
      trips.some(({ key }) =>
        this.entries.get(key)?.some(({ layer }) => bounds.intersects(layer.getBounds())),
      );
    const seen = all ? this.index.vehicles : this.index.vehicles.filter(isSeen);
    const length = ({ trips }) => trips.reduce((sum, { stops }) => sum + stops.length, 0);
    const number = seen.reduce((sum, vehicle) => sum + length(vehicle), 0);
    const wanted = new Set(number <= MOST_LEGS ? seen : []);
    for (const [vehicle, entries] of this.legs) {
      if (!wanted.has(vehicle)) {
        this.#drop(entries);
        this.legs.delete(vehicle);
      }
    }
    for (const vehicle of wanted) {
      if (!this.legs.has(vehicle)) {
        const entries = legLines(vehicle, this.dark);
        this.legs.set(vehicle, entries);
        entries.forEach((entry) => this.#add(entry));
        // Legs lie between their trips and the customers, who take clicks first.
        entries.forEach(({ layer }) => layer.bringToBack());
        vehicle.trips.flatMap(({ key }) => this.entries.get(key) ?? [])
          .forEach(({ layer }) => layer.bringToBack());
      }
    }
  }

  /** Show everything. */
  fit() {
    const places = [
      ...this.request.depots,
      ...standsOf(this.request),
      ...this.request.customers,
    ].map(placeOf).filter(Boolean);
    const bounds = boundsOf([...places, ...(this.request.airspace?.no_fly ?? []).flat()]);
    if (!bounds) return;
    const [west, south, east, north] = bounds;
    this.map.invalidateSize({ animate: false });
    this.map.fitBounds(
      [
        [south, west],
        [north, east],
      ],
      { padding: [36, 36], animate: false },
    );
  }

  /** Mark what is selected and what the pointer is on; the rest steps back. */
  mark(selection, hovered) {
    const focus = hovered ?? selection;
    const outer = focus && this.index ? tripOrVehicle(this.index, focus) : null;
    const state = `${outer}|${focus}|${selection}`;
    if (state === this.marked) return;
    this.marked = state;
    const dims = outer && this.entries.size <= MOST_DIMMED;
    const now = new Set(dims ? this.entries.keys() : [focus, selection].filter(Boolean));
    if (outer && !dims) keysWithin(this.index, outer).forEach((key) => now.add(key));
    for (const key of new Set([...this.touched, ...now]))
      for (const entry of this.entries.get(key) ?? [])
        this.#style(entry, outer, key === focus || key === selection, dims);
    this.touched = now;
    this.#number(selection);
  }

  #style({ key, layer, base }, outer, isFocus, dims) {
    const inside = !outer || contains(this.index, outer, key);
    const style = { ...base };
    if (!inside && dims) Object.assign(style, { opacity: base.opacity * DIM, fillOpacity: DIM });
    if (isFocus || (outer && inside && !dims)) style.weight = base.weight + 2;
    if (isFocus && !base.radius) style.opacity = Math.max(base.opacity, LEAST_FOCUS);
    layer.setStyle(style);
    if (base.radius) layer.setRadius(isFocus ? base.radius + 3 : base.radius);
    // Above customers, legs would take their clicks.
    if (isFocus && key[0] !== 'l') layer.bringToFront();
  }

  #number(selection) {
    this.numbers.clearLayers();
    const { trip } = partsOf(this.index, selection);
    if (trip) stopNumbers(trip).forEach((mark) => this.numbers.addLayer(mark));
  }

  /** Let the leg that a key names stand out, as what is dropped there would be on it; or none. */
  light(key) {
    this.lit?.layer.setStyle(this.lit.base);
    this.lit = key && this.entries.get(key)?.[0];
    this.lit?.layer.setStyle({ opacity: LEAST_FOCUS, weight: this.lit.base.weight + LIT });
  }

  /** Take no notice of the click that ends a drag. */
  ignoreClick() {
    this.isDeaf = true;
    setTimeout(() => {
      this.isDeaf = false;
    }, 0);
  }

  /** Show a tip at what a key names; null hides it. */
  tip(key, content) {
    const entry = key && this.entries.get(key)?.[0];
    if (!entry || !content) {
      this.tooltip.remove();
      return;
    }
    const place = entry.layer.getLatLng?.() ?? entry.layer.getBounds().getCenter();
    this.tooltip.setLatLng(place).setContent(content).addTo(this.map);
    const { x, y } = this.map.latLngToContainerPoint(place);
    const { offsetHeight: height, offsetWidth: width } = this.tooltip.getElement();
    const below = this.map.getSize().y - y;
    const above = y > height + TIP_GAP || y > below;
    const half = width / 2 + TIP_EDGE;
    const within = Math.min(Math.max(x, half), Math.max(this.map.getSize().x - half, half));
    Object.assign(this.tooltip.options, {
      direction: above ? 'top' : 'bottom',
      offset: [within - x, above ? -6 : 6],
    });
    this.tooltip.update();
  }

  /** Bring what a key names into view, if it is outside. */
  reveal(key) {
    const entry = this.entries.get(key)?.[0];
    if (!entry) return;
    const bounds = entry.layer.getBounds?.() ?? L.latLngBounds([entry.layer.getLatLng()]);
    if (!this.map.getBounds().contains(bounds)) {
      if (entry.layer.getBounds)
        this.map.fitBounds(bounds, { padding: [60, 60], maxZoom: this.map.getZoom() });
      else this.map.panInside(entry.layer.getLatLng(), { padding: [70, 70] });
    }
  }

  /** Place trucks and drones, `{trucks, drones}` of `playback`; null takes them away. */
  move(places) {
    if (this.isGone) return;
    const seen = new Set();
    for (const truck of places?.trucks ?? [])
      this.#moveOne(seen, truck.vehicle.key, truck, 'truck');
    for (const drone of places?.drones ?? []) this.#moveOne(seen, drone.sortie.key, drone, 'drone');
    for (const [key, marker] of this.trucks) {
      if (!seen.has(key)) {
        marker.remove();
        this.trucks.delete(key);
      }
    }
  }

  #moveOne(seen, key, what, kind) {
    seen.add(key);
    const vehicle = what.vehicle ?? what.sortie.trip.vehicle;
    if (!this.trucks.has(key)) {
      const colour = vehicleColour(vehicle.number, this.dark);
      const icon = labelIcon(`${kind}-mover`, kind === 'truck' ? vehicle.label : '', {
        background: colour,
      });
      this.trucks.set(
        key,
        L.marker(latLng(what.location), {
          icon,
          interactive: false,
          keyboard: false,
          zIndexOffset: kind === 'truck' ? 900 : 1000,
        }).addTo(this.movers),
      );
    }
    this.trucks.get(key).setLatLng(latLng(what.location));
  }
}

/** Return the layers under the plan: tiles of a server, or streets of the service's extracts. */
function groundsOf(config) {
  if (config.tile_url) {
    const attribution = asText(config.tile_attribution);
    return [L.tileLayer(config.tile_url, { attribution, maxZoom: 20 })];
  }
  const attribution = asText(config.streets_attribution);
  return config.streets.map((extract) => new StreetsLayer(extract, { attribution }));
}

function asText(text) {
  const element = document.createElement('span');
  element.textContent = text;
  return element.innerHTML;
}

/** Return the key of the trip or vehicle that is to stand out. */
function tripOrVehicle(index, key) {
  const { vehicle, trip } = partsOf(index, key);
  if (key[0] === 'v') return vehicle ? key : null;
  return trip ? trip.key : null;
}

/** Return the keys of what belongs to a trip or vehicle and is always drawn. */
function keysWithin(index, outer) {
  const { vehicle, trip } = partsOf(index, outer);
  return (trip ? [trip] : vehicle.trips).flatMap(({ key, stops, sorties }) => [
    key,
    ...[...stops, ...sorties, ...sorties.flatMap(({ visits }) => visits)].map((part) => part.key),
  ]);
}

/** Let two maps show the same place; returns a function that ends it. */
export function synchronise(first, second) {
  const follow = (leader, follower) => () => {
    if (
      follower.getZoom() !== leader.getZoom() ||
      !follower.getCenter().equals(leader.getCenter())
    ) {
      follower.setView(leader.getCenter(), leader.getZoom(), { animate: false });
    }
  };
  const [there, back] = [follow(first, second), follow(second, first)];
  first.on('move', there);
  second.on('move', back);
  there();
  return () => {
    first.off('move', there);
    second.off('move', back);
  };
}
