/** Proofs of delivery that drivers sent: who took it, a photo, a signature. */

import { showFailure } from '../actions.js';
import * as api from '../api.js';
import { clock } from '../core/format.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { html, useState } from '../libraries.js';
import { SelectButton } from './parts.js';
import { t } from '../texts.js';

const PARTS = ['photo', 'signature'];

/** A list that is looked for when it is unfolded, of one order or of all. */
export function Proofs({ dispatch, order = null }) {
  const [found, setFound] = useState(null);
  const look = async ({ currentTarget: { open } }) => {
    try {
      const all = open ? await api.getProofs(dispatch) : null;
      setFound(order === null ? all : all?.filter(({ orders }) => orders.includes(order)));
    } catch (error) {
      showFailure(error);
    }
  };
  return html`<details class="card listed proofs" onToggle=${look}>
    <summary>${t('proofs.title')}</summary>
    ${found && html`<ul class="inside">${found.map((proof) => html`<${Proof}
      key=${`${proof.vehicle} ${proof.id}`} proof=${proof} dispatch=${dispatch} />`)}
      ${!found.length && html`<li class="help">${t('proofs.none')}</li>`}</ul>`}</details>`;
}

function Proof({ proof, dispatch }) {
  const [shown, setShown] = useState(null); // {part, url}
  const { id, vehicle, orders, name, time } = proof;
  const show = async (part) => {
    if (shown) URL.revokeObjectURL(shown.url);
    try {
      setShown(shown?.part === part ? null
        : { part, url: URL.createObjectURL(await api.getPicture(dispatch, vehicle, id, part)) });
    } catch (error) {
      showFailure(error);
    }
  };
  const of = orders.join(', ');
  return html`<li>${orders.map((order) => html`<${SelectButton} key=${order}
      of=${`c:${order}`}>${order}</${SelectButton}>`)}
    <span>${[name, nameOfVehicle(vehicle), clock(time)].filter(Boolean).join(', ')}</span>
    ${PARTS.filter((part) => proof[part]).map((part) => html`<button type="button" key=${part}
      aria-pressed=${shown?.part === part} aria-label=${t(`proofs.${part}Of`, { of })}
      onClick=${() => show(part)}>${t(`proofs.${part}`)}</button>`)}
    ${shown && html`<img src=${shown.url} alt=${t(`proofs.${shown.part}Of`, { of })} />`}</li>`;
}
