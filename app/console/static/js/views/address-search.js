/** Addresses: a search for one, and customers whose place is doubtful, to be put right. */

import {
  addAt, beginPlacing, find, leaveOutUnplaced, putAt, putDepotAt, settle,
} from '../addressing.js';
import { select, showFailure } from '../actions.js';
import { candidateInWords, doubtedPlaces } from '../core/places.js';
import { html, useEffect, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';

/** A field for an address, and what can be done with the places that are found. */
export function AddressSearch({ request }) {
  const finds = useStore((state) => state.config.finds_addresses);
  const selection = useStore((state) => state.selection);
  const [text, setText] = useState('');
  const [found, setFound] = useState(null); // {address, places, doubt}
  if (!finds || request.coordinate_system !== 'geographic') return null;
  const id = selection?.startsWith('c:') ? selection.slice(2) : null;
  const search = async (event) => {
    event.preventDefault();
    const address = text.trim();
    if (!address) return;
    try {
      setFound({ address, ...(await find(address)) });
    } catch (error) {
      showFailure(error);
    }
  };
  const done = (act) => () => {
    act();
    setFound(null);
    setText('');
  };
  return html`<section class="section"><form class="buttons" role="search" onSubmit=${search}>
      <input type="text" id="address-search" value=${text} placeholder=${t('places.find')}
        aria-label=${t('places.find')} onInput=${(event) => setText(event.target.value)} />
      <button type="submit">${t('places.search')}</button></form>
    <div aria-live="polite">${found && !found.places.length && html`<p class="help">
      ${t('places.notFound', { address: found.address })}</p>`}
    ${found?.places.map((place) => html`<div key=${place.label} class="found-place">
      <p>${candidateInWords(place)}</p><div class="buttons">
      <button type="button" onClick=${done(() => addAt(found.address, place))}>${t('places.add')}
        </button>
      ${id && html`<button type="button" onClick=${done(() => putAt(id, place.location))}>${t(
        'places.move',
        { id },
      )}</button>`}
      <button type="button" onClick=${done(() => putDepotAt(place.location))}>${t(
        'places.moveDepot',
      )}</button></div></div>`)}</div></section>`;
}

/** Customers whose place is doubtful or not known. */
export function DoubtedPlaces({ request }) {
  const doubts = useStore((state) => state.doubts);
  const found = doubtedPlaces(request, doubts);
  const unplaced = found.filter(({ doubt }) => doubt === null).length;
  if (!found.length) return null;
  return html`<details class="card" open id="doubted"><summary>${t('places.doubtful', {
    count: found.length,
  })}<span class="right">${unplaced ? t('places.without', { count: unplaced }) : ''}</span>
    </summary>
    <div class="inside"><ul>${found.map(
      ({ id, key, address, doubt }) => html`<li key=${id}><button type="button" class="link"
        onClick=${() => (doubt ? select(key) : beginPlacing(key))}>${id}</button>
        ${' '}${doubt ?? t('places.none', { address })}</li>`,
    )}</ul>
    ${unplaced > 0 && html`<div class="buttons"><button type="button"
      onClick=${leaveOutUnplaced}>${t('places.leaveOut')}</button></div>`}</div></details>`;
}

/** What is doubtful about a customer's place, and what it may be instead. */
export function PlaceOf({ request, id }) {
  const doubts = useStore((state) => state.doubts);
  const finds = useStore((state) => state.config.finds_addresses);
  const doubted = doubtedPlaces(request, doubts).find((other) => other.id === id);
  const [places, setPlaces] = useState([]);
  const address = doubted?.address;
  useEffect(() => {
    setPlaces([]);
    if (!address || !finds) return undefined;
    let isLeft = false;
    find(address).then((found) => !isLeft && setPlaces(found.places), showFailure);
    return () => {
      isLeft = true;
    };
  }, [address, finds]);
  if (!doubted) return null;
  const { doubt } = doubted;
  return html`<div class="doubted-place" role="group" aria-label=${t('places.placeOf', { id })}>
    <p>${doubt ?? openWords(address, places)}
    </p><div class="buttons">${places.map(
      (place) => html`<button type="button" key=${place.label}
        onClick=${() => putAt(id, place.location)}>${candidateInWords(place)}</button>`,
    )}<button type="button" onClick=${() => beginPlacing(`c:${id}`)}>${t('places.show')}</button>
    ${doubt && html`<button type="button" onClick=${() => settle(id)}>${t('places.right')}
    </button>`}
    </div></div>`;
}

/** Return what is to be said of an address that has no place. */
function openWords(address, places) {
  return places.length > 1 ? t('places.several', { address }) : t('places.none', { address });
}
