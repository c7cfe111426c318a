/** Leaflet layers of a problem and its plan. */

import { flightLines } from '../core/flights.js';
import { tripDash, vehicleColour } from '../core/palette.js';
import { leaflet } from '../libraries.js';

const L = leaflet();

const LINE = { weight: 2.5, opacity: 0.9, lineCap: 'round', lineJoin: 'round' };
const MOST_LABELS = 30;
const FLIGHT = { weight: 1.6, opacity: 0.95, dashArray: '1 4', lineCap: 'round' };

/** A customer that nobody serves: a cross, so that it is told by shape too. */
const Cross = L.CircleMarker.extend({
  _updatePath() {
    const renderer = this._renderer;
    if (!renderer._drawing || this._empty()) return;
    const { _ctx: context } = renderer;
    const { x, y } = this._point;
    const size = this._radius * 0.75;
    context.beginPath();
    context.moveTo(x - size, y - size);
    context.lineTo(x + size, y + size);
    context.moveTo(x + size, y - size);
    context.lineTo(x - size, y + size);
    renderer._fillStroke(context, this);
  },
});

/** Return where a location `[x, y]` is on the map. */
export function latLng([x, y]) {
  return L.latLng(y, x);
}

/** Return the lines of a plan by key: `{key, layer, base}`; base is its style unless marked. */
export function planLines(index, dark) {
  const legsOf = flightLines(index.request);
  const lines = [];
  for (const vehicle of index.vehicles) {
    const colour = vehicleColour(vehicle.index, dark);
    for (const trip of vehicle.trips) {
      const places = trip.stops
        .filter(({ location }) => location)
        .map(({ location }) => latLng(location));
      const style = { ...LINE, color: colour, dashArray: tripDash(trip.index) };
      if (places.length > 1) lines.push(line(trip.key, places, style));
      for (const sortie of trip.sorties) {
        const legs = legsOf(sortie).map((leg) => leg.map(latLng));
        if (legs.length) lines.push(line(sortie.key, legs, { ...FLIGHT, color: colour }));
      }
    }
  }
  return lines;
}

function line(key, places, base) {
  return { key, base, layer: L.polyline(places, { ...base, key }) };
}

/** Return the customers' marks by key. */
export function customerMarks(request, index, dark) {
  const crowded = request.customers.length > 600;
  const radius = crowded ? 3.2 : 5;
  return request.customers
    .filter(({ location }) => location)
    .map((customer) => {
      const key = `c:${customer.id}`;
      const [Kind, base] = customerStyle(index, index?.halts.get(key), dark, radius);
      return { key, base, layer: new Kind(latLng(customer.location), { ...base, key }) };
    });
}

function customerStyle(index, halt, dark, radius) {
  const ground = dark ? '#141a21' : '#ffffff';
  const plain = { radius, weight: 1.5, opacity: 1, fillOpacity: 1 };
  if (!index) {
    const grey = dark ? '#9aa7b4' : '#66727e';
    return [L.CircleMarker, { ...plain, color: ground, fillColor: grey }];
  }
  if (!halt) {
    const red = dark ? '#ff7b72' : '#c0392b';
    return [Cross, { ...plain, radius: radius + 2, weight: 3, color: red, fill: false }];
  }
  const colour = vehicleColour(halt.vehicle.index, dark);
  if (halt.sortie)
    return [L.CircleMarker, { ...plain, weight: 2.2, color: colour, fillColor: ground }];
  return [L.CircleMarker, { ...plain, color: ground, fillColor: colour }];
}

/** Return the depots' marks. */
export function depotMarks(request) {
  return request.depots
    .filter(({ location }) => location)
    .map((depot) =>
      L.marker(latLng(depot.location), {
        interactive: false,
        keyboard: false,
        zIndexOffset: 500,
        icon: labelIcon('depot-mark', depot.id),
      }),
    );
}

/** Return an icon that holds text. */
export function labelIcon(className, text, style = {}) {
  const element = document.createElement('span');
  element.textContent = text;
  Object.assign(element.style, style);
  return L.divIcon({ className: `map-label ${className}`, html: element, iconSize: null });
}

/** Return the no-fly areas' shapes, in the order of the request. */
export function noFlyShapes(request, dark) {
  const colour = dark ? '#ff9d94' : '#a8321f';
  return (request.airspace?.no_fly ?? []).map((ring) =>
    L.polygon(ring.map(latLng), {
      color: colour,
      weight: 1.5,
      dashArray: '6 3',
      fillColor: colour,
      fillOpacity: 0.12,
      interactive: false,
    }),
  );
}

/** Return a label for each trip, at its middle stop; none where there are too many to read. */
export function tripLabels(index, dark) {
  if (index.plan.summary.trips > MOST_LABELS) return [];
  return index.vehicles.flatMap((vehicle) =>
    vehicle.trips.flatMap((trip) => {
      const stops = trip.stops.filter(({ location, kind }) => location && kind === 'customer');
      if (!stops.length) return [];
      const middle = stops[Math.floor((stops.length - 1) / 2)];
      const icon = labelIcon('trip-mark', trip.label, {
        background: vehicleColour(vehicle.index, dark),
      });
      return [
        L.marker(latLng(middle.location), {
          icon,
          interactive: false,
          keyboard: false,
          zIndexOffset: 200,
        }),
      ];
    }),
  );
}

/** Return the numbers of a trip's stops. */
export function stopNumbers(trip) {
  return trip.stops.flatMap((halt, number) =>
    halt.kind === 'customer' && halt.location
      ? [
          L.marker(latLng(halt.location), {
            interactive: false,
            keyboard: false,
            zIndexOffset: 300,
            icon: labelIcon('stop-mark', String(number)),
          }),
        ]
      : [],
  );
}
