/** Two fields for a customer's window. */

import { clock, parseClock } from '../core/format.js';
import { html, useLayoutEffect, useState } from '../libraries.js';

/**
 * Fields and the button that changes the window.
 *
 * @param customer whose window it is
 * @param onApply called with `{earliest, latest}` in seconds; `latest` is null for no end
 */
export function WindowFields({ customer, onApply }) {
  const window = customer.time_window;
  const stated = [window?.earliest ?? 0, window?.latest ?? null];
  const [text, setText] = useState(['', '']);
  useLayoutEffect(() => setText(stated.map((time) => clock(time))), [customer]);
  const [earliest, latest] = text.map((part) => (part.trim() === '' ? null : parseClock(part)));
  const isWrong = text.map((part, at) => part.trim() !== '' && [earliest, latest][at] === null);
  const apply = () => onApply({ earliest: earliest ?? 0, latest });
  const input = (at, label) => html`<label>${label} <input type="text" size="6" value=${text[at]}
    placeholder=${at ? 'never' : '0:00'} aria-invalid=${isWrong[at]}
    onKeyDown=${(event) => event.key === 'Enter' && !isWrong.includes(true) && apply()}
    onInput=${({ target }) =>
      setText(text.map((part, other) => (other === at ? target.value : part)))} /></label>`;
  return html`${input(0, 'opens')} ${input(1, 'closes')}
    <button type="button" disabled=${isWrong.includes(true)}
      onClick=${apply}>Change this window</button>`;
}
