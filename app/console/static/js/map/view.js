/** One map: a problem, a plan on it, and where everything is at an instant. */

import { contains, keysWithin, partsOf } from '../core/plan.js';
import { vehicleColour } from '../core/palette.js';
import { placeOf } from '../core/places.js';
import { standsOf } from '../core/stands.js';
import { visitsOf } from '../core/visits.js';
import { drivesStraight } from '../core/warned.js';
import { leaflet } from '../libraries.js';
import {
  bufferShapes, customerMarks, labelIcon, latLng, legAt, legLine, noFlyShapes, notedIn, notes,
  zoneShapes, placeMarks, planLines, tripLabels,
} from './layers.js';
import { fitWhole, isSeen } from './fitting.js';
import { groundsOf } from './grounds.js';
import { pointsOn } from './kept-clear.js';
import { stopNumbers } from './numbers.js';
import { ScaleBar } from './scale.js';
import { StopNames } from './street-names.js';
import { t } from '../texts.js';

const L = leaflet();
const DIM = 0.18;
const LEAST_FOCUS = 0.9;
const MOST_DIMMED = 3000; // lines and marks; where there are more, the rest doesn't step back
const LIT = 5; // pixels
const TIP_GAP = 14; // pixels between a place and its tip
const TIP_EDGE = 4; // pixels between a tip and the map's edge

/** The library draws at once and forgets the frame that it has asked for: it comes all the same. */
const Canvas = L.Canvas.extend({
  _redraw() {
    if (this._ctx) L.Canvas.prototype._redraw.call(this);
  },
});

/** Draws into an element until `destroy` is called. */
export class MapView {
  /**
   * @param element where to draw
   * @param options `geographic`, `config` with the tiles' address, `onHover(key)`, `onSelect(key)`
   */
  constructor(element, { geographic, config, planarUnit, onHover, onSelect }) {
    this.map = L.map(element, {
      crs: geographic ? L.CRS.EPSG3857 : L.CRS.Simple,
      renderer: new Canvas({ padding: 0.5, tolerance: 4 }),
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
    this.credit = L.control.attribution({ prefix: false }).addTo(this.map);
    this.config = geographic ? config : null;
    this.grounds = [];
    this.names = new StopNames(this);
    new ScaleBar({ metresPerUnit: geographic ? null : planarUnit }).addTo(this.map);
    this.areas = L.layerGroup().addTo(this.map);
    this.shapes = L.layerGroup().addTo(this.map);
    this.labels = L.layerGroup().addTo(this.map);
    this.numbers = L.layerGroup().addTo(this.map);
    this.sighted = L.layerGroup().addTo(this.map);
    this.movers = L.layerGroup().addTo(this.map);
    this.request = null; // what is drawn, from `draw` on
    this.index = null;
    this.dark = false;
    this.entries = [];
    this.byKey = new Map(); // entries
    this.touched = []; // entries that are marked, where there are many
    this.trucks = new Map();
    this.names.addTo(this.map);
    this.tooltip = L.tooltip({ direction: 'top', offset: [0, -6], opacity: 1 });
    this.#listen(onHover, onSelect);
    this.isMoved = true; // from where everything is seen
    this.map.on('movestart', () => {
      this.isMoved ||= !this.isFitting;
    });
    this.map.on('moveend', () => {
      const { numbered } = this;
      this.numbered = undefined;
      if (this.index) this.#number(numbered ?? null);
    });
    this.resizes = new ResizeObserver(() => {
      if (this.isMoved) this.map.invalidateSize({ animate: false });
      else this.fit();
    });
    this.resizes.observe(element);
  }

  #listen(onHover, onSelect) {
    this.onHover = onHover;
    this.onSelect = onSelect;
    this.isThrough = false;
    /** @type {(point: Point) => void} */
    this.onGround = () => this.onSelect(null);
    /** @type {(key: string, event: any) => void} */
    this.onPress = () => {};
    this.map.on('click', ({ latlng }) => this.onGround([latlng.lng, latlng.lat]));
    // What is meant for the ground goes on to it.
    this.pressZone = (event) => this.isThrough || this.listeners.click(event);
    // Each has them itself: of one that was drawn anew under the pointer, its group hears no more.
    const pointed = (event) => this.onHover(this.#keyAt(event));
    this.listeners = {
      mouseover: pointed,
      mousemove: pointed,
      mouseout: () => this.onHover(null),
      mousedown: (event) => this.onPress(event.target.options.key, event),
      click: (event) => {
        L.DomEvent.stopPropagation(event);
        const { lng, lat } = event.latlng;
        this.onSelect(this.#keyAt(event), [lng, lat]);
      },
    };
  }

  /** Return the key of what an event is on: of a trip's line, the drive there. */
  #keyAt({ target, originalEvent }) {
    const { key } = target.options;
    const { trip } = key[0] === 't' ? partsOf(this.index, key) : {};
    return trip
      ? legAt(this.map, trip, this.map.mouseEventToContainerPoint(originalEvent))
      : key;
  }

  destroy() {
    this.resizes.disconnect();
    this.map.remove();
    this.isGone = true;
  }

  /** Show a ground: tiles of a server if wanted, else the service's own. */
  setGround(asksServer) {
    this.grounds.forEach((ground) => ground.remove());
    this.grounds = this.config ? groundsOf(this.config, asksServer,
      () => pointsOn(this, this.names.placed)) : [];
    this.grounds.forEach((ground) => ground.addTo(this.map));
    this.map.getContainer().classList.toggle('with-streets', this.grounds.length > 0);
    this.shade(this.dark);
  }

  /** Show the ground in light or dark. */
  shade(dark) {
    this.dark = dark;
    [...this.grounds, this.names].forEach((layer) => layer.setDark?.(dark));
  }

  /** Show a problem and, if there is one, its plan; `parts` of it are settled. */
  draw(request, index, parts, dark, doubts = {}, news = null) {
    const isNew = index !== this.index;
    Object.assign(this, { request, index, parts, dark });
    this.credit.setPrefix(index && drivesStraight(index) ? t('map.straight') : false);
    [this.areas, this.shapes, this.labels, this.numbers].forEach((group) => group.clearLayers());
    this.noFly = noFlyShapes(request, dark);
    this.buffers = bufferShapes(request, dark);
    const zones = zoneShapes(request, dark).map((shape) => shape.on('click', this.pressZone));
    [...this.buffers, ...zones, ...this.noFly].forEach((shape) => this.areas.addLayer(shape));
    const lines = index ? planLines(index, parts, dark) : [];
    this.entries = [...lines, ...customerMarks(request, index, parts, dark)];
    this.byKey = new Map();
    this.touched = [];
    this.entries.forEach((entry) => this.#add(entry));
    const stands = standsOf(request);
    const sites = stands.filter(({ kind }) => kind === 'launch_site');
    const others = stands.filter(({ kind }) => kind !== 'launch_site');
    placeMarks([...request.depots, ...others]).forEach((mark) => this.labels.addLayer(mark));
    this.sites = placeMarks(sites).map((mark, at) => ({ id: sites[at].id, mark }));
    this.sites.forEach(({ mark }) => this.labels.addLayer(mark));
    notes(notedIn(request, index, doubts, news)).forEach((mark) => this.labels.addLayer(mark));
    if (index) tripLabels(index, dark).forEach((mark) => this.labels.addLayer(mark));
    this.marked = '';
    this.numbered = undefined;
    this.map.fire('drawn');
    if (isNew && !this.isMoved && !isSeen(this.map, this.#extentOf(request))) this.fit();
  }

  #add(entry) {
    this.shapes.addLayer(entry.layer.on(this.listeners));
    this.#setReach(entry);
    if (!this.byKey.has(entry.key)) this.byKey.set(entry.key, []);
    this.byKey.get(entry.key).push(entry);
  }

  /** Return what a key names, of which drives are made when they are asked for. */
  #entryOf(key) {
    const found = key && this.byKey.get(key)?.[0];
    const leg = !found && key?.[0] === 'l' && legLine(this.index, key, this.dark);
    if (!leg) return found;
    this.entries.push(leg);
    this.#add(leg);
    return leg;
  }

  /** Show everything of a problem, and of its plan once that is drawn. */
  fit(request = this.request) {
    this.isFitting = true;
    this.map.invalidateSize({ animate: false });
    fitWhole(this.map, this.#extentOf(request));
    this.isFitting = false;
    this.isMoved = false;
  }

  /** Return the places and ways of a problem and, if it is drawn, its plan. */
  #extentOf(request) {
    const places = [...request.depots, ...standsOf(request), ...visitsOf(request)]
      .map(placeOf)
      .filter(Boolean);
    const ways = request === this.request ? this.entries.flatMap(waysOf) : [];
    return [...places.map((place) => [place]), ...(request.airspace?.no_fly ?? []), ...ways];
  }

  /** Mark what is selected and what the pointer is on; the rest steps back, unless it is much. */
  mark(selection, hovered) {
    const focus = hovered ?? selection;
    const [outer, own] = [focus, selection].map((key) =>
      key && this.index ? tripOrVehicle(this.index, key) : null);
    const state = `${outer}|${focus}|${selection}`;
    if (state === this.marked) return;
    this.marked = state;
    [focus, selection].forEach((key) => this.#entryOf(key));
    const isFew = this.entries.length <= MOST_DIMMED;
    const keys = new Set([focus, selection, ...(outer ? keysWithin(this.index, outer) : [])]);
    const marked = isFew ? this.entries : [...keys].flatMap((key) => this.byKey.get(key) ?? []);
    for (const entry of new Set([...this.touched, ...marked])) {
      const inside = !outer || contains(this.index, outer, entry.key);
      const isFocus = entry.key === focus || entry.key === selection;
      restyle(entry, { isFocus, isDim: isFew && !inside, isBold: !isFew && outer && inside });
    }
    this.touched = isFew ? [] : marked;
    this.#number(own);
    this.numbers.eachLayer((mark) =>
      mark.setOpacity(!outer || contains(this.index, outer, mark.options.key) ? 1 : DIM));
  }

  /** Write numbers of stops, all of whose key is given, else those for which there is room. */
  #number(outer) {
    if (this.numbered === outer) return;
    this.numbered = outer;
    this.numbers.clearLayers();
    stopNumbers(this, outer).forEach((mark) => this.numbers.addLayer(mark));
    this.map.fire('drawn');
  }

  /** Let the leg that a key names stand out, as what is dropped there would be on it; or none. */
  light(key) {
    this.lit?.layer.setStyle(this.lit.base);
    this.lit = this.#entryOf(key);
    this.lit?.layer.setStyle({ opacity: LEAST_FOCUS, weight: this.lit.base.weight + LIT });
  }

  /** Return the layers that mark what a key names. */
  marksOf(key) {
    return (this.byKey.get(key) ?? []).map(({ layer }) => layer);
  }

  /** Let the pointer through lines and marks to the ground, or to them again. */
  letThrough(isThrough) {
    this.isThrough = isThrough;
    this.entries.forEach((entry) => this.#setReach(entry));
    if (isThrough) this.onHover(null);
  }

  #setReach({ layer, base }) {
    layer.options.interactive = !this.isThrough && base.interactive !== false;
  }

  /** Show a tip at what a key names; null hides it. */
  tip(key, content) {
    const entry = this.#entryOf(key);
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

  /** Bring what a key names into view, if it is outside or below what is told of it. */
  reveal(key) {
    const entry = !this.isGone && this.#entryOf(key);
    if (!entry) return;
    const { lng, lat } = entry.layer.getLatLng?.() ?? {};
    const lines = lng === undefined ? waysOf(entry) : [[[lng, lat]]];
    if (!isSeen(this.map, lines, true)) fitWhole(this.map, lines, this.map.getZoom());
  }

  /** Note where vehicles were seen, `{location, text}`. */
  sight(places) {
    if (this.isGone) return;
    this.sighted.clearLayers();
    notes(places.map((place) => ({ ...place, className: 'sight-mark' })))
      .forEach((mark) => this.sighted.addLayer(mark));
  }

  /** Place trucks and drones, `{trucks, drones}` of `playback`; null takes them away. */
  move(places) {
    if (this.isGone) return;
    const seen = new Set();
    for (const truck of places?.trucks ?? [])
      this.#moveOne(seen, truck.vehicle.key, truck, truck.vehicle.flies ? 'drone' : 'truck');
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
      this.trucks.set(key, L.marker(latLng(what.location), {
        icon, interactive: false, keyboard: false, zIndexOffset: kind === 'truck' ? 900 : 1000,
      }).addTo(this.movers));
    }
    this.trucks.get(key).setLatLng(latLng(what.location));
  }
}

/** Return the lines of a way as lists of places. */
function waysOf({ layer }) {
  const lines = layer.getLatLngs?.() ?? [];
  const parts = Array.isArray(lines[0]) ? lines : [lines];
  return parts.map((line) => line.map(({ lng, lat }) => [lng, lat]));
}

function restyle({ key, layer, base }, { isFocus, isDim, isBold }) {
  const style = { ...base };
  if (isDim) Object.assign(style, { opacity: base.opacity * DIM, fillOpacity: DIM });
  if (isFocus || isBold) style.weight = base.weight + 2;
  if (isFocus && !base.radius) style.opacity = Math.max(base.opacity, LEAST_FOCUS);
  layer.setStyle(style);
  if (base.radius) layer.setRadius(isFocus ? base.radius + 3 : base.radius);
  // Above customers, lines would take their clicks.
  if (isFocus && key[0] === 'c') layer.bringToFront();
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
    if (follower.getZoom() !== leader.getZoom()
      || !follower.getCenter().equals(leader.getCenter())) {
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
