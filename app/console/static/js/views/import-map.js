/** Where an import's customers are; depot and addresses that nobody finds are put there by hand. */

import { parseNumber } from '../core/format.js';
import { boundsOf } from '../core/geometry.js';
import { addressesIn, byAddress, unplacedIn } from '../core/importing.js';
import { placeOf, withFound } from '../core/places.js';
import { leaveUnplaced, place, placeAt } from '../importing.js';
import { html, useEffect, useLayoutEffect, useMemo, useRef, useState } from '../libraries.js';
import { MapView } from '../map/view.js';
import { store, useStore } from '../store.js';
import { t } from '../texts.js';

const NOTHING = { coordinate_system: 'geographic', depots: [], customers: [], fleet: [] };
const FAR = 4; // zoom of a map that has nothing to show
const MIDDLE = [50, 10];

/** The map, and beside it what can be put there. */
export function ImportMap({ importing }) {
  const { reply, placing, places, leavesUnplaced } = importing;
  const finds = useStore((state) => state.config.finds_addresses);
  const request = reply.request ?? NOTHING;
  const addresses = addressesIn(request);
  const open = unplacedIn(request, places).length;
  return html`<section class="import-map" aria-label=${t('import.map')}>
    <${Ground} key=${request.coordinate_system} request=${request} places=${places}
      isPlacing=${placing !== null} />
    <div><p class="help" aria-live="polite">${hintOf(placing)}</p>
      <button type="button" class="depot-button" aria-pressed=${placing === 'depot'}
        onClick=${() => place(placing === 'depot' ? null : 'depot')}>${t('import.putDepot')}
      </button>
      ${placing && placing !== 'depot' && html`<${Typed} key=${placing.address}
        address=${placing.address} />`}
      ${addresses.length > 0 &&
        html`<p><strong>${t('import.unplaced', { count: open })}</strong></p>
        <ul>${addresses.map((entry) => html`<${Address} key=${entry.address} ...${entry}
          isPlaced=${Boolean(places[entry.address])}
          isActive=${placing?.address === entry.address} />`)}</ul>
        ${open > 0 &&
          !finds && html`<label class="check"><input type="checkbox" checked=${leavesUnplaced}
            onChange=${(event) => leaveUnplaced(event.target.checked)} />
            ${t('import.leaveUnplaced')}</label>`}`
      }</div></section>`;
}

function hintOf(placing) {
  if (placing === null) return t('import.mapHelp');
  if (placing === 'depot') return t('import.clickDepot');
  return t('import.clickAddress', { address: placing.address });
}

function Address({ address, ids, isPlaced, isActive }) {
  return html`<li><button type="button" aria-pressed=${isActive}
    onClick=${() => place(isActive ? null : { address })}><strong>${ids.join(', ')}</strong>
    ${` ${address}`}${isPlaced && html` <small>${t('import.placed')}</small>`}</button></li>`;
}

/** A place as coordinates, for whoever has them from elsewhere, or uses no mouse. */
function Typed({ address }) {
  const [isWrong, setWrong] = useState(false);
  const take = (event) => {
    const [lat, lon, ...more] = event.target.value.split(/[\s,;]+/).map(parseNumber);
    const isNumbers = !more.length && Number.isFinite(lat) && Number.isFinite(lon);
    const isPlace = isNumbers && Math.abs(lat) <= 90 && Math.abs(lon) <= 180;
    setWrong(!isPlace);
    if (isPlace) placeAt([lon, lat]);
  };
  return html`<label>${t('import.typePlace')}<input type="text" id="import-place"
    placeholder=${t('import.help.depot')} aria-invalid=${isWrong} aria-description=${address}
    onChange=${take} /></label>`;
}

function Ground({ request, places, isPlacing }) {
  const element = useRef(null);
  const [view, setView] = useState(null);
  const dark = useStore((state) => state.dark);
  const config = useStore((state) => state.config);
  const shown = useMemo(() => withFound(request, byAddress(places)).request, [request, places]);
  useLayoutEffect(() => {
    const geographic = request.coordinate_system === 'geographic';
    const made = new MapView(element.current, {
      geographic, config, planarUnit: request.planar_unit ?? 1,
      onHover: () => {}, onSelect: () => {},
    });
    made.setGround(store.get().frame.tiles);
    made.onGround = placeAt;
    made.onSelect = (_, point) => placeAt(point);
    setView(made);
    return () => made.destroy();
  }, []);
  useEffect(() => view?.shade(dark), [view, dark]);
  const seen = String(boundsOf(placesIn(request)));
  useEffect(() => view && lookAt(view, request, config), [view, seen]);
  useEffect(() => view?.draw(shown, null, new Map(), dark), [view, shown, dark]);
  return html`<div class=${`map ${isPlacing ? 'drawing' : ''}`} ref=${element}
    role="application" aria-label=${t('import.map')}></div>`;
}

/** Return where customers are, and both ends of shipments. */
function placesIn({ customers, shipments = [] }) {
  const ends = shipments.flatMap(({ pickup, pickups, delivery }) => [
    ...(pickups ?? [pickup]), delivery]);
  return [...customers, ...ends].map(placeOf).filter(Boolean);
}

/** Show all places of a request, else the first streets that there are. */
function lookAt(view, request, { streets }) {
  view.map.invalidateSize({ animate: false });
  if (placesIn(request).length) {
    view.fit(request);
  } else if (streets.length) {
    const [west, south, east, north] = streets[0].bounds;
    const corners = [
      [south, west],
      [north, east]];
    view.map.fitBounds(corners, { animate: false });
  } else view.map.setView(MIDDLE, FAR, { animate: false });
}
