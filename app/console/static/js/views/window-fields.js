/** Two fields for each of a customer's windows. */

import { clock, parseClock } from '../core/format.js';
import { windowsOf } from '../core/windows.js';
import { html, useLayoutEffect, useState } from '../libraries.js';
import { t } from '../texts.js';

const ANY_TIME = [{ earliest: 0, latest: null }];

/**
 * Fields and the button that changes the windows.
 *
 * @param customer whose windows they are
 * @param onApply called with windows of `{earliest, latest}` in seconds; `latest` null for no end
 */
export function WindowFields({ customer, onApply }) {
  const stated = windowsOf(customer);
  const windows = stated.length ? stated : ANY_TIME;
  const texts = () =>
    windows.flatMap(({ earliest, latest }) => [clock(earliest ?? 0), clock(latest ?? null)]);
  const [text, setText] = useState(texts);
  useLayoutEffect(() => setText(texts()), [customer]);
  const times = text.map((part) => (part.trim() === '' ? null : parseClock(part)));
  const isWrong = text.map(
    (part, at) => part.trim() !== '' && (times[at] === null || (at % 2 && times[at] < 0)));
  const apply = () =>
    onApply(
      windows.map((_, number) => ({
        earliest: Math.max(0, times[2 * number] ?? 0),
        latest: times[2 * number + 1] ?? null,
      })));
  const input = (at, label) => html`<label>${label} <input type="text" size="6"
    value=${text[at] ?? ''} placeholder=${t(`windows.${at % 2 ? 'never' : 'atOnce'}`)}
    aria-invalid=${Boolean(isWrong[at])}
    onKeyDown=${(event) => event.key === 'Enter' && !isWrong.includes(true) && apply()}
    onInput=${({ target }) =>
      setText(text.map((part, other) => (other === at ? target.value : part)))} /></label>`;
  return html`${windows.map((_, number) => {
    const which = windows.length > 1 ? `${number + 1} ` : '';
    return html`${input(2 * number, which + t('windows.opens'))} ${
      input(2 * number + 1, which + t('windows.closes'))} `;
  })}
    <button type="button" disabled=${isWrong.includes(true)}
      onClick=${apply}>${t('windows.change', { count: windows.length })}</button>`;
}
