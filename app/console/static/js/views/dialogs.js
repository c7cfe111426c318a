/** Dialogs: the list of keys on the keyboard, and the question for an API key. */

import { html, useState } from '../libraries.js';
import { store, useStore } from '../store.js';
import { ImportDialog } from './import-dialog.js';
import { KeepingDialogs } from './keeping-dialogs.js';
import { Dialog } from './parts.js';
import { OTHER_KEYS, setSingleKeys, SINGLE_KEYS, singleKeysWork } from './shortcuts.js';

/** The open dialog, if any. */
export function Dialogs() {
  const dialog = useStore((state) => state.dialog);
  if (dialog?.name === 'keys') return html`<${KeysDialog} />`;
  if (dialog?.name === 'key') return html`<${KeyDialog} ...${dialog} />`;
  return html`<${KeepingDialogs} /><${ImportDialog} />`;
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
  return html`<${Dialog} title="Keys" name="keys" onClose=${close}>
    <${Keys} keys=${OTHER_KEYS} />
    <label class="check"><input type="checkbox" checked=${work} onChange=${choose} />
      Single keys do something</label>
    <p class="help">Put them off if you speak to your computer, or press keys by chance. This
      browser remembers it.</p>
    <${Keys} keys=${SINGLE_KEYS} off=${!work} /></${Dialog}>`;
}

function Keys({ keys, off = false }) {
  return html`<table class=${off ? 'keys-off' : ''}><tbody>${keys.map(
    ([key, what]) => html`<tr key=${key}><th scope="row"><kbd>${key}</kbd></th>
      <td>${what}</td></tr>`,
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
  return html`<${Dialog} title="API key" name="key" onClose=${() => give(null)}>
    <form onSubmit=${submit}>
      <p>${wasWrong ? 'The service refused the key.'
        : 'This service needs an API key.'} It is kept until
        this tab is closed, and sent to this service alone.</p>
      <label>Key <input type="password" id="api-key" value=${key} autocomplete="off"
        onInput=${(event) => setKey(event.target.value)} /></label>
      <button type="submit" class="primary">Use this key</button>
    </form></${Dialog}>`;
}
