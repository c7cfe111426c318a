/** Programs that lead to a place; all take latitude before longitude. */

import { t } from './texts.js';

const KEPT = 'tandem-drive-navigator';

export const NAVIGATORS = {
  geo: {
    name: null, // whichever the phone has
    link: (point) => `geo:${point}?q=${point}`,
  },
  google: {
    name: 'Google Maps',
    link: (point) =>
      `https://www.google.com/maps/dir/?api=1&destination=${encodeURIComponent(point)}`,
  },
  apple: {
    name: 'Apple Maps',
    link: (point) => `https://maps.apple.com/?daddr=${encodeURIComponent(point)}`,
  },
  osm: {
    name: 'OpenStreetMap',
    link: (point) => `https://www.openstreetmap.org/directions?to=${encodeURIComponent(point)}`,
  },
};

/** Return what a program is called. */
export function navigatorName(name) {
  return NAVIGATORS[name].name ?? t('page.phone');
}

/** Return a place as people type it, latitude first. */
export function pointText({ latitude, longitude }) {
  return `${latitude},${longitude}`;
}

/** Return the address that has a program lead to a place. */
export function navigation(name, location) {
  return (NAVIGATORS[name] ?? NAVIGATORS.geo).link(pointText(location));
}

/** Return the program that the driver chose; phones of Apple know no `geo:`. */
export function chosenNavigator(storage, agent) {
  const kept = storage.getItem(KEPT);
  if (kept in NAVIGATORS) return kept;
  return /iPhone|iPad|Macintosh/.test(agent) ? 'apple' : 'geo';
}

/** Remember the program that the driver chose. */
export function chooseNavigator(storage, name) {
  storage.setItem(KEPT, name);
}
