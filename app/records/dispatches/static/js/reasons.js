/** Why steps fail: what is told of it, and what drivers read. */

// The service is told reasons in English, whatever the phone's language: it knows some of them, see
// GROUNDING, and dispatchers read them in theirs.
import TOLD from '../../console/texts/reasons/en.js';
import { t } from './texts.js';

/** Reasons that are offered, by the kind of a step. */
export const REASONS = {
  stop: ['nobody', 'refused', 'address', 'damaged', 'time'],
  launch: ['wind', 'broken', 'battery', 'time'],
  recover: ['parcel', 'lost'],
};

/** Return a reason as the service is told it. */
export function toldReason(name) {
  return TOLD[name];
}

/** Return what is told as people read it: in their language if it is one of the known reasons. */
export function reasonText(told) {
  const [known] = Object.entries(TOLD).find(([, text]) => text === told) ?? [];
  return known ? t(`reason.${known}`) : told;
}

const KEPT = 'tandem-drive-reason';

/** Return what the driver was writing about a step when the page was closed, or null. */
export function draftOf(storage, link, step) {
  const kept = JSON.parse(storage.getItem(KEPT) ?? 'null');
  return kept?.link === link && kept.step === step ? kept.text : null;
}

/** Forget what the driver was writing. */
export function forgetDraft(storage) {
  storage.removeItem(KEPT);
}

/** Keep what the driver is writing about a step; `null` when it is told or given up. */
export function keepDraft(storage, link, step, text) {
  if (text !== null) storage.setItem(KEPT, JSON.stringify({ link, step, text }));
  else if (draftOf(storage, link, step) !== null) forgetDraft(storage);
}
