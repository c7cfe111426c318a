/** The flights of a vehicle's drones, as files for what flies them. */

import { t } from './texts.js';

const KEPT = 'tandem-drive-flights';
const KEPT_MS = 10000;

/** Formats by what they are called. */
export const FORMATS = {
  'qgc-plan': 'QGroundControl',
  'qgc-wpl': 'MAVLink (QGC WPL 110)',
  kml: 'KML',
  'dji-wpml': 'DJI WPML',
  geojson: 'GeoJSON',
};

/** Return the format that the driver chose. */
export function chosenFormat(storage) {
  const kept = storage.getItem(KEPT);
  return kept in FORMATS ? kept : 'qgc-plan';
}

/** Remember the format that the driver chose. */
export function chooseFormat(storage, format) {
  storage.setItem(KEPT, format);
}

/** Ask for the flights and save them; return what went wrong, or nothing. */
export async function saveFlights(token, format) {
  const headers = { Authorization: `Bearer ${token}` };
  let reply;
  try {
    reply = await fetch(`flights?format=${format}`, {
      headers,
      cache: 'no-store',
      referrerPolicy: 'no-referrer',
    });
  } catch {
    return t('flights.offline');
  }
  if (reply.status === 422) return t('flights.refused');
  if (!reply.ok) return t('flights.offline');
  const [, name] = /filename="(.+)"/.exec(reply.headers.get('content-disposition')) ?? [];
  const address = URL.createObjectURL(await reply.blob());
  const link = document.createElement('a');
  Object.assign(link, { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), KEPT_MS);
  return '';
}
