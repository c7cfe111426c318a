/** A box for an order that comes in: where, how much, when; then the three best vans for it. */

import { placeText, NOTHING_TYPED } from '../core/orders.js';
import { candidateInWords } from '../core/places.js';
import { html, useState } from '../libraries.js';
import { takeTool } from '../map/draw-bar.js';
import { noteOrder, priceOrder } from '../ordering.js';
import { showFailure } from '../actions.js';
import { store, useStore } from '../store.js';
import { t } from '../texts.js';

/** The box; `open` shows it unfolded. */
export function NewOrder({ open = false }) {
  const typed = useStore((state) => state.order);
  const request = useStore((state) => state.request);
  const isPicking = useStore((state) => state.tool === 'order');
  const [told, setTold] = useState(NOT_TOLD);
  const [wanted, setWanted] = useState(open);
  const isOpen = wanted || isPicking || isTyped(typed);
  const isGlobe = request.coordinate_system === 'geographic';
  const send = async (event) => {
    event?.preventDefault();
    await ask(typed, setTold);
  };
  const put = async ({ location }) => {
    const found = { ...typed, place: placeText(request, location) };
    noteOrder(found);
    await ask(found, setTold);
  };
  const field = (name, others) => html`<${OrderField} key=${name} name=${name} typed=${typed}
    isWrong=${told.wrong.includes(name)} ...${others} />`;
  return html`<details class="card new-order" open=${isOpen}
    onToggle=${({ currentTarget }) => {
      if (currentTarget.open && !isOpen) focusSoon();
      setWanted(currentTarget.open);
    }}>
    <summary>${t('orders.title')}</summary>
    ${isOpen && html`<form class="inside" onSubmit=${send}>
      ${field('place', { hint: isGlobe ? t('orders.placeOnGlobe') : t('orders.placeOnPlane') })}
      <div class="buttons"><button type="button" aria-pressed=${isPicking}
        onClick=${() => takeTool('order')}>${t('orders.onMap')}</button></div>
      ${told.places.length > 0 && html`<div class="found-places"><p>${t('orders.which')}</p>
        ${told.places.map((place) => html`<button type="button" key=${place.label}
          onClick=${() => put(place)}>${candidateInWords(place)}</button>`)}</div>`}
      <div class="order-fields">${field('amount', { hint: unitsOf(request) })}
        ${field('opens', { hint: '--:--' })}${field('closes', { hint: '--:--' })}
        ${field('name', { hint: t('orders.nameHint') })}</div>
      <div class="buttons"><button type="submit" class="primary">${t('orders.price')}</button></div>
    </form>`}</details>`;
}

/** Put the cursor into the first field, once it is there. */
function focusSoon() {
  requestAnimationFrame(() => document.getElementById('order-place')?.focus());
}

const NOT_TOLD = { wrong: [], places: [] };

function isTyped(typed) {
  return Object.values(typed).some((text) => text !== '');
}

async function ask(typed, setTold) {
  try {
    const told = await priceOrder(typed);
    setTold(told);
    if (told.wrong.length) document.getElementById(`order-${told.wrong[0]}`)?.focus();
    // What was typed meanwhile is another order.
    else if (told.isTold && store.get().order === typed) noteOrder(NOTHING_TYPED);
  } catch (error) {
    showFailure(error);
  }
}

/** Return what is loaded, in units, such as `kg`. */
function unitsOf({ load_dimensions: stated, fleet }) {
  const units = (stated ?? []).map(({ unit, name }) => unit ?? name).filter(Boolean);
  if (units.length) return units.join('; ');
  const dimensions = fleet[0]?.capacity.length ?? 1;
  return dimensions > 1 ? t('orders.numbers', { count: dimensions }) : '1';
}

function OrderField({ name, typed, hint, isWrong }) {
  const id = `order-${name}`;
  return html`<div class=${isWrong ? 'order-field invalid' : 'order-field'}>
    <label for=${id}>${t(`orders.${name}`)}</label>
    <input type="text" id=${id} value=${typed[name]} placeholder=${hint} autocomplete="off"
      aria-invalid=${isWrong} aria-describedby=${isWrong ? `${id}-error` : undefined}
      onInput=${({ target }) => noteOrder({ [name]: target.value })} />
    ${isWrong && html`<p class="error" id=${`${id}-error`}>${t(`orders.wrong.${name}`)}</p>`}
  </div>`;
}
