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
  labelIcon,
  latLng,
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
    this.shapes = L.layerGroup().addTo(this.map);
    this.labels = L.layerGroup().addTo(this.map);
    this.numbers = L.layerGroup().addTo(this.map);
    this.movers = L.layerGroup().addTo(this.map);
    this.entries = [];
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
  }

  destroy() {
    this.resizes.disconnect();
    this.map.remove();
    this.isGone = true;
  }

  /** Show a problem and, if there is one, its plan; `parts` of it are settled. */
  draw(request, index, parts, dark, doubts = {}) {
    Object.assign(this, { request, index, dark });
    this.grounds.forEach((ground) => ground.setDark?.(dark));
    [this.areas, this.shapes, this.labels, this.numbers].forEach((group) => group.clearLayers());
    this.noFly = noFlyShapes(request, dark);
    this.noFly.forEach((shape) => this.areas.addLayer(shape));
    const lines = index ? planLines(index, parts, dark) : [];
    this.entries = [...lines, ...customerMarks(request, index, parts, dark)];
    for (const { layer, key } of this.entries) this.#addEntry(layer, key);
    depotMarks(request).forEach((mark) => this.labels.addLayer(mark));
    pinMarks(request).forEach((mark) => this.labels.addLayer(mark));
    doubtMarks(request, doubts).forEach((mark) => this.labels.addLayer(mark));
    if (index) tripLabels(index, dark).forEach((mark) => this.labels.addLayer(mark));
    this.marked = '';
    this.map.fire('drawn');
  }

  #addEntry(layer, key) {
    layer.on('mouseover', () => this.onHover(key));
    layer.on('mouseout', () => this.onHover(null));
    layer.on('mousedown', (event) => this.onPress(key, layer, event));
    layer.on('click', (event) => {
      L.DomEvent.stopPropagation(event);
      if (!this.isDeaf) this.onSelect(key, [event.latlng.lng, event.latlng.lat]);
    });
    this.shapes.addLayer(layer);
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
    for (const { key, layer, base } of this.entries) {
      const inside = !outer || contains(this.index, outer, key);
      const isFocus = key === focus || key === selection;
      const style = { ...base };
      if (!inside) Object.assign(style, { opacity: base.opacity * DIM, fillOpacity: DIM });
      if (isFocus) style.weight = base.weight + 2;
      if (isFocus && !base.radius) style.opacity = Math.max(base.opacity, LEAST_FOCUS);
      layer.setStyle(style);
      if (base.radius) layer.setRadius(isFocus ? base.radius + 3 : base.radius);
      // Above customers, legs would take their clicks.
      if (isFocus && key[0] !== 'l') layer.bringToFront();
    }
    this.#number(selection);
  }

  #number(selection) {
    this.numbers.clearLayers();
    const { trip } = partsOf(this.index, selection);
    if (trip) stopNumbers(trip).forEach((mark) => this.numbers.addLayer(mark));
  }

  /** Let the leg that a key names stand out, as what is dropped there would be on it; or none. */
  light(key) {
    this.lit?.layer.setStyle(this.lit.base);
    this.lit = key && this.entries.find((entry) => entry.key === key);
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
    const entry = key && this.entries.find((other) => other.key === key);
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
    const entry = this.entries.find((other) => other.key === key);
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
