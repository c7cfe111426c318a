/** Remedies of the service in the page's language, made of their codes and changes. */

import { t } from '../texts.js';
import { amounts, enough, km, money, number } from './format.js';
import { getIn, parsePath } from './paths.js';
import { partsOf } from './remedies.js';

/**
 * Return a remedy in words; in the service's, English ones, where its code isn't known.
 *
 * @param remedy of a reason
 * @param request that it was told for
 */
export function remedyInWords(remedy, request) {
  const parts = partsOf(remedy).map((part) => partInWords(part, request));
  if (parts.includes('')) return remedy.text;
  const how = parts.join(t('remedy.and'));
  return t(`remedy.${remedy.suffices ? 'fits' : 'helps'}`, { how });
}

/** Return what would have to be otherwise of one limit; empty: that isn't known. */
function partInWords({ code, who, changes: [change] }, request) {
  if (!change) return '';
  const keys = parsePath(change.path);
  const values = { who, ...placeOf(keys, who, request), ...valuesOf(change, getIn(request, keys)) };
  const key = code === 'WINDOW' && values.place ? 'WINDOW_AT' : code;
  return t(`remedy.${key}`, { ...values, defaultValue: '' });
}

/** Return how much more of a limit, how much at least, and what more there would have to be. */
function valuesOf({ by, to }, stated) {
  if (Array.isArray(to)) {
    return typeof to[0] === 'number' ? { amounts: amounts(to) }
      : { what: to.filter((name) => !stated?.includes(name)).join(', ') };
  }
  const least = to ?? stated + by;
  const more = by ?? to - stated;
  return { more: enough(more), moreKm: km(more), least: enough(least), leastKm: km(least),
    number: number(least, 3), count: least, money: money(least) };
}

/** Return which window is meant: of which end of a shipment, at which place, and its number. */
function placeOf(keys, who, request) {
  const { id } = getIn(request, keys.slice(0, 2)) ?? {};
  const [place, part = ''] = who && who !== id ? who.slice(`${id}/`.length).split('/') : [''];
  const position = keys[keys.indexOf('time_windows') + 1];
  return {
    place,
    end: place && [t(`remedy.ends.${place}`, { defaultValue: '' }), part].join(' ').trim(),
    window: keys.includes('time_windows')
      ? t('remedy.windowNumber', { number: Number(position) + 1 }) : t('remedy.window'),
  };
}
