/** Programs that lead to a place; all take latitude before longitude. */

import { t } from './texts.js';

const KEPT = 'tandem-drive-navigator';

const GOOGLE = { tolls: 'tolls', motorways: 'highways', ferries: 'ferries' };

export const NAVIGATORS = {
  geo: {
    name: null, // whichever the phone has
    link: (point) => `geo:${point}?q=${point}`,
  },
  google: {
    name: 'Google Maps',
    link: (point, avoid) =>
      `https://www.google.com/maps/dir/?api=1&destination=${encodeURIComponent(point)}` +
      (avoid.length ? `&travelmode=driving&avoid=${avoid.map((kind) => GOOGLE[kind])}` : ''),
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

/** Return the address that has a program lead to a step's place; Google's keeps off what it avoids. */
export function navigation(name, { location, avoid = [] }) {
  return (NAVIGATORS[name] ?? NAVIGATORS.geo).link(pointText(location), avoid);
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
