/** Leaflet layers of a problem and its plan. */

import { flownLegs } from '../core/flights.js';
import { nearestLine } from '../core/geometry.js';
import { tripDash, vehicleColour } from '../core/palette.js';
import { isByAir, partsOf } from '../core/plan.js';
import { doubtedPlaces, placeOf } from '../core/places.js';
import { standingIn } from '../core/replanning.js';
import { isVisit, visitsOf } from '../core/visits.js';
import { asksOf, reachOf, titleOfZone } from '../core/zone-words.js';
import { zoneAreas } from '../core/zones.js';
import { leaflet } from '../libraries.js';
import { Cross, Disc, Way } from './marks.js';

const L = leaflet();

const LINE = { weight: 3, opacity: 0.9, lineCap: 'round', lineJoin: 'round' };
const LEG = { weight: 5, opacity: 0, lineCap: 'round', lineJoin: 'round', interactive: false };
const MOST_LABELS = 30;
const SETTLED = { weight: 2, opacity: 0.5, dashArray: '1 5' };
const FLIGHT = { weight: 1.6, opacity: 0.95, dashArray: '5 4', lineCap: 'butt' };

/** A drive that is drawn only where it stands out. */
const Leg = L.Polyline.extend({
  _updatePath() {
    if (this.options.opacity > 0) L.Polyline.prototype._updatePath.call(this);
  },
});

/** Return where a location `[x, y]` is on the map. */
export function latLng([x, y]) {
  return L.latLng(y, x);
}

/** Return what a broken vehicle's way looks like. */
function lostStyle(dark) {
  return { weight: 1.5, opacity: 0.8, dashArray: '7 6', color: redOf(dark) };
}

function redOf(dark) {
  return dark ? '#ff7b72' : '#c0392b';
}

/**
 * Return the lines of a plan by key: `{key, layer, base}`; base is its style unless marked.
 *
 * @param parts what is settled, of `settledParts`
 */
export function planLines(index, parts, dark) {
  const lines = [];
  const Kind = index.plan.summary.trips > MOST_LABELS ? L.Polyline : Way;
  for (const vehicle of index.vehicles) {
    const colour = vehicleColour(vehicle.number, dark);
    for (const trip of vehicle.trips) {
      const styles = stylesOf(colour, trip, dark);
      for (const { standing, places } of stretches(trip, parts)) {
        lines.push(line(trip.key, places, styles[standing], Kind));
      }
      for (const sortie of trip.sorties) {
        const legs = flownLegs(sortie).map((leg) => leg.map(latLng));
        const style = { ...styles[standingIn(parts, sortie)], ...FLIGHT };
        if (standingIn(parts, sortie) === 'settled') style.opacity = SETTLED.opacity;
        if (legs.length) lines.push(line(sortie.key, legs, style));
      }
    }
  }
  return lines;
}

function stylesOf(colour, trip, dark) {
  const open = { ...LINE, color: colour, dashArray: tripDash(trip.index) };
  const styles = { open, settled: { ...open, ...SETTLED }, lost: { ...open, ...lostStyle(dark) } };
  if (!trip.vehicle.flies) return styles;
  return {
    open: { ...open, ...FLIGHT },
    settled: { ...styles.settled, ...FLIGHT, opacity: SETTLED.opacity },
    lost: { ...styles.lost, ...FLIGHT },
  };
}

/** Return a trip's way in stretches that are settled or not: `{standing, places}`. */
function stretches(trip, parts) {
  const stops = trip.stops.filter(({ location }) => location);
  const found = [];
  stops.slice(1).forEach((halt, position) => {
    const standing = standingIn(parts, halt);
    const last = found[found.length - 1];
    const isNext = trip.stops[halt.stop - 1] === stops[position];
    const way = (isNext ? halt.line : [stops[position].location, halt.location]).map(latLng);
    if (last?.standing === standing) last.places.push(...way.slice(1));
    else found.push({ standing, places: way });
  });
  return found;
}

/** Return the drive that a key names, seen only where it stands out; null: there is none. */
export function legLine(index, key, dark) {
  const { vehicle, leg } = partsOf(index, key);
  if (!leg || leg.line.length < 2) return null;
  const base = { ...LEG, color: vehicleColour(vehicle.number, dark) };
  return { key, base, layer: new Leg(leg.line.map(latLng), { ...base, key }) };
}

/** Return the key of the drive to a stop. */
export function legKey({ trip, stop }) {
  return `l:${trip.key.slice(2)}/${stop}`;
}

/** Return the key of the drive of a trip that is nearest to a point of the map's container. */
export function legAt(map, trip, { x, y }) {
  const lines = trip.stops.map((halt, stop) => (stop ? pixelsOf(map, halt.line) : []));
  const stop = nearestLine([x, y], lines);
  return stop < 0 ? trip.key : legKey(trip.stops[stop]);
}

/** Return where places are in a map's container. */
export function pixelsOf(map, places) {
  return places.map((place) => {
    const { x, y } = map.latLngToContainerPoint(latLng(place));
    return [x, y];
  });
}

function line(key, places, base, Kind = L.Polyline) {
  return { key, base, layer: new Kind(places, { ...base, key }) };
}

/** Return the customers' marks by key. */
export function customerMarks(request, index, parts, dark) {
  const visits = visitsOf(request);
  const crowded = visits.length > 600;
  const radius = crowded ? 3.2 : 5;
  return visits.filter(placeOf).map((customer) => {
    const key = `c:${customer.id}`;
    const [Kind, base] = customerStyle(index, customer, parts, dark, radius);
    const halt = index?.halts.get(key);
    // Who is served at another place than its own is shown there.
    const place = (halt?.alternative && halt.location) || customer.location;
    return { key, base, layer: new Kind(latLng(place), { ...base, key }) };
  });
}

function customerStyle(index, customer, parts, dark, radius) {
  const halt = index?.halts.get(`c:${customer.id}`);
  const ground = dark ? '#141a21' : '#ffffff';
  const plain = { radius, weight: 1.5, opacity: 1, fillOpacity: 1 };
  if (!index?.customers.has(customer.id)) {
    const grey = dark ? '#9aa7b4' : '#66727e';
    return [Disc, { ...plain, color: ground, fillColor: grey }];
  }
  if (!halt) {
    return [Cross, { ...plain, radius: radius + 2, weight: 3, color: redOf(dark), fill: false }];
  }
  const standing = standingIn(parts, halt);
  const colour = standing === 'lost' ? redOf(dark) : vehicleColour(halt.vehicle.number, dark);
  if (standing === 'settled') Object.assign(plain, { opacity: 0.6, fillOpacity: 0.45 });
  const fillColor = isByAir(halt) ? ground : colour;
  if (halt.lateness > 0) return [Disc, { ...plain, weight: 3, color: redOf(dark), fillColor }];
  if (isByAir(halt)) return [Disc, { ...plain, weight: 2.2, color: colour, fillColor }];
  return [Disc, { ...plain, color: ground, fillColor }];
}

/** Return the marks of some depots, starts, ends and launch sites. */
export function placeMarks(places) {
  return places
    .filter(placeOf)
    .map((depot) =>
      L.marker(latLng(depot.location), {
        interactive: false,
        keyboard: false,
        zIndexOffset: 500,
        icon: labelIcon(depot.kind === 'launch_site' ? 'site-mark' : 'depot-mark', depot.id),
      }));
}

/** Return an icon that holds text. */
export function labelIcon(className, text, style = {}) {
  const element = document.createElement('span');
  element.textContent = text;
  Object.assign(element.style, style);
  return L.divIcon({ className: `map-label ${className}`, html: element, iconSize: null });
}

/** A line as wide as twice a distance on the ground: what flights keep from a polygon's edge. */
const Band = L.Polygon.extend({
  _project() {
    const { lat, lng } = this.getBounds().getCenter();
    const y = (latitude) => this._map.latLngToLayerPoint([latitude, lng]).y;
    this.options.weight = 2 * Math.abs(y(lat + this.options.reach) - y(lat));
    L.Polygon.prototype._project.call(this);
  },
});

const METRES_PER_DEGREE = 111195;

/** Return what flights keep clear of around areas and zones, as shapes; none without a buffer. */
export function bufferShapes(request, dark) {
  const { no_fly: areas = [], buffer = 0 } = request.airspace ?? {};
  if (!(buffer > 0)) return [];
  const isGeographic = request.coordinate_system === 'geographic';
  const reach = buffer / (isGeographic ? METRES_PER_DEGREE : request.planar_unit ?? 1);
  const color = dark ? '#ff9d94' : '#a8321f';
  const around = {
    color, reach, opacity: 0.15, lineJoin: 'round', fill: false, interactive: false,
  };
  const band = (rings) => new Band(rings.map((ring) => ring.map(latLng)), around);
  return [
    ...areas.map((ring) => band([ring])),
    ...zoneAreas(request).map(({ rings, center, radius }) =>
      rings
        ? band(rings)
        : L.circle(latLng(center), {
          radius: radius + buffer, stroke: false, fillColor: color, fillOpacity: 0.15,
          interactive: false,
        }))];
}

/** Return the no-fly areas' shapes, in the order of the request. */
export function noFlyShapes(request, dark) {
  const colour = dark ? '#ff9d94' : '#a8321f';
  return (request.airspace?.no_fly ?? []).map((ring) =>
    L.polygon(ring.map(latLng), {
      color: colour, weight: 1.5, dashArray: '6 3', fillColor: colour, fillOpacity: 0.12,
      interactive: false,
    }));
}

/** Return the published zones' shapes, which tell their names, heights and authorities. */
export function zoneShapes(request, dark) {
  const colour = dark ? '#ff9d94' : '#a8321f';
  return zoneAreas(request).map((area, at) => {
    const { rings, center, radius } = area;
    const isFree = request.airspace.cleared?.includes(area.identifier);
    const style = {
      color: colour, weight: 1, dashArray: isFree ? '2 6' : null, fillColor: colour,
      fillOpacity: isFree ? 0 : 0.08, key: `z:${at}`,
    };
    const shape = rings
      ? L.polygon(rings.map((ring) => ring.map(latLng)), style)
      : L.circle(latLng(center), { ...style, radius });
    const told = document.createElement('span');
    told.innerText = [titleOfZone(area), asksOf(area), reachOf(area), area.authority]
      .filter(Boolean)
      .join('\n');
    return shape.bindTooltip(told, { sticky: true });
  });
}

/** Return a label for each trip, at its middle stop; none where there are too many to read. */
export function tripLabels(index, dark) {
  if (index.plan.summary.trips > MOST_LABELS) return [];
  return index.vehicles.flatMap((vehicle) =>
    vehicle.trips.flatMap((trip) => {
      const stops = trip.stops.filter((halt) => halt.location && isVisit(halt));
      if (!stops.length) return [];
      const middle = stops[Math.floor((stops.length - 1) / 2)];
      const icon = labelIcon('trip-mark', trip.label, {
        background: vehicleColour(vehicle.number, dark),
      });
      return [
        L.marker(latLng(middle.location), {
          icon, interactive: false, keyboard: false, zIndexOffset: 200,
        })];
    }));
}

/** Return marks beside places: `{location, className, text}`. */
export function notes(marked) {
  return marked.filter(placeOf).map(({ location, className, text }) =>
    L.marker(latLng(location), {
      interactive: false, keyboard: false, zIndexOffset: 450, icon: labelIcon(className, text),
    }));
}

/** Return what is noted beside customers: that they are pinned or doubtful, and a day's news. */
export function notedIn(request, index, doubts, news) {
  const pinned = new Set(request.replan?.pinned ?? []);
  const doubted = new Set(doubtedPlaces(request, doubts).map(({ id }) => id));
  return visitsOf(request).flatMap(({ id, location }) => {
    const said = news?.get(`c:${id}`);
    const at = index?.halts.get(`c:${id}`)?.location ?? location;
    return [
      ...(pinned.has(id) ? [{ location, className: 'pin-mark', text: '\u25be' }] : []),
      ...(doubted.has(id) ? [{ location, className: 'doubt-mark', text: '?' }] : []),
      ...(said ? [{ location: at, className: `news ${said.kind}`, text: said.text }] : [])];
  });
}
