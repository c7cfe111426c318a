/** A picture of a plan, map above timeline, as shapes that SVG and a canvas both draw. */

import { flightCount } from './drones.js';
import { boundsOf, planeOf } from './geometry.js';
import { clock, money } from './format.js';
import { tripDash, vehicleColour } from './palette.js';
import { isByAir, spanOf } from './plan.js';
import { standsOf } from './stands.js';
import { trueCost } from './terms.js';
import { rowWindows, tickStep, timelineRows } from './timeline.js';
import { escaped } from './exports.js';
import { placeOf } from './places.js';
import { visitsOf } from './visits.js';
import { t } from '../texts.js';

const WIDTH = 1200;
const MAP_HEIGHT = 760;
const MARGIN = 46;
const ROW = 16;
const GUTTER = 130;
const INK = '#17212b';
const FAINT = '#566472';
const RED = '#a8321f';
const FLIGHT = { width: 1.4, dash: '2 4' };

/** Return `{width, height, shapes}`; a shape is a `line`, `area`, `circle`, `box` or `text`. */
export function pictureOf(index, legsOf) {
  const rows = timelineRows(index);
  const shapes = [
    ...titleShapes(index),
    ...mapShapes(index, legsOf),
    ...timelineShapes(index, rows, MAP_HEIGHT + MARGIN),
  ];
  return { width: WIDTH, height: MAP_HEIGHT + MARGIN + (rows.length + 2) * ROW + 10, shapes };
}

function titleShapes({ request, plan }) {
  const { summary } = plan;
  const text = [
    t('header.cost', { sum: money(trueCost({ request, plan })) }),
    t('header.served', { served: String(summary.served), customers: String(summary.customers) }),
    t('header.vehicles', { count: summary.vehicles }),
    t('routes.trips', { count: summary.trips }),
    t('header.flights', { count: flightCount({ request, plan }) }),
  ].join(', ');
  return [{ kind: 'text', at: [MARGIN, 26], text, size: 15, colour: INK }];
}

function mapShapes(index, legsOf) {
  const { request } = index;
  const { toPlane } = planeOf(request);
  const places = [...request.depots, ...standsOf(request), ...visitsOf(request)];
  const known = places.map(placeOf).filter(Boolean);
  const rings = request.airspace?.no_fly ?? [];
  const bounds = boundsOf([...known, ...rings.flat()].map(toPlane));
  if (!bounds) return [];
  const at = fit(bounds, toPlane);
  const stands = [...request.depots, ...standsOf(request)].filter(placeOf);
  return [
    ...rings.map((ring) => ({ kind: 'area', points: ring.map(at), colour: RED })),
    ...index.vehicles.flatMap((vehicle) =>
      vehicle.trips.flatMap((trip) => tripShapes(trip, legsOf, at)),
    ),
    ...visitsOf(request).flatMap((customer) => customerShapes(index, customer, at)),
    ...stands.flatMap(({ kind, id, location }) => [
      kind === 'launch_site'
        ? { kind: 'circle', at: at(location), radius: 6, colour: INK, fill: '#ffffff' }
        : { kind: 'box', at: move(at(location), -6, -6), size: [12, 12], colour: INK },
      { kind: 'text', at: move(at(location), 9, 4), text: id, size: 12, colour: INK },
    ]),
  ];
}

/** @returns {Point} */
function move([x, y], right, down) {
  return [x + right, y + down];
}

/**
 * Return a function from a location to the picture, north above.
 *
 * @param {Bounds} bounds
 * @param {(place: Point) => Point} toPlane
 * @returns {(place: Point) => Point}
 */
function fit([west, south, east, north], toPlane) {
  const [width, height] = [WIDTH - 2 * MARGIN, MAP_HEIGHT - 2 * MARGIN];
  const scale = Math.min(
    width / Math.max(east - west, 1e-9),
    height / Math.max(north - south, 1e-9),
  );
  const left = MARGIN + (width - (east - west) * scale) / 2;
  const top = MARGIN + (height - (north - south) * scale) / 2;
  return (location) => {
    const [x, y] = toPlane(location);
    return [left + (x - west) * scale, top + (north - y) * scale];
  };
}

function tripShapes(trip, legsOf, at) {
  const colour = vehicleColour(trip.vehicle.number, false);
  const places = trip.stops.flatMap(({ location }) => (location ? [at(location)] : []));
  const middle = places[Math.floor(places.length / 2)];
  const way = trip.stops.flatMap(({ line }) => line.map(at));
  const style = trip.vehicle.flies ? FLIGHT : { width: 2.2, dash: tripDash(trip.index) };
  return [
    { kind: 'line', points: way, colour, ...style },
    ...trip.sorties.flatMap((sortie) =>
      legsOf(sortie).map((leg) => ({
        kind: 'line',
        points: leg.map(at),
        colour,
        ...FLIGHT,
      })),
    ),
    ...(middle
      ? [{ kind: 'text', at: move(middle, 7, -8), text: trip.label, size: 12, colour }]
      : []),
  ];
}

function customerShapes(index, customer, at) {
  const location = placeOf(customer);
  if (!location) return [];
  const { id } = customer;
  const halt = index.halts.get(`c:${id}`);
  const centre = at(location);
  if (!halt)
    return [{ kind: 'text', at: move(centre, -5, 5), text: '\u00d7', size: 18, colour: RED }];
  const colour = vehicleColour(halt.vehicle.number, false);
  return [
    { kind: 'circle', at: centre, radius: 4, colour, fill: isByAir(halt) ? '#ffffff' : colour },
  ];
}

function timelineShapes(index, rows, top) {
  const [start, end] = spanOf(index);
  const x = (time) => GUTTER + ((time - start) / (end - start)) * (WIDTH - GUTTER - MARGIN);
  const step = tickStep(end - start, 14);
  const shapes = [];
  for (let time = Math.ceil(start / step) * step; time <= end; time += step) {
    shapes.push(
      {
        kind: 'line',
        points: [
          [x(time), top + ROW],
          [x(time), top + ROW * (rows.length + 1)],
        ],
        colour: '#d5dce3',
        width: 1,
      },
      { kind: 'text', at: [x(time) - 12, top + 11], text: clock(time), size: 11, colour: FAINT },
    );
  }
  rows.forEach((row, position) =>
    shapes.push(...rowShapes(row, top + ROW * (position + 1), x, [start, end])),
  );
  return shapes;
}

function rowShapes(row, top, x, [start, end]) {
  const colour = vehicleColour(row.vehicle.number, false);
  const thin = { drive: 3, fly: 2 };
  const isVehicle = row.kind === 'vehicle';
  return [
    {
      kind: 'text',
      at: [isVehicle ? 12 : 24, top + 12],
      text: row.label,
      size: 11,
      colour: isVehicle ? INK : FAINT,
    },
    ...rowWindows(row).map(({ earliest, latest }) => {
      const [from, until] = [Math.max(earliest, start), Math.min(latest ?? end, end)].map(x);
      return {
        kind: 'line',
        colour: '#8fb3d0',
        width: 0.8,
        points: [
          [from, top + 12],
          [from, top + 14],
          [until, top + 14],
          [until, top + 12],
        ],
      };
    }),
    ...row.bars.map((bar) => {
      const height = thin[bar.kind] ?? 9;
      return {
        kind: 'box',
        at: [x(bar.from), top + 7 - height / 2],
        size: [Math.max(x(bar.until) - x(bar.from), 0.6), height],
        colour: bar.kind === 'wait' || bar.kind === 'reload' ? '#c4ab62' : colour,
        faint: bar.kind === 'handle' || bar.kind === 'reload',
      };
    }),
  ];
}

/** Return a picture as SVG. */
export function toSvg({ width, height, shapes }) {
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
    `viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif">\n` +
    `<rect width="${width}" height="${height}" fill="#ffffff"/>\n` +
    `${shapes.map(svgShape).join('\n')}\n</svg>\n`
  );
}

const round = (value) => Math.round(value * 10) / 10;
const list = (points) => points.map(([x, y]) => `${round(x)},${round(y)}`).join(' ');

function svgShape(shape) {
  const [x, y] = (shape.at ?? [0, 0]).map(round);
  switch (shape.kind) {
    case 'line':
      return (
        `<polyline points="${list(shape.points)}" fill="none" stroke="${shape.colour}" ` +
        `stroke-width="${shape.width}"${shape.dash ? ` stroke-dasharray="${shape.dash}"` : ''}/>`
      );
    case 'area':
      return (
        `<polygon points="${list(shape.points)}" fill="${shape.colour}" fill-opacity="0.12" ` +
        `stroke="${shape.colour}" stroke-dasharray="6 3"/>`
      );
    case 'circle':
      return (
        `<circle cx="${x}" cy="${y}" r="${shape.radius}" fill="${shape.fill}" ` +
        `stroke="${shape.colour}" stroke-width="1.8"/>`
      );
    case 'box':
      return (
        `<rect x="${x}" y="${y}" width="${round(shape.size[0])}" ` +
        `height="${shape.size[1]}" fill="${shape.colour}" ` +
        `fill-opacity="${shape.faint ? 0.35 : 1}"/>`
      );
    default:
      return (
        `<text x="${x}" y="${y}" font-size="${shape.size}" fill="${shape.colour}">` +
        `${escaped(shape.text)}</text>`
      );
  }
}

/** Draw a picture into a canvas's context. */
export function drawPicture(context, { width, height, shapes }) {
  context.fillStyle = '#ffffff';
  context.fillRect(0, 0, width, height);
  for (const shape of shapes) drawShape(context, shape);
}

function drawShape(context, shape) {
  Object.assign(context, {
    fillStyle: shape.colour,
    strokeStyle: shape.colour,
    globalAlpha: 1,
    lineWidth: shape.width ?? 1.5,
  });
  context.setLineDash(
    (shape.dash ?? (shape.kind === 'area' ? '6 3' : '')).split(' ').filter(Boolean).map(Number),
  );
  context.beginPath();
  if (shape.kind === 'line' || shape.kind === 'area') {
    shape.points.forEach(([x, y]) => context.lineTo(x, y));
    if (shape.kind === 'area') {
      context.closePath();
      context.globalAlpha = 0.12;
      context.fill();
      context.globalAlpha = 1;
    }
    context.stroke();
  } else if (shape.kind === 'circle') {
    context.arc(...shape.at, shape.radius, 0, 2 * Math.PI);
    context.fillStyle = shape.fill;
    context.fill();
    context.stroke();
  } else if (shape.kind === 'box') {
    context.globalAlpha = shape.faint ? 0.35 : 1;
    context.fillRect(...shape.at, ...shape.size);
  } else {
    context.font = `${shape.size}px system-ui, sans-serif`;
    context.fillText(shape.text, ...shape.at);
  }
}
