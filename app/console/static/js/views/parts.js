/** Small pieces that several views use. */

import { contains } from '../core/plan.js';
import { vehicleColour } from '../core/palette.js';
import { hover, select } from '../actions.js';
import { html, useEffect, useRef } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';

/** The colour and number of a vehicle or trip, as on the map. */
export function Badge({ vehicle, label }) {
  const dark = useStore((state) => state.dark);
  return html`<span class="badge" style=${{ background: vehicleColour(vehicle.number, dark) }}>
    ${label ?? vehicle.label}</span>`;
}

/**
 * Return what opens a card as soon as something in it is to be looked at.
 *
 * It isn't closed again: whoever has mended what was wrong goes on in it.
 */
export function useOpening(isOpen) {
  const card = useRef(null);
  useEffect(() => {
    if (isOpen) card.current.open = true;
  }, [isOpen]);
  return card;
}

/** What links an element with the map and the timeline. */
export function linked(index, key, selection, hovered) {
  return {
    onMouseEnter: () => hover(key),
    onMouseLeave: () => hover(null),
    'data-key': key,
    'data-selected': selection === key,
    'data-marked': Boolean(hovered) && contains(index, key, hovered),
  };
}

/** A button that selects what a key names. */
export function SelectButton({ of: key, children }) {
  const selected = useStore((state) => state.selection) === key;
  return html`<button type="button" class="link" aria-pressed=${selected}
    onFocus=${() => hover(key)} onBlur=${() => hover(null)}
    onClick=${() => select(selected ? null : key)}>${children}</button>`;
}

const LONG = 10; // characters
const END = 7;

/** A name, the middle of which gives way where there is no room, as ends tell names apart. */
export function Name({ children: name }) {
  if (name.length < LONG) return name;
  return html`<span class="cut-name"><span>${name.slice(0, -END)}</span><span>${name.slice(-END)}
    </span></span>`;
}

/** A bar of a share, 0 to 1, beside its number. */
export function ShareBar({ share, text, label, colour }) {
  return html`<span class="share-bar" role="img" aria-label=${`${label} ${text}`}>
    <span class="share-fill" style=${{ width: `${Math.min(share, 1) * 100}%`, background: colour }}>
      </span>
    <span class="share-text">${text}</span></span>`;
}

/** Pairs of a term and its value. */
export function Facts({ facts }) {
  return html`<dl class="facts">${facts.map(([term, value]) => html`
    <div key=${term}><dt>${term}</dt><dd>${value}</dd></div>`)}</dl>`;
}

/** A dialog over the page, closed by Escape or its button. */
export function Dialog({ title, onClose, children, name, wide = false }) {
  const element = useRef(null);
  useEffect(() => {
    element.current.showModal();
  }, []);
  return html`<dialog ref=${element} class=${`dialog ${wide ? 'broad' : ''}`}
      aria-labelledby=${`${name}-title`}
      onClose=${onClose} onCancel=${onClose}>
    <header><h2 id=${`${name}-title`}>${title}</h2>
      <button type="button" class="quiet" aria-label=${t('app.close')}
        onClick=${onClose}>${t('app.close')}</button></header>
    ${children}
  </dialog>`;
}
