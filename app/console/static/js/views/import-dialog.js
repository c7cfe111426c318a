/** What a sheet is taken for, cell by cell, before it is planned; each guess can be corrected. */

import { corrected, grantedInWords, readFields, unplacedIn } from '../core/importing.js';
import { change, leaveImport, useImport } from '../importing.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';
import { ImportFields } from './import-fields.js';
import { ImportMap } from './import-map.js';
import { Questions } from './import-questions.js';
import { Reading } from './import-reading.js';
import { ImportTable } from './import-table.js';
import { Dialog } from './parts.js';

const MOST_LISTED = 20;

/** The dialog. */
export function ImportDialog() {
  const importing = useStore((state) => state.importing);
  const finds = useStore((state) => state.config.finds_addresses);
  if (!importing) return null;
  const { name, reply } = importing;
  return html`<${Dialog} title=${t('import.title', { name })} name="import" wide
    onClose=${leaveImport}>
    ${!reply && html`<p role="status">${t('import.readingFile')}</p>`}
    ${reply && html`<${Found} importing=${importing} />
    <div class="buttons import-end"><button type="button" class="primary" id="use-import"
      disabled=${!ready(importing, finds)} onClick=${useImport}>${t('import.plan')}</button>
      <button type="button" onClick=${leaveImport}>${t('import.cancel')}</button>
      <${Lacking} importing=${importing} finds=${finds} /></div>`}
  </${Dialog}>`;
}

function Found({ importing }) {
  const { reply, busy, failure, isRemembered } = importing;
  const rows = t('import.rows', { count: reply.rows });
  return html`<div class="import" aria-busy=${busy}>
    <p role="status">${(reply.customers > 0 || !reply.shipments) &&
        t('import.customers', { count: reply.customers, rows })}
      ${reply.shipments > 0 && ` ${t('import.shipments', { count: reply.shipments })}`}
      ${isRemembered && ` ${t('import.remembered')}`}${busy && ` ${t('import.readingAnew')}`}</p>
    ${failure && html`<p class="error" role="alert">${failure.message}
      ${failure.errors.map(({ message }) => ` ${message}`)}</p>`}
    <${Errors} importing=${importing} />
    <${ImportTable} reply=${reply} />
    <${Questions} importing=${importing} />
    <${ImportFields} importing=${importing} />
    <${ImportMap} importing=${importing} />
    <${Doubts} reply=${reply} />
    <${Reading} importing=${importing} />
  </div>`;
}

function ready({ reply, busy, failure, texts, corrections, places, leavesUnplaced }, finds) {
  const isRead = reply.request !== null && !busy && !failure && !readFields(texts).wrong.length
    && !corrected(reply.request, corrections).wrong.length;
  return isRead && (finds || leavesUnplaced || !unplacedIn(reply.request, places).length);
}

/** What has to be done before planning, beside the button that can't be pressed yet. */
function Lacking({ importing: { reply, places, leavesUnplaced }, finds }) {
  const unplaced = finds || leavesUnplaced ? 0 : unplacedIn(reply.request, places).length;
  const unanswered = (reply.questions ?? []).filter(({ answer }) => answer === null).length;
  return html`<span class="help">${unanswered > 0 && t('import.mustAnswer')}
    ${unplaced > 0 && t('import.mustPlace')}</span>`;
}

function Errors({ importing: { reply, choices } }) {
  const inRows = reply.errors.some(({ cell }) => cell);
  const more = reply.num_errors - MOST_LISTED;
  if (!reply.num_errors) return null;
  return html`<div role="alert">
    <p class="error"><strong>${t('import.errors', { count: reply.num_errors })}</strong>
      ${' '}${t('import.mend')}</p>
    <ul>${reply.errors.slice(0, MOST_LISTED).map((error, position) => html`<li key=${position}>
        ${error.cell && html`<strong>${error.cell}</strong>: `}${grantedInWords(error)}</li>`)}
    ${more > 0 && html`<li>${t('app.more', { count: more })}</li>`}
    </ul></div>
    ${inRows && html`<label class="check"><input type="checkbox"
        checked=${Boolean(choices.leave_out_errors)} onChange=${(event) =>
          change({ choices: { ...choices, leave_out_errors: event.target.checked } })} />
        ${t('import.leaveOutErrors')}</label>`}`;
}

function Doubts({ reply: { doubts } }) {
  if (!doubts.length) return null;
  return html`<details open><summary>${t('import.granted', { count: doubts.length })}</summary>
    <ul>${doubts.map((doubt) => html`<li key=${doubt.message}><${Doubt} doubt=${doubt} /></li>`)}
    </ul></details>`;
}

function Doubt({ doubt }) {
  const text = grantedInWords(doubt);
  const { cell } = doubt;
  return html`${cell && !text.includes(cell) && html`<strong>${cell}</strong>: `}${text}`;
}
