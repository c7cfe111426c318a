/** Places in a problem as dispatchers call them: `Vehicle type van › Profile`. */

import { t } from '../texts.js';
import { getIn } from './paths.js';
import { labelOf } from './schema.js';

const BETWEEN = ' \u203a ';

/** Lists whose entries are called by their own names. */
const NAMED = {
  customers: 'customer', fleet: 'type', depots: 'depot', launch_sites: 'launchSite',
  shipments: 'shipment',
};

/** Lists of a plan, and of what is said of one, whose entries are called by numbers or names. */
const NUMBERED = {
  routes: (entry) => t('where.route', { vehicle: entry?.vehicle ?? '' }),
  trips: (_, number) => t('where.trip', { number }),
  stops: (entry, number) => t('where.stop', { number, id: entry?.id ?? '' }),
  sorties: (_, number) => t('where.flight', { number }),
  no_fly: (_, number) => t('where.area', { number }),
  time_windows: (_, number) => t('where.window', { number }),
  pinned: (entry) => t('where.pinned', { id: entry ?? '' }),
  unavailable: (entry) => t('where.unavailable', { vehicle: entry ?? '' }),
};

/** Parts that only hold others: what is in them says where it is. */
const HOLDERS = new Set(['replan', 'airspace', 'plan', 'problem']);

/**
 * Return a place in words.
 *
 * @param request that has the place
 * @param keys of the place, as `parsePath` returns them; none: all of it
 */
export function whereInWords(request, keys) {
  const parts = [];
  for (let at = 0; at < keys.length; at += 1) {
    const [key, next] = [keys[at], keys[at + 1]];
    if (typeof next === 'number') {
      parts.push(entryInWords(request, keys.slice(0, at + 2)));
      at += 1;
    } else if (!HOLDERS.has(key) || at === keys.length - 1) {
      parts.push(typeof key === 'number' ? String(key + 1) : labelOf(key));
    }
  }
  return parts.join(BETWEEN) || t('where.problem');
}

/** Return what an entry of a list is called. */
function entryInWords(request, keys) {
  const [list, index] = keys.slice(-2);
  const entry = getIn(request, keys);
  if (keys.length === 2 && list in NAMED) {
    return t(`where.${NAMED[list]}`, { id: entry?.id || String(index + 1) });
  }
  if (list in NUMBERED) return NUMBERED[list](entry, index + 1).trim();
  return t('where.entry', { list: labelOf(list), number: index + 1 });
}
