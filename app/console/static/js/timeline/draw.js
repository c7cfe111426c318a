/** Draws rows of bars into a canvas, and finds what lies at a point of it. */

import { clock, firstHour } from '../core/format.js';
import { contains, partsOf } from '../core/plan.js';
import { vehicleColour } from '../core/palette.js';
import { standingIn } from '../core/replanning.js';
import { closedOf, rowWindows, tickStep } from '../core/timeline.js';

export const AXIS = 20;
const HEIGHTS = { vehicle: 24, drone: 16, idle: 24 };
const TICK_PIXELS = 70;
const KEPT_END = 3; // characters of a long name

/** How much of its strength a bar keeps. */
const STANDINGS = { settled: 0.4, lost: 0.8 };

/** Return rows with their place from the top: `{...row, top, height, windows}`. */
export function placeRows(rows) {
  let top = 0;
  return rows.map((row) => {
    const placed = { ...row, top, height: HEIGHTS[row.kind], windows: rowWindows(row) };
    top += placed.height;
    return placed;
  });
}

/** Return the height of placed rows. */
export function heightOf(rows) {
  const last = rows[rows.length - 1];
  return last ? last.top + last.height : 0;
}

/** Return the width of the labels for a canvas of a width. */
export function gutterOf(width) {
  return width < 480 ? 92 : 132;
}

/** Return functions between instants and pixels. */
export function scaleOf(range, width) {
  const gutter = gutterOf(width);
  const perSecond = (width - gutter - 12) / (range[1] - range[0]);
  return {
    x: (time) => gutter + (time - range[0]) * perSecond,
    time: (x) => range[0] + (x - gutter) / perSecond,
  };
}

/** Return the row and bar at a point, `scroll` pixels down; either may be missing. */
export function hit(rows, { x, y }, { range, width, scroll }) {
  const below = y - AXIS + scroll;
  const row =
    y < AXIS ? undefined : rows.find(({ top, height }) => below >= top && below < top + height);
  if (!row) return {};
  const scale = scaleOf(range, width);
  const bars = row.bars.filter((bar) => x >= scale.x(bar.from) - 2 && x <= scale.x(bar.until) + 2);
  const bar = bars.find(({ key }) => key[0] === 'c') ?? bars[0];
  return { row, bar, onLabel: x < gutterOf(width) };
}

/** Tell whether a point is on a bar of what a key names, or at most so many pixels beside it. */
export function isNear(rows, key, { x, y }, { range, width, scroll }, reach) {
  const scale = scaleOf(range, width);
  const below = y - AXIS + scroll;
  return rows.some(({ top, height, bars }) => below >= top && below < top + height
    && bars.some((bar) => bar.key === key
      && x >= scale.x(bar.from) - reach && x <= scale.x(bar.until) + reach));
}

/** Draw everything. `view` holds size, range, scroll, marks, time and colours. */
export function drawTimeline(context, rows, view) {
  const { width, height, scroll } = view;
  context.clearRect(0, 0, width, height);
  const scale = scaleOf(view.range, width);
  drawAxis(context, scale, view);
  context.save();
  context.beginPath();
  context.rect(0, AXIS, width, height - AXIS);
  context.clip();
  context.translate(0, AXIS - scroll);
  const seen = rows.filter(
    ({ top, height: size }) => top + size >= scroll && top <= scroll + height);
  for (const row of seen) drawRow(context, row, scale, view);
  if (view.drop) drawDrop(context, view.drop, scale, view);
  context.restore();
  const { now, time, colours } = view;
  // From when on things may change, and the clock.
  drawInstant(context, now, scale, view, { colour: colours.text, lineWidth: 1.5, dash: [4, 3] });
  drawInstant(context, time, scale, view, { colour: colours.accent, lineWidth: 2, dash: [] });
}

/** Mark the row and the instant where what is dragged would come. */
function drawDrop(context, { row, time }, scale, { width, colours }) {
  context.globalAlpha = 0.15;
  context.fillStyle = colours.accent;
  context.fillRect(0, row.top, width, row.height);
  context.globalAlpha = 1;
  context.fillRect(scale.x(time) - 1, row.top, 2, row.height);
}

function drawAxis(context, scale, { range, width, height, colours }) {
  const gutter = gutterOf(width);
  const step = tickStep(range[1] - range[0], (width - gutter) / TICK_PIXELS);
  context.font = colours.font;
  context.textBaseline = 'middle';
  context.textAlign = 'center';
  const first = firstHour();
  let time = first + Math.ceil((range[0] - first) / step) * step;
  for (; time <= range[1]; time += step) {
    const x = Math.round(scale.x(time)) + 0.5;
    context.strokeStyle = colours.grid;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x, AXIS);
    context.lineTo(x, height);
    context.stroke();
    context.fillStyle = colours.faint;
    if (x < width - 14) context.fillText(clock(time), x, AXIS / 2 + 1);
  }
}

function drawRow(context, row, scale, view) {
  const { width, colours } = view;
  const gutter = gutterOf(width);
  const dimmed = view.focus && (row.kind === 'idle' || (
    !contains(view.index, view.focus, row.vehicle.key) &&
    !contains(view.index, row.vehicle.key, view.focus)));
  context.globalAlpha = dimmed ? 0.3 : 1;
  context.save();
  context.beginPath();
  context.rect(gutter, row.top, width - gutter, row.height);
  context.clip();
  drawClosed(context, row, scale, view);
  for (const mark of row.windows) drawWindow(context, row, mark, scale, view);
  for (const bar of row.bars) drawBar(context, row, bar, scale, view);
  context.restore();
  drawLabel(context, row, gutter, view);
  context.strokeStyle = colours.grid;
  if (row.kind !== 'drone') {
    context.beginPath();
    context.moveTo(0, row.top + 0.5);
    context.lineTo(width, row.top + 0.5);
    context.stroke();
  }
  context.globalAlpha = 1;
}

/** Darken when the vehicle of a row doesn't work, and when its depot is closed. */
function drawClosed(context, row, scale, { index, range, width, colours }) {
  context.fillStyle = colours.closed;
  for (const [from, until] of closedOf(row, index.request, range)) {
    const end = until === range[1] ? width : scale.x(until);
    context.fillRect(scale.x(from), row.top, end - scale.x(from), row.height);
  }
}

function drawLabel(context, row, gutter, { colours, dark }) {
  const middle = row.top + row.height / 2 + 1;
  context.textAlign = 'left';
  context.font = row.kind === 'drone' ? colours.smallFont : colours.font;
  if (row.kind === 'vehicle') {
    context.fillStyle = vehicleColour(row.vehicle.number, dark);
    context.fillRect(6, row.top + 6, 4, row.height - 12);
  }
  context.fillStyle = row.kind === 'vehicle' ? colours.text : colours.faint;
  context.fillText(
    shortened(context, row.label, gutter - 24),
    row.kind === 'drone' ? 24 : 16,
    middle);
}

function shortened(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  // The end is kept, since it has the vehicle's number.
  const end = text.slice(-KEPT_END);
  let start = text.slice(0, -KEPT_END);
  while (start.length > 1 && context.measureText(`${start}\u2026${end}`).width > width)
    start = start.slice(0, -1);
  return `${start}\u2026${end}`;
}

/** Draw a window as a line under the bars with a post at each end that is not open. */
function drawWindow(context, row, mark, scale, { selection, hover, colours, range }) {
  const strong = mark.key === selection || mark.key === hover;
  const y = row.top + row.height - 2.5;
  const from = scale.x(Math.max(mark.earliest, range[0]));
  const until = scale.x(Math.min(mark.latest ?? range[1], range[1]));
  if (strong) {
    context.fillStyle = colours.window;
    context.fillRect(from, row.top + 1, until - from, row.height - 2);
  }
  context.strokeStyle = mark.late ? colours.late : colours.windowLine;
  context.globalAlpha *= strong ? 1 : 0.45;
  context.lineWidth = strong ? 2 : 1;
  context.beginPath();
  context.moveTo(from, y);
  context.lineTo(until, y);
  for (const [x, isOpen] of [[from, mark.earliest <= 0], [until, mark.latest === null]]) {
    if (!isOpen) {
      context.moveTo(x, y + 1);
      context.lineTo(x, y - (strong ? row.height - 5 : 4));
    }
  }
  context.stroke();
  context.globalAlpha /= strong ? 1 : 0.45;
}

function drawBar(context, row, bar, scale, view) {
  const { colours, dark, selection, hover } = view;
  const standing = standingOfBar(view, bar);
  const colour = standing === 'lost' ? colours.late : vehicleColour(row.vehicle.number, dark);
  const alpha = context.globalAlpha;
  if (standing !== 'open') context.globalAlpha *= STANDINGS[standing];
  const x = scale.x(bar.from);
  const width = Math.max(scale.x(bar.until) - x, bar.kind === 'serve' ? 2 : 1);
  const box = boxOf(row, bar.kind);
  if (['wait', 'reload', 'charge', 'rest'].includes(bar.kind)) {
    hatch(context, { x, width, ...box }, { wait: colours.wait, charge: colour }[bar.kind]
      ?? colours.faint);
  } else {
    context.fillStyle = colour;
    context.globalAlpha *= { drive: 0.45, fly: 0.55, handle: 0.28, serve: 1 }[bar.kind];
    context.fillRect(x, box.y, width, box.height);
  }
  context.globalAlpha = alpha;
  const said = bar.kind === 'serve' && view.news?.get(bar.key);
  if (said) {
    context.fillStyle = colours[said.kind];
    context.fillRect(x - 1, row.top, Math.max(width, 4) + 2, 4);
  }
  if ([selection, hover].includes(bar.key) && bar.key[0] !== 'v') {
    context.strokeStyle = colours.text;
    context.lineWidth = 1.5;
    context.strokeRect(x - 0.5, box.y - 1.5, width + 1, box.height + 3);
  }
}

function standingOfBar({ index, parts }, bar) {
  const what = partsOf(index, bar.to ?? bar.key);
  return what.halt || what.sortie ? standingIn(parts, what.halt ?? what.sortie) : 'open';
}

function boxOf(row, kind) {
  const inner = row.height - 9;
  const y = row.top + 3;
  if (kind === 'drive' || kind === 'fly') {
    return { y: y + inner / 2 - (kind === 'drive' ? 2.5 : 1.5), height: kind === 'drive' ? 5 : 3 };
  }
  return { y, height: inner };
}

function hatch(context, { x, y, width, height }, colour) {
  context.save();
  context.beginPath();
  context.rect(x, y, width, height);
  context.clip();
  context.strokeStyle = colour;
  context.lineWidth = 1;
  context.beginPath();
  for (let start = x - height; start < x + width; start += 4) {
    context.moveTo(start, y + height);
    context.lineTo(start + height, y);
  }
  context.stroke();
  context.restore();
  context.strokeStyle = colour;
  context.lineWidth = 1;
  context.strokeRect(x + 0.5, y + 0.5, Math.max(width - 1, 0.5), height - 1);
}

/** Draw an instant, unless it is null or not seen, as a line from top to bottom. */
function drawInstant(context, time, scale, { width, height }, { colour, lineWidth, dash }) {
  const x = time === null ? -1 : scale.x(time);
  if (x < gutterOf(width) || x > width) return;
  Object.assign(context, { strokeStyle: colour, lineWidth });
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(x, 0);
  context.lineTo(x, height);
  context.stroke();
  context.setLineDash([]);
}
