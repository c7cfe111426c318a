/** The edge of a part of the desk, which is dragged, or moved by keys. */

import { layOut } from '../frame.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';

const STEP = 16; // pixels a key

/**
 * An edge.
 *
 * @param name of what is kept of the frame, pixels
 * @param range least and most of it
 * @param upward whether it grows upwards; else it grows to the right
 */
export function Edge({ name, range: [least, most], label, upward = false }) {
  const size = useStore((state) => Math.min(state.frame[name], most));
  const set = (value) =>
    layOut({ [name]: Math.round(Math.min(Math.max(value, least), most)) });
  const placeOf = (event) => (upward ? -event.clientY : event.clientX);
  const drag = (event) => {
    event.preventDefault();
    const begun = size - placeOf(event);
    const edge = event.currentTarget;
    edge.setPointerCapture(event.pointerId);
    edge.onpointermove = (moved) => set(begun + placeOf(moved));
    edge.onpointerup = () => {
      edge.onpointermove = null;
    };
  };
  const press = (event) => {
    const [more, fewer] = upward ? ['ArrowUp', 'ArrowDown'] : ['ArrowRight', 'ArrowLeft'];
    if (event.key !== more && event.key !== fewer) return;
    event.preventDefault();
    set(size + (event.key === more ? STEP : -STEP));
  };
  return html`<div class=${`edge ${upward ? 'upward' : ''}`} role="separator" tabindex="0"
    aria-label=${label} aria-orientation=${upward ? 'horizontal' : 'vertical'}
    aria-valuenow=${size} aria-valuemin=${least} aria-valuemax=${most}
    onPointerDown=${drag} onKeyDown=${press}></div>`;
}
