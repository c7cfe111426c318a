/** What is under the plan: the world's coasts and borders, streets of extracts, or tiles. */

import { leaflet } from '../libraries.js';
import { StreetNames } from './street-names.js';
import { StreetsLayer } from './streets.js';

const L = leaflet();

/** Zooms of the tiles of the ground; the last are enlarged as far as one can look. */
const OF_GROUND = { zooms: [1, 3, 5], minZoom: 2 };

/** Return the layers under the plan: tiles of a server, or streets of the service's extracts. */
export function groundsOf(config, asksServer, keptClear) {
  const tiles = tilesOf(config, asksServer);
  if (tiles) {
    const attribution = asText(tiles.attribution);
    // Public servers want to know which page asks.
    return [L.tileLayer(tiles.url, { attribution, maxZoom: 20, referrerPolicy: 'origin' })];
  }
  const attribution = asText(config.streets_attribution);
  const layers = [
    ...(config.ground ? [new StreetsLayer(config.ground, OF_GROUND)] : []),
    ...config.streets.map((extract) => new StreetsLayer(extract, { attribution }))];
  return layers.flatMap((layer) => [layer, new StreetNames(layer, keptClear)]);
}

/** Return the tiles that a service shows at once, or that its user has asked for, if any. */
function tilesOf({ tile_url: url, tile_attribution: attribution, public_tiles: shared }, asked) {
  return url ? { url, attribution } : asked && shared;
}

function asText(text) {
  const element = document.createElement('span');
  element.textContent = text;
  return element.innerHTML;
}
