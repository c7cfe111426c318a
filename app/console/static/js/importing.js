/** An import under way: the service reads the file, the user corrects, the request is planned. */

import { openRequest, showFailure } from './actions.js';
import * as api from './api.js';
import { withoutEnding } from './core/format.js';
import { doubtsOfImport } from './core/places.js';
import { readFields, remember, signatureOf, withColumn } from './core/importing.js';
import { plan } from './planning.js';
import { store } from './store.js';

const KEPT = 'tandem-imports';

/** Have a file read, and show what it is taken for. */
export async function beginImport(file) {
  store.set({
    failure: null,
    importing: {
      file,
      name: file.name,
      mapping: {},
      texts: {},
      choices: {},
      reply: null,
      busy: true,
      failure: null,
    },
  });
  const reply = await ask();
  const known = reply && kept().find(({ signature }) => signature === signatureOf(reply));
  if (known) change({ mapping: known.mapping, texts: known.texts, isRemembered: true });
}

/** Change what is stated, and have the file read anew. */
export function change(patch) {
  store.set(({ importing }) => ({ importing: { ...importing, ...patch } }));
  return ask();
}

/** Note what is being typed; the file is read anew once it is done. */
export function type(name, text) {
  store.set(({ importing }) => ({
    importing: { ...importing, texts: { ...importing.texts, [name]: text } },
  }));
}

/** Say what a column means. */
export function changeColumn(column, patch) {
  const { mapping } = store.get().importing;
  return change({ mapping: withColumn(mapping, column, patch) });
}

/** Leave the import; what was open stays. */
export function leaveImport() {
  store.set({ importing: null });
}

/** Plan what was imported, in place of what was open. */
export async function useImport() {
  const { reply, texts, name } = store.get().importing;
  const entry = { mapping: reply.mapping, texts };
  try {
    localStorage.setItem(KEPT, JSON.stringify(remember(kept(), signatureOf(reply), entry)));
  } catch {
    // A browser that keeps nothing asks again next time.
  }
  store.set({ importing: null });
  openRequest(reply.request, { name: withoutEnding(name), doubts: doubtsOfImport(reply) });
  await plan();
}

let asked = 0;

/** Send the file with what is stated; only the newest answer counts. Return it. */
async function ask() {
  const { file, mapping, texts, choices } = store.get().importing;
  const { stated } = readFields(texts);
  stated.time_zone = Intl.DateTimeFormat().resolvedOptions().timeZone;
  // Who isn't found is placed by hand, on the map.
  if (store.get().config.finds_addresses) stated.not_found = 'address';
  asked += 1;
  const number = asked;
  const isNewest = () => number === asked && store.get().importing?.file === file;
  note({ busy: true });
  try {
    const reply = await api.postImport(file, { ...stated, ...choices, mapping });
    if (!isNewest()) return null;
    note({ reply, busy: false, failure: null });
    return reply;
  } catch (error) {
    if (!isNewest()) return null;
    if (store.get().importing.reply) note({ busy: false, failure: error });
    else {
      leaveImport();
      showFailure(error);
    }
    return null;
  }
}

function note(patch) {
  store.set(({ importing }) => ({ importing: { ...importing, ...patch } }));
}

function kept() {
  try {
    return JSON.parse(localStorage.getItem(KEPT)) ?? [];
  } catch {
    return [];
  }
}
