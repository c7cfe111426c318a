/** A flight from the side: how high the drone is when, and what its battery has left. */

import { clock, length, number, percent } from '../core/format.js';
import { heightsOf } from '../core/height-profile.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';
import { Facts } from './parts.js';

const WIDTH = 300;
const HEIGHT = 70;
const GROUND = 60;
const TOP = 10;

/** The drawing, and what it shows in words. */
export function HeightProfile({ flight, rules }) {
  const { altitude, lands, corners, visits } = heightsOf(flight, rules);
  const { left, flyer } = flight;
  const full = Math.max(flyer?.energy?.battery_wh ?? 0, ...left.map(({ wh }) => wh));
  const [first, last] = [corners[0].time, corners.at(-1).time];
  const x = (time) => (WIDTH * (time - first)) / Math.max(last - first, 1);
  const y = (height) => GROUND - ((GROUND - TOP) * height) / Math.max(altitude, 1);
  const line = corners.map(({ time, height }) => `${x(time)},${y(height)}`).join(' ');
  const told = {
    height: length(altitude),
    from: clock(first),
    until: clock(last),
    names: visits.map(({ id }) => id).join(', '),
  };
  const words = lands ? t('profile.lands', told) : t('profile.hovers', told);
  return html`<figure class="height-profile">
    <svg viewBox=${`0 0 ${WIDTH} ${HEIGHT}`} width="100%" role="img" aria-label=${words}>
      <line x1="0" x2=${WIDTH} y1=${GROUND} y2=${GROUND} stroke="currentColor" opacity="0.5" />
      ${visits.map(
        ({ id, arrival, departure }) => html`<rect key=${id} x=${x(arrival)} y=${TOP}
          width=${Math.max(x(departure) - x(arrival), 1)} height=${GROUND - TOP}
          fill="currentColor" opacity="0.15"><title>${id}</title></rect>`,
      )}
      <polyline points=${line} fill="none" stroke="currentColor" stroke-width="2" />
      ${left.length > 0 && html`<polyline class="charge" fill="none" stroke-width="1.5"
        points=${left.map(({ time, wh }) =>
          `${x(time)},${GROUND - ((GROUND - TOP) * wh) / full}`).join(' ')} />`}
    </svg>
    <figcaption class="help">${words}</figcaption>
    ${left.length > 0 && html`<h4>${t('profile.left')}</h4>
      <${Facts} facts=${left.map(({ id, wh }, place) => [
        id ?? (place ? t('profile.landing') : t('profile.takeOff')),
        `${t('routes.energy', { energy: number(wh, 1) })} (${percent(wh / full)})`,
      ])} />`}</figure>`;
}
