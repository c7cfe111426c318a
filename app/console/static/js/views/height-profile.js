/** A flight from the side: how high the drone is when, and what its battery has left. */

import { clock, length, number, percent } from '../core/format.js';
import { heightsOf } from '../core/height-profile.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';
import { Facts } from './parts.js';

const [LEFT, RIGHT, TOP, GROUND, HEIGHT] = [44, 284, 10, 76, 96];

/** The drawing, and what it shows in words. */
export function HeightProfile({ flight, rules, ground }) {
  const { altitude, lands, corners, visits } = heightsOf(flight, rules);
  const { left, flyer } = flight;
  const battery = flyer?.energy?.battery_wh ?? 0;
  const full = Math.max(battery, ...left.map(({ wh }) => wh));
  const [first, last] = [corners[0].time, corners.at(-1).time];
  const x = (time) => LEFT + ((RIGHT - LEFT) * (time - first)) / Math.max(last - first, 1);
  const y = (share) => GROUND - (GROUND - TOP) * share;
  const line = (points) => points.map(([time, share]) => `${x(time)},${y(share)}`).join(' ');
  const told = {
    height: length(altitude),
    from: clock(first),
    until: clock(last),
    names: visits.map(({ id }) => id).join(', '),
  };
  const words = lands ? t('profile.lands', told) : t('profile.hovers', told);
  const reserve = left.length > 0 && (flyer?.energy?.reserve ?? 0) * battery / full;
  const heights = [0, 0.5, 1].map((share) => ({ share, text: length(altitude * share) }));
  return html`<figure class="height-profile">
    <svg viewBox=${`0 0 340 ${HEIGHT}`} width="100%" role="img" aria-label=${words}>
      ${heights.map(({ share, text }) => html`<g key=${share}>
        <line x1=${LEFT} x2=${RIGHT} y1=${y(share)} y2=${y(share)} class="tick" />
        <text x=${LEFT - 4} y=${y(share) + 3} text-anchor="end">${text}</text>
        ${left.length > 0 && html`<text x=${RIGHT + 4} y=${y(share) + 3} class="charge-text">${
          percent(share)}</text>`}</g>`)}
      <text x=${LEFT} y=${HEIGHT - 4}>${told.from}</text>
      <text x=${RIGHT} y=${HEIGHT - 4} text-anchor="end">${told.until}</text>
      ${visits.map(({ id, arrival, departure }) => html`<rect key=${id} x=${x(arrival)} y=${TOP}
          width=${Math.max(x(departure) - x(arrival), 1)} height=${GROUND - TOP}
          fill="currentColor" opacity="0.15"><title>${id}</title></rect>`)}
      <polyline points=${line(corners.map(({ time, height }) =>
        [time, height / Math.max(altitude, 1)]))} fill="none" stroke="currentColor"
        stroke-width="2" />
      ${left.length > 0 && html`<polyline class="charge" fill="none" stroke-width="1.5"
        points=${line(left.map(({ time, wh }) => [time, wh / full]))} />`}
      ${reserve > 0 && html`<line x1=${LEFT} x2=${RIGHT} y1=${y(reserve)} y2=${y(reserve)}
        class="reserve" /><text x=${RIGHT - 2} y=${y(reserve) - 3} text-anchor="end"
        class="reserve">${t('profile.reserve')}</text>`}
    </svg>
    <figcaption class="help">${words} ${t('profile.axes')} ${ground && t('profile.ground', {
      lowest: length(ground.lowest), highest: length(ground.highest) })}</figcaption>
    ${left.length > 0 && html`<h4>${t('profile.left')}</h4>
      <${Facts} facts=${left.map(({ id, wh }, place) => [
        id ?? (place ? t('profile.landing') : t('profile.takeOff')),
        `${t('routes.energy', { energy: number(wh, 1) })} (${percent(wh / full)})`,
      ])} />`}</figure>`;
}
