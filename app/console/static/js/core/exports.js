/** A plan as CSV, GeoJSON and GPX. */

import { csvCell } from './csv.js';
import { flownLegs } from './flights.js';
import { clock } from './format.js';
import { placeOf } from './places.js';
import { standsOf } from './stands.js';
import { visitsOf } from './visits.js';
import { t } from '../texts.js';

const COLUMNS = [
  'vehicle', 'trip', 'position', 'kind', 'id', 'drone', 'arrival', 'service_start', 'departure',
  'arrival_s', 'service_start_s', 'departure_s', 'waiting_s', 'lateness_s', 'x', 'y', 'load'];

/** Return every stop and every customer served by drone, in order of vehicle, trip and time. */
export function stopRows(index) {
  return index.vehicles.flatMap((vehicle) =>
    vehicle.trips.flatMap((trip) => {
      const visits = trip.sorties.flatMap((sortie) => sortie.visits);
      const halts = [...trip.stops, ...visits].map((halt, position) => ({ halt, position }));
      halts.sort(
        (first, second) =>
          first.halt.arrival - second.halt.arrival || first.position - second.position);
      // A trip's last stop stays last, though a drone may still be served there.
      return halts.map(({ halt }, position) => ({
        vehicle: vehicle.name,
        trip: trip.index + 1,
        position,
        kind: halt.kind,
        id: halt.id,
        drone: halt.sortie?.drone ?? '',
        arrival: clock(halt.arrival, { precise: true }),
        service_start: clock(halt.serviceStart, { precise: true }),
        departure: clock(halt.departure, { precise: true }),
        arrival_s: halt.arrival,
        service_start_s: halt.serviceStart,
        departure_s: halt.departure,
        waiting_s: halt.waiting,
        lateness_s: halt.lateness,
        x: halt.location?.[0] ?? '',
        y: halt.location?.[1] ?? '',
        load: halt.load.join(' '),
        info: halt.source?.info ?? {},
      }));
    }));
}

/** Return the stops as CSV with a line of names. */
export function stopsCsv(index) {
  const rows = stopRows(index);
  const told = [...new Set(rows.flatMap(({ info }) => Object.keys(info)))];
  // What is told of customers may have the name of another column.
  const named = (name) => (COLUMNS.includes(name) ? `info_${name}` : name);
  const head = [...COLUMNS, ...told.map(named)];
  const lines = rows.map((row) =>
    [...COLUMNS.map((name) => row[name]), ...told.map((name) => row.info[name] ?? '')]
      .map(csvCell)
      .join(','));
  return `${[head.map(csvCell).join(','), ...lines].join('\r\n')}\r\n`;
}

/** Return customers, depots, trips, flights and no-fly areas as GeoJSON. */
export function geoJson(index) {
  const { request } = index;
  const features = [
    ...request.depots.flatMap((depot) => point(depot, { kind: 'depot', id: depot.id })),
    ...standsOf(request).flatMap(({ kind, id, location }) => point({ location }, { kind, id })),
    ...visitsOf(request).flatMap((customer) =>
      point(customer, customerProperties(index, customer))),
    ...index.vehicles.flatMap((vehicle) =>
      vehicle.trips.flatMap(tripFeatures)),
    ...(request.airspace?.no_fly ?? []).map((ring) =>
      feature('Polygon', [closed(ring)], { kind: 'no_fly' }))];
  const collection = { type: 'FeatureCollection', features };
  // GeoJSON means degrees; a plane's coordinates are told as such.
  if (request.coordinate_system !== 'geographic') {
    Object.assign(collection, {
      coordinate_system: 'planar',
      planar_unit: request.planar_unit ?? 1,
    });
  }
  return collection;
}

function feature(type, coordinates, properties) {
  return { type: 'Feature', geometry: { type, coordinates }, properties };
}

function point(place, properties) {
  const location = placeOf(place);
  return location ? [feature('Point', location, properties)] : [];
}

function customerProperties(index, customer) {
  const halt = index.halts.get(`c:${customer.id}`);
  const told = customer.info && { info: customer.info };
  if (!halt) return { kind: 'customer', id: customer.id, served: false, ...told };
  return {
    kind: 'customer', id: customer.id, ...told, served: true, vehicle: halt.vehicle.name,
    trip: halt.trip.index + 1, drone: halt.sortie?.drone ?? null, arrival: halt.arrival,
    service_start: halt.serviceStart, departure: halt.departure, lateness: halt.lateness,
  };
}

function tripFeatures(trip) {
  const common = { vehicle: trip.vehicle.name, trip: trip.index + 1 };
  const isLine = ({ geometry }) => geometry.coordinates.length > 1;
  const driven = feature('LineString', joined(trip.stops.map(({ line }) => line)), {
    kind: 'trip',
    ...common,
    ...(trip.vehicle.flies && { flies: true }),
    load_rate: trip.reply.load_rate,
    distance: trip.reply.distance,
  });
  const flights = trip.sorties.map((sortie) => feature('LineString', joined(flownLegs(sortie)), {
    kind: 'flight',
    ...common,
    drone: sortie.drone,
    launch_time: sortie.reply.launch_time,
    recovery_time: sortie.reply.recovery_time,
  }));
  return [driven, ...flights].filter(isLine);
}

/** Return lines, each of which begins where the one before ends, as one. */
function joined(lines) {
  return lines.flat().filter(([x, y], index, all) => {
    const [beforeX, beforeY] = all[index - 1] ?? [];
    return x !== beforeX || y !== beforeY;
  });
}

function closed(ring) {
  const [first, last] = [ring[0], ring[ring.length - 1]];
  return first[0] === last[0] && first[1] === last[1] ? ring : [...ring, first];
}

/**
 * Return a vehicle's trips as GPX routes, their roads, where known, and its drones' flights as
 * tracks; degrees only.
 */
export function gpx(vehicle) {
  const routes = vehicle.trips.map(
    (trip) => `  <rte>
    <name>${escaped(tripName(vehicle, trip))}</name>
${trip.stops.map((halt, position) => routePoint(halt, position)).join('\n')}
  </rte>`);
  const drives = vehicle.trips
    .filter((trip) => trip.stops.some(({ line }) => line.length > 2))
    .map((trip) =>
      track(
        vehicle.flies
          ? t('take.way', { trip: tripName(vehicle, trip) })
          : t('take.road', { trip: tripName(vehicle, trip) }),
        trip.stops.map(({ line }) => line)));
  const flights = vehicle.trips
    .flatMap((trip) => trip.sorties)
    .map((sortie) =>
      track(
        t('take.flightTo', {
          drone: sortie.drone,
          names: sortie.visits.map(({ id }) => id).join(', '),
        }),
        flownLegs(sortie)));
  return `<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="Tandem" xmlns="http://www.topografix.com/GPX/1/1">
${[...routes, ...drives, ...flights].join('\n')}
</gpx>
`;
}

function tripName({ name }, { index }) {
  return t('about.trip', { vehicle: name, number: index + 1 });
}

function track(name, lines) {
  const points = joined(lines).map(([lon, lat]) => `      <trkpt lat="${lat}" lon="${lon}"/>`);
  return `  <trk>
    <name>${escaped(name)}</name>
    <trkseg>
${points.join('\n')}
    </trkseg>
  </trk>`;
}

function routePoint(halt, position) {
  const [lon, lat] = halt.location;
  const told = Object.entries(halt.source?.info ?? {}).map(([name, text]) => `, ${name}: ${text}`);
  const times = t('take.times', { arrival: clock(halt.arrival), departure: clock(halt.departure) });
  return (
    `    <rtept lat="${lat}" lon="${lon}"><name>${escaped(`${position} ${halt.id}`)}</name>` +
    `<desc>${escaped(times + told.join(''))}</desc></rtept>`
  );
}

/** Return a text with what XML takes for its own written otherwise. */
export function escaped(text) {
  const names = { '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', "'": '&#39;' };
  return (
    String(text)
      .replace(/[&<>"']/g, (character) => names[character])
      // XML has no way to write these.
      .replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f]/g, ''));
}
