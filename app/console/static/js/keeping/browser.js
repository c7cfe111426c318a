/** Plans kept by name in this browser, with the same functions as those on the service. */

import { ApiError } from '../api.js';
import { trueCost } from '../core/terms.js';
import { newId, readAll, transact, whenRead } from './database.js';
import { t } from '../texts.js';

/** Return all plans without their content. */
export const list = () => readAll('plan');

/** Return a plan with its content. */
export async function read(id) {
  const found = await transact('readonly', (records, give) => {
    whenRead(records.get(['plan', id]), (summary) => {
      whenRead(records.get(['content', id]), (content) =>
        give(summary && content ? { ...summary, ...content } : null));
    });
  });
  if (!found) throw gone();
  return found;
}

/** Keep a plan in place of a version of it; null: there is none yet; `*`: whichever. */
export function write(id, { name, note, request, plan }, version) {
  const summary = { id, name, note, customers: request.customers.length,
    cost: plan ? trueCost({ request, plan }) : null };
  return change(id, version, summary, (records) =>
    records.put({ request, plan }, ['content', id]));
}

/** Change the name and note of a plan. */
export const rename = (id, names, version) => change(id, version, names, () => {});

/** Delete a plan. */
export async function remove(id, version) {
  const outcome = await transact('readwrite', (records, give) => {
    whenRead(records.get(['plan', id]), (there) => {
      if (there && version !== '*' && there.version !== version) return give(changed());
      records.delete(['plan', id]);
      return records.delete(['content', id]);
    });
  });
  if (outcome) throw outcome;
}

async function change(id, version, patch, further) {
  const outcome = await transact('readwrite', (records, give) => {
    whenRead(records.get(['plan', id]), (there) => {
      const isKnown = version === '*' || (there?.version ?? null) === version;
      if (!isKnown) return give({ error: there ? changed() : gone() });
      const now = new Date().toISOString();
      const summary = { created_at: now, ...there, ...patch, changed_at: now, version: newId() };
      records.put(summary, ['plan', id]);
      further(records);
      return give({ summary });
    });
  });
  if (outcome.error) throw outcome.error;
  return outcome.summary;
}

const changed = () =>
  new ApiError(412, t('kept.changed'), t('kept.savedSince'));

const gone = () =>
  new ApiError(412, t('kept.deleted'), t('kept.deletedSince'));
