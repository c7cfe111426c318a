/** A sortie from the side: how high its drone is when. */

import { clock, length } from '../core/format.js';
import { heightsOf } from '../core/height-profile.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';

const WIDTH = 300;
const HEIGHT = 70;
const GROUND = 60;
const TOP = 10;

/** The drawing, and what it shows in words. */
export function HeightProfile({ sortie, rules }) {
  const { altitude, lands, corners, visits } = heightsOf(sortie, rules);
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
    </svg>
    <figcaption class="help">${words}</figcaption></figure>`;
}
