/** The timeline: vehicles and drones as rows, linked with the map. */

import { hover, indexOf, select, settledOf, shownPlan } from '../actions.js';
import { describe } from '../core/describe.js';
import { partsOf, spanOf } from '../core/plan.js';
import { ACTIVITIES, idleRows, timelineRows } from '../core/timeline.js';
import { layOut } from '../frame.js';
import { html, useEffect, useLayoutEffect, useMemo, useRef, useState } from '../libraries.js';
import { store, useStore } from '../store.js';
import { Edge } from '../views/edge.js';
import { IconButton } from '../views/icon.js';
import { Menu } from '../views/menu.js';
import { move } from '../views/stop-moves.js';
import { isHere, placeAt } from '../core/moving.js';
import { standingIn } from '../core/replanning.js';
import { AXIS, drawTimeline, heightOf, hit, isNear, placeRows, scaleOf } from './draw.js';
import { Player } from './player.js';
import { t } from '../texts.js';

const NEWS = { new: 'good', moved: 'accent', later: 'warn', late: 'bad', doubt: 'warn' };
const CLOSEST = 300; // seconds
const [LEAST, MOST, AROUND] = [96, 560, 72]; // pixels of the pane, and of it around its rows
const LEAST_DRAG = 4; // pixels, below which it is a click
const REACH = 10; // pixels around the bar of who is selected, since it may be thin

/** The pane below the map. */
export function TimelinePane() {
  const entry = useStore(shownPlan);
  const index = indexOf(entry);
  const rows = useMemo(
    () => (index ? placeRows([...timelineRows(index), ...idleRows(index)]) : []), [index]);
  const whole = useMemo(() => (index ? padded(spanOf(index)) : [0, 3600]), [index]);
  const [range, setRange] = useState(null);
  useEffect(() => setRange(null), [entry?.number]);
  const shown = range ?? whole;
  const request = useStore((state) => state.request);
  const parts = settledOf(entry, request);
  const folded = useStore((state) => state.frame.timelineFolded);
  const most = Math.max(heightOf(rows) + AROUND, LEAST);
  // No higher than its rows: what is above ends there, too.
  useLayoutEffect(() =>
    document.documentElement.style.setProperty('--timeline-rows', `${most}px`), [most]);
  return html`<section class="timeline" aria-label=${t('timeline.title')}>
    ${!folded && html`<${Edge} name="timeline" range=${[LEAST, Math.min(most, MOST)]}
      label=${t('timeline.edge')} upward />`}
    <div class="timeline-bar">
      <${Player} index=${index} />
      <span class="zoom">
        ${!folded && html`<${Menu} id="bars" label=${t('timeline.bars')}>
          <${Legend} isSettled=${parts.size > 0} /></${Menu}>
        <${IconButton} name="plus" label=${t('timeline.zoomIn')}
          onClick=${() => setRange(zoomed(shown, whole, 0.5))} />
        <${IconButton} name="minus" label=${t('timeline.zoomOut')}
          onClick=${() => setRange(zoomed(shown, whole, 2))} />
        <button type="button" class="quiet whole" onClick=${() => setRange(null)}>
          ${t('timeline.whole')}</button>`}
        <${IconButton} name=${folded ? 'chevron-up' : 'chevron-down'}
          label=${folded ? t('timeline.unfold') : t('timeline.fold')}
          onClick=${() => layOut({ timelineFolded: !folded })} />
      </span>
    </div>
    ${!folded && (rows.length
        ? html`<${Rows} index=${index} rows=${rows} range=${shown} whole=${whole}
      setRange=${setRange} parts=${parts} now=${nowOf(entry, request)} />`
        : html`<p class="empty">${entry ? t('timeline.unused') : t('timeline.nothing')}</p>`)
    }
  </section>`;
}

/**
 * @param {Span} span
 * @returns {Span}
 */
function padded([from, until]) {
  const edge = (until - from) * 0.01;
  return [from - edge, until + edge];
}

/** Return a range widened by a factor around an instant, within the whole. */
function zoomed([from, until], whole, factor, around = (from + until) / 2) {
  const width = Math.max((until - from) * factor, CLOSEST);
  if (width >= whole[1] - whole[0]) return null;
  const start = around - ((around - from) / (until - from)) * width;
  return within([start, start + width], whole);
}

function within([from, until], whole) {
  const start = Math.min(Math.max(from, whole[0]), whole[1] - (until - from));
  return [start, start + until - from];
}

/** Return the instant that a plan was, or is to be, gone on from; null if there is none. */
function nowOf(entry, request) {
  const { replan } = request.replan?.plan === entry.plan ? request : entry.request;
  return (entry.replan ?? replan)?.freeze_before ?? null;
}

function Legend({ isSettled }) {
  return html`<ul class="legend" aria-label=${t('timeline.bars')}>${ACTIVITIES.map(
    (kind) =>
      html`<li key=${kind}><span class=${`swatch swatch-${kind}`}></span>
        ${t(`activity.${kind}`)}</li>`,
  )}
    <li><span class="swatch swatch-window"></span>${t('timeline.window')}</li>
    ${isSettled && html`<li><span class="swatch swatch-settled"></span>
      ${t('timeline.settled')}</li>`}</ul>`;
}

function Rows({ index, rows, range, whole, setRange, parts, now }) {
  const box = useRef(null);
  const canvas = useRef(null);
  const state = useRef({});
  Object.assign(state.current, { index, rows, range, whole, setRange, parts, now });
  useLayoutEffect(() => attach(box.current, canvas.current, state), []);
  useEffect(() => state.current.redraw?.());
  return html`<div class="rows" ref=${box}>
    <canvas ref=${canvas} tabindex="0" role="application"
      aria-label=${t('timeline.about')}></canvas>
    <div style=${{ height: `${heightOf(rows) + AXIS}px` }}></div>
  </div>`;
}

/** Draw on changes and react to pointer and keys, until the returned function ends it. */
function attach(box, canvas, state) {
  const context = canvas.getContext('2d');
  let frame = 0;
  const view = () => ({
    width: box.clientWidth, height: box.clientHeight, scroll: box.scrollTop,
    range: state.current.range,
  });
  const draw = () => {
    frame = 0;
    const size = view();
    const ratio = window.devicePixelRatio || 1;
    if (
      canvas.width !== Math.round(size.width * ratio) ||
      canvas.height !== Math.round(size.height * ratio)
    ) {
      canvas.width = Math.round(size.width * ratio);
      canvas.height = Math.round(size.height * ratio);
      canvas.style.width = `${size.width}px`;
      canvas.style.height = `${size.height}px`;
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const { selection, hover: hovered, time, dark, live } = store.get();
    const { index, rows, parts, now } = state.current;
    drawTimeline(context, rows, {
      ...size,
      index,
      parts,
      now,
      drop: state.current.drop,
      selection,
      hover: hovered,
      time,
      dark,
      news: live?.news,
      focus: focusOf(index, hovered ?? selection),
      colours: coloursOf(box),
    });
  };
  const redraw = () => {
    frame ||= requestAnimationFrame(draw);
  };
  state.current.redraw = redraw;
  const stop = [
    store.subscribe(redraw),
    listen(box, 'scroll', redraw),
    ...pointer(box, canvas, state, view),
    listen(canvas, 'keydown', (event) => onKey(event, state))];
  const resizes = new ResizeObserver(redraw);
  resizes.observe(box);
  document.fonts.ready.then(redraw);
  draw();
  return () => {
    cancelAnimationFrame(frame);
    resizes.disconnect();
    stop.forEach((end) => end());
  };
}

/** Return a key if there is something of that name in the plan. */
function focusOf(index, key) {
  return partsOf(index, key).vehicle ? key : null;
}

function listen(target, name, listener, options) {
  target.addEventListener(name, listener, options);
  return () => target.removeEventListener(name, listener, options);
}

function coloursOf(element) {
  const style = getComputedStyle(element);
  const value = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    text: value('text-1'),
    faint: value('text-2'),
    grid: value('line'),
    wait: value('wait'),
    window: value('window'),
    windowLine: value('window-line'),
    closed: value('surface-0'),
    late: value('bad'),
    accent: value('accent'),
    ...Object.fromEntries(Object.entries(NEWS).map(([kind, name]) => [kind, value(name)])),
    font: `12px ${style.fontFamily}`,
    smallFont: `11px ${style.fontFamily}`,
  };
}

function pointer(box, canvas, state, view) {
  let drag = null;
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  };
  const keyAt = (event) => {
    const { row, bar, onLabel } = hit(state.current.rows, place(event), view());
    if (!row) return null;
    return onLabel ? (row.vehicle?.key ?? null) : (bar?.key ?? null);
  };
  /** Return who is selected, if at a pointer and free to be put elsewhere: others are panned. */
  const haltAt = (event) => {
    const { index, parts, rows } = state.current;
    const { selection } = store.get();
    const { halt } = partsOf(index, selection);
    if (halt?.kind !== 'customer' || standingIn(parts, halt) === 'settled') return null;
    return isNear(rows, selection, place(event), view(), REACH) ? halt : null;
  };
  /** Return where who is dragged would come: `{row, time, place}`; null: nowhere new. */
  const dropAt = (event) => {
    const { rows, range } = state.current;
    const { row } = hit(rows, place(event), view());
    if (!row) return null;
    const time = scaleOf(range, view().width).time(place(event).x);
    if (row.kind === 'idle') return { row, time, place: { vehicle: row.name, type: row.type.id } };
    const found = placeAt(row.vehicle, time, drag.halt);
    return found && !isHere(drag.halt, found) ? { row, time, place: found } : null;
  };
  const show = (drop) => {
    state.current.drop = drop;
    state.current.redraw();
  };
  return [
    listen(canvas, 'pointerdown', (event) => {
      const halt = haltAt(event);
      drag = { x: event.clientX, y: event.clientY, range: state.current.range, moved: false, halt };
      canvas.setPointerCapture(event.pointerId);
    }),
    listen(canvas, 'pointermove', (event) => {
      if (!drag) {
        const key = keyAt(event);
        hover(key);
        canvas.style.cursor = haltAt(event) ? 'grab' : key ? 'pointer' : '';
        canvas.title = tipOf(state.current.index, key);
        return;
      }
      if (drag.halt) {
        drag.moved ||= Math.hypot(event.clientX - drag.x, event.clientY - drag.y) > LEAST_DRAG;
        if (drag.moved) show(dropAt(event));
        return;
      }
      const scale = scaleOf(drag.range, view().width);
      const shift = scale.time(0) - scale.time(event.clientX - drag.x);
      drag.moved ||= Math.abs(event.clientX - drag.x) > LEAST_DRAG;
      const { whole, setRange } = state.current;
      if (drag.moved) setRange(within(drag.range.map((time) => time + shift), whole));
    }),
    listen(canvas, 'pointerup', (event) => {
      if (drag?.halt && drag.moved) show(dropAt(event));
      if (drag && !drag.moved) select(keyAt(event));
      const { drop, index } = state.current;
      const { halt } = drag ?? {};
      drag = null;
      show(null);
      if (halt && drop) move(index, halt.id, drop.place);
    }),
    listen(canvas, 'pointercancel', () => {
      drag = null;
      show(null);
    }),
    listen(canvas, 'pointerleave', () => hover(null)),
    listen(canvas, 'wheel', (event) => {
      if (!event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const { range, whole, setRange } = state.current;
      const around = scaleOf(range, view().width).time(place(event).x);
      setRange(zoomed(range, whole, event.deltaY + event.deltaX > 0 ? 1.25 : 0.8, around));
    }, { passive: false })];
}

function tipOf(index, key) {
  const about = describe(index.request, index, key);
  return about ? [about.title, ...about.facts.map((pair) => pair.join(': '))].join('\n') : '';
}

/** Move the selection from stop to stop and from vehicle to vehicle. */
function onKey(event, state) {
  const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[
    event.key];
  if (!step) return;
  event.preventDefault();
  const { index } = state.current;
  const { vehicle, halt } = partsOf(index, store.get().selection);
  const number = Math.min(Math.max((vehicle?.index ?? 0) + step[0], 0), index.vehicles.length - 1);
  const halts = haltsOf(index.vehicles[number]);
  if (step[0] && halt) {
    const near = halts.reduce((best, other) =>
      Math.abs(other.arrival - halt.arrival) < Math.abs(best.arrival - halt.arrival) ? other : best,
    );
    select(near.key);
    return;
  }
  const position = halt ? halts.indexOf(halt) + step[1] : 0;
  select(halts[Math.min(Math.max(position, 0), halts.length - 1)].key);
}

function haltsOf(vehicle) {
  const halts = vehicle.trips.flatMap((trip) => [
    ...trip.stops,
    ...trip.sorties.flatMap((sortie) => sortie.visits)]);
  return halts.sort((first, second) => first.arrival - second.arrival);
}
