/** Dialogs: the list of keys on the keyboard, and the question for an API key. */

import { html, useState } from '../libraries.js';
import { store, useStore } from '../store.js';
import { KeepingDialogs } from './keeping-dialogs.js';
import { later } from './later.js';
import { Dialog } from './parts.js';
import { OTHER_KEYS, setSingleKeys, SINGLE_KEYS, singleKeysWork } from './shortcuts.js';
import { t } from '../texts.js';

const ImportDialog = later(async () => (await import('./import-dialog.js')).ImportDialog);

/** The open dialog, if any. */
export function Dialogs() {
  const dialog = useStore((state) => state.dialog);
  const imports = useStore((state) => state.importing !== null);
  if (dialog?.name === 'keys') return html`<${KeysDialog} />`;
  if (dialog?.name === 'key') return html`<${KeyDialog} ...${dialog} />`;
  return html`<${KeepingDialogs} />${imports && html`<${ImportDialog} />`}`;
}

function close() {
  store.set({ dialog: null });
}

function KeysDialog() {
  const [work, setWork] = useState(singleKeysWork());
  const choose = (event) => {
    setSingleKeys(event.target.checked);
    setWork(event.target.checked);
  };
  return html`<${Dialog} title=${t('keys.title')} name="keys" onClose=${close}>
    <${Keys} group="other" keys=${OTHER_KEYS} />
    <label class="check"><input type="checkbox" checked=${work} onChange=${choose} />
      ${t('keys.single')}</label>
    <p class="help">${t('keys.help')}</p>
    <${Keys} group="alone" keys=${SINGLE_KEYS} off=${!work} /></${Dialog}>`;
}

function Keys({ group, keys, off = false }) {
  return html`<table class=${off ? 'keys-off' : ''}><tbody>${keys.map(
    (name) => html`<tr key=${name}><th scope="row"><kbd>${t(`keys.${group}.${name}.key`)}</kbd></th>
      <td>${t(`keys.${group}.${name}.does`)}</td></tr>`,
  )}</tbody></table>`;
}

function KeyDialog({ wasWrong, answer }) {
  const [key, setKey] = useState('');
  const give = (value) => {
    close();
    answer(value);
  };
  const submit = (event) => {
    event.preventDefault();
    if (key.trim()) give(key.trim());
  };
  return html`<${Dialog} title=${t('keys.api')} name="key" onClose=${() => give(null)}>
    <form onSubmit=${submit}>
      <p>${wasWrong ? t('keys.refused') : t('keys.needed')} ${t('keys.kept')}</p>
      <label>${t('keys.key')} <input type="password" id="api-key" value=${key} autocomplete="off"
        onInput=${(event) => setKey(event.target.value)} /></label>
      <button type="submit" class="primary">${t('keys.use')}</button>
    </form></${Dialog}>`;
}
