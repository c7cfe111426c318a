/** Which draft is whose among the tabs of this browser. */

const PREFIX = 'tandem draft ';
const TAB = 'tandem-draft';

/** A tab that is loaded anew may meet its own former page, which is just leaving. */
const LEAVING_MS = 1000;

/** Return the draft that this tab had before it was loaded anew, or null. */
export function draftOfTab() {
  try {
    return sessionStorage.getItem(TAB);
  } catch {
    return null;
  }
}

/** Remember which draft this tab has. */
export function noteDraftOfTab(id) {
  try {
    sessionStorage.setItem(TAB, id);
  } catch {
    // Loaded anew, the tab then begins as a new one does, with the newest draft.
  }
}

/**
 * Take a draft for this tab until it closes; return what gives it back, or null if another has it.
 *
 * Where browsers have no locks, over plain HTTP, any tab may take it: whoever had it notices when
 * it writes, see `writeDraft`.
 */
export function holdDraft(id, isOwn) {
  if (!navigator.locks) return Promise.resolve(() => {});
  const options = isOwn ? { signal: AbortSignal.timeout(LEAVING_MS) } : { ifAvailable: true };
  return new Promise((resolve) => {
    navigator.locks
      .request(PREFIX + id, options, (lock) => {
        if (!lock) return resolve(null);
        return new Promise((release) => resolve(release));
      })
      .catch(() => resolve(null));
  });
}

/** Return the ids of drafts that tabs have open. */
export async function heldDrafts() {
  if (!navigator.locks) return [];
  const { held } = await navigator.locks.query();
  return held.map(({ name }) => name).filter((name) => name.startsWith(PREFIX))
    .map((name) => name.slice(PREFIX.length));
}
