/** An import under way: the service reads the file, the user corrects, the request is planned. */

import { openRequest, showFailure } from './actions.js';
import * as api from './api.js';
import { withoutEnding } from './core/format.js';
import { currencyOf } from './core/currencies.js';
import { doubtsOfImport, withFound } from './core/places.js';
import {
  byAddress, corrected, forNextFile, placing, readFields, remember, rememberPlaces, signatureOf,
  unplacedIn, withAnswer, withColumn, withoutUnplaced,
} from './core/importing.js';
import { plan } from './planning.js';
import { store } from './store.js';

const KEPT = 'tandem-imports';
const KEPT_PLACES = 'tandem-import-places';

/** Have a file read, and show what it is taken for. */
export async function beginImport(file) {
  store.set({
    failure: null,
    importing: {
      file, name: file.name, mapping: {}, texts: {}, choices: {}, corrections: {},
      places: kept(KEPT_PLACES) ?? {}, leavesUnplaced: false, placing: null, reply: null,
      busy: true, failure: null,
    },
  });
  const reply = await ask();
  const imports = kept(KEPT) ?? [];
  const known = reply && imports.find(({ signature }) => signature === signatureOf(reply));
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

/** Correct a vehicle that the file lists. */
export function correct(id, name, text) {
  const { corrections } = store.get().importing;
  note({ corrections: { ...corrections, [id]: { ...corrections[id], [name]: text } } });
}

/** Say what a column means. */
export function changeColumn(column, patch) {
  const { mapping, reply } = store.get().importing;
  return change({ mapping: withColumn(mapping, column, patch, reply.questions) });
}

/** Answer a question about the file. */
export function answer(id, given) {
  const { mapping } = store.get().importing;
  return change({ mapping: withAnswer(mapping, id, given) });
}

/** Say what a place on the map is for: `depot`, an address, or nothing. */
export function place(what) {
  note({ placing: what });
}

/** Put where the map was clicked what is being placed; the next address follows. */
export function placeAt([lon, lat]) {
  const { placing: what, texts, places, reply } = store.get().importing;
  if (what === null) return;
  if (what === 'depot') {
    note({ placing: null });
    change({ texts: { ...texts, depot: placing(reply.request, [lon, lat]) } });
  } else {
    const known = { ...places, [what.address]: [lon, lat] };
    const [next = null] = unplacedIn(reply.request, known);
    note({ places: known, placing: next && { address: next.address } });
  }
}

/** Plan without the rows that have no place, or don't. */
export function leaveUnplaced(leaves) {
  note({ leavesUnplaced: leaves });
}

/** Leave the import; what was open stays. */
export function leaveImport() {
  store.set({ importing: null });
}

/** Plan what was imported, in place of what was open. */
export async function useImport() {
  const { reply, texts, corrections, name, places, leavesUnplaced } = store.get().importing;
  const entry = { mapping: forNextFile(reply.mapping, reply.questions), texts };
  try {
    const known = remember(kept(KEPT) ?? [], signatureOf(reply), entry);
    localStorage.setItem(KEPT, JSON.stringify(known));
    localStorage.setItem(KEPT_PLACES, JSON.stringify(rememberPlaces(places)));
  } catch {
    // A browser that keeps nothing asks again next time.
  }
  store.set({ importing: null });
  const { request } = corrected(reply.request, corrections);
  const placed = withFound(request, byAddress(places)).request;
  const others = { name: withoutEnding(name), doubts: doubtsOfImport(reply) };
  openRequest(leavesUnplaced ? withoutUnplaced(placed) : placed, others);
  await plan();
}

let asked = 0;

/** Send the file with what is stated; only the newest answer counts. Return it. */
async function ask() {
  const { file, mapping, texts, choices } = store.get().importing;
  const { stated } = readFields(texts);
  stated.time_zone = Intl.DateTimeFormat().resolvedOptions().timeZone;
  stated.currency ??= currencyOf(stated.time_zone, navigator.language);
  // Who isn't found is placed by hand, on the map.
  stated.not_found = 'address';
  asked += 1;
  const number = asked;
  const isNewest = () => number === asked && store.get().importing?.file === file;
  note({ busy: true });
  try {
    const reply = await api.postImport(file, { ...stated, ...choices, mapping });
    if (!isNewest()) return null;
    const { placing: now, places, reply: before } = store.get().importing;
    const next = before?.request ? now : firstToPlace(reply, places);
    note({ reply, busy: false, failure: null, placing: next });
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

/** Return what has to be placed before anything can be planned, else null. */
function firstToPlace({ request, errors }, places) {
  if (errors.some(({ code }) => code === 'DEPOT')) return 'depot';
  const [first] = unplacedIn(request, places);
  return first ? { address: first.address } : null;
}

function note(patch) {
  store.set(({ importing }) => ({ importing: { ...importing, ...patch } }));
}

function kept(name) {
  try {
    return JSON.parse(localStorage.getItem(name));
  } catch {
    return null;
  }
}
