/** The clock of the day: play, stop, and go to any instant. */

import { clock } from '../core/format.js';
import { replanFromClock } from '../ordering.js';
import { spanOf } from '../core/plan.js';
import { html, useEffect } from '../libraries.js';
import { store, useStore } from '../store.js';
import { Icon } from '../views/icon.js';
import { t } from '../texts.js';

const SPEEDS = [60, 300, 600, 1800, 3600];

/** Start or pause the clock of a plan. */
export function togglePlaying(index) {
  if (!index) return;
  const [start, end] = spanOf(index);
  store.set(({ playing, time }) =>
    playing
      ? { playing: false }
      : { playing: true, time: time === null || time >= end ? start : time });
}

/** Move the clock while it runs; returns a function that ends it. */
function run(index) {
  const [, end] = spanOf(index);
  let last = performance.now();
  let frame = requestAnimationFrame(function tick(now) {
    const { time, speed } = store.get();
    const next = time + ((now - last) / 1000) * speed;
    last = now;
    store.set(next >= end ? { time: end, playing: false } : { time: next });
    frame = requestAnimationFrame(tick);
  });
  return () => cancelAnimationFrame(frame);
}

/** The controls of the clock. */
export function Player({ index }) {
  const playing = useStore((state) => state.playing);
  const time = useStore((state) => state.time);
  const speed = useStore((state) => state.speed);
  const isLive = useStore((state) => state.live !== null);
  useEffect(() => (playing && index ? run(index) : undefined), [playing, index]);
  const [start, end] = index ? spanOf(index) : [0, 3600];
  return html`<div class="player">
    <button type="button" disabled=${!index} onClick=${() => togglePlaying(index)}
      aria-pressed=${playing} aria-label=${playing ? t('player.pause') : t('player.play')}>
      <${Icon} name=${playing ? 'pause' : 'play'} /> <span class="word">${
        playing ? t('player.pause') : t('player.play')}</span></button>
    <input type="range" min=${start} max=${end} step="10" value=${time ?? start} disabled=${!index}
      aria-label=${t('player.time')} aria-valuetext=${clock(time ?? start)}
      onInput=${(event) => store.set({ time: Number(event.target.value), playing: false })} />
    <output class="clock">${clock(time ?? start)}</output>
    <select class="speed" aria-label=${t('player.speed')} value=${speed}
      onChange=${(event) => store.set({ speed: Number(event.target.value) })}>
      ${SPEEDS.map((value) => html`<option key=${value}
        value=${value}>${value / 60} min/s</option>`)}
    </select>
    ${time !== null && html`${!isLive && html`<button type="button" onClick=${replanFromClock}>
        ${t('player.replan')}</button>`}
      <button type="button" class="quiet"
        onClick=${() => store.set({ time: null, playing: false })}>${t('player.end')}</button>`}
  </div>`;
}
