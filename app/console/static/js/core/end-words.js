/** Where a shipment's ends are served, or would be, in words. */

import { clock } from './format.js';
import { t } from '../texts.js';

/** Return where all ends of a shipment come, at what time; null if it is no shipment's place. */
export function endsInWords({ ends = [], position }) {
  if (!ends.length) return null;
  const isAlone = position.own_trip && ends.every((end) => !end.position.recovered_at);
  const told = ends.map((end) => {
    const name = [t(`routes.${end.kind}`), ...(end.part ? [end.part] : [])].join(' ');
    return `${name} ${isAlone ? clock(end.arrival) : spotOf(end)}`;
  }).join('; ');
  return isAlone ? `${t('place.onOwnTrip')}: ${told}` : told;
}

function spotOf({ position, arrival }) {
  const at = clock(arrival);
  return position.recovered_at
    ? t('place.flight', { from: position.after, back: position.recovered_at, at })
    : `${t('place.after', { stop: position.after })}, ${at}`;
}
