/** Drafts in the browser's database: what each tab works on, without its being saved by a name. */

import { partsOf } from '../core/drafts.js';
import { below, readAll, transact, whenRead } from './database.js';

/** Return the heads of all drafts, those changed last first. */
export async function listDrafts() {
  const heads = await readAll('draft');
  return heads.sort((one, other) => other.changedAt - one.changedAt);
}

/**
 * Return a draft as `{head, parts}`, or null if there is none.
 *
 * @param writer whose it is from now on: what others still write of it is refused; null: as it was
 */
export function readDraft(id, writer) {
  const parts = new Map();
  return transact(writer ? 'readwrite' : 'readonly', (records, give) => {
    whenRead(records.get(['draft', id]), (head) => {
      give(head ? { head, parts } : null);
      if (!head) return;
      if (writer) records.put({ ...head, writer }, ['draft', id]);
      for (const part of partsOf(head)) {
        whenRead(records.get(['part', id, part]), (value) => {
          if (value !== undefined) parts.set(part, value);
        });
      }
    });
  });
}

/**
 * Write a draft, unless another tab has it, or what it builds on is not there.
 *
 * @param isNew whether all its parts are given
 * @param fresh parts to be written, `[id, value]`
 * @param stale ids of parts that it needs no more
 * @return whether it was written: `written`, `taken` or `gone`
 */
export function writeDraft(head, isNew, fresh, stale) {
  return transact('readwrite', (records, give) => {
    whenRead(records.get(['draft', head.id]), (there) => {
      if (there && there.writer !== head.writer) return give('taken');
      if (!there && !isNew) return give('gone');
      fresh.forEach(([id, value]) => records.put(value, ['part', head.id, id]));
      stale.forEach((id) => records.delete(['part', head.id, id]));
      records.put(head, ['draft', head.id]);
      return give('written');
    });
  });
}

/** Delete drafts. */
export function deleteDrafts(ids) {
  return transact('readwrite', (records) => {
    for (const id of ids) {
      records.delete(['draft', id]);
      records.delete(below('part', id));
    }
  });
}
