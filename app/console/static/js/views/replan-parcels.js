/** When what broken vehicles carry is at the depots again. */

import { edit } from '../actions.js';
import { clock, parseClock } from '../core/format.js';
import { removeIn, setIn } from '../core/paths.js';
import { html, useLayoutEffect, useState } from '../libraries.js';
import { Errors, errorsAt } from './replan-errors.js';
import { t } from '../texts.js';

/** When parcels that broken vehicles carry can be loaded again. */
export function ParcelsBack({ request, errors }) {
  const { parcels_back: value } = request.replan;
  const [text, setText] = useState('');
  // Before anything can be typed, which a later effect would take away.
  useLayoutEffect(() => setText(clock(value, { precise: true })), [value]);
  const mine = errorsAt(errors, (keys) => keys[1] === 'parcels_back');
  const parsed = parseClock(text);
  const isWrong = text.trim() !== '' && parsed === null;
  const id = 'field-replan-parcels_back';
  const commit = () => {
    if (isWrong) return;
    const keys = ['replan', 'parcels_back'];
    edit(text.trim() === '' ? removeIn(request, keys) : setIn(request, keys, parsed));
  };
  return html`<div class=${mine.length || isWrong ? 'field invalid' : 'field'}>
    <label for=${id}>${t('replan.parcels')}</label>
    <input type="text" id=${id} value=${text} placeholder=${t('replan.atOnce')} autocomplete="off"
      aria-describedby=${`${id}-help`} onInput=${(event) => setText(event.target.value)}
      onBlur=${commit} onKeyDown=${(event) => event.key === 'Enter' && commit()} />
    <span class="unit">h:mm</span>
    <p class="help" id=${`${id}-help`}>${t('replan.parcelsHelp')}</p>
    ${isWrong && html`<p class="error">${t('replan.clock', { example: '11:15' })}</p>`}
    <${Errors} errors=${mine} /></div>`;
}
