/** Sends what was told: in order, each once as the service counts, until it says that it has it. */

import * as days from './days.js';
import { t } from './texts.js';

const MOST_AT_ONCE = 200;

/** The link opens nothing any more. */
export class LinkOver extends Error {}

/** What was told can't be taken. */
export class Refused extends Error {}

/** Of what is told, a proof of delivery. */
export const PROOF = 'proof';

function proofIn({ id, step, time, proof }) {
  return { id, step, time, ...proof };
}

/** Ask the service; `null` while there is no network or it can't answer now. */
export async function ask(token, path, body) {
  const headers = { Authorization: `Bearer ${token}` };
  const options = { headers, cache: 'no-store', referrerPolicy: 'no-referrer' };
  if (body) {
    Object.assign(options, { method: 'POST', body: JSON.stringify(body) });
    headers['Content-Type'] = 'application/json';
  }
  let reply;
  try {
    reply = await fetch(path, options);
    if (reply.ok) return await reply.json();
  } catch {
    return null;
  }
  if (reply.status === 401) throw new LinkOver(t('failure.unknown'));
  if (reply.status === 410) throw new LinkOver(t('failure.over'));
  if (reply.status >= 500 || reply.status === 408 || reply.status === 429) return null;
  throw new Refused(t('failure.refused', { status: String(reply.status) }));
}

/** Return what is told of a step now, to be kept; `more` is its reason, or a proof. */
export function eventOf(link, step, kind, more = {}) {
  const time = new Date().toISOString();
  return { link, id: crypto.randomUUID(), step, kind, time, ...more };
}

/**
 * Send what waits; return how steps stand by then, null if nothing could be sent.
 *
 * Another page of the same link may send the same: the service counts it once.
 */
export async function send(token, link) {
  let standing = null;
  let waiting = await days.waitingEvents(link);
  while (waiting.length) {
    const marks = waiting.filter(({ kind }) => kind !== PROOF).slice(0, MOST_AT_ONCE);
    // Pictures are large, and come last.
    const events = marks.length ? marks : waiting.slice(0, 1);
    const told = marks.map(({ id, step, kind, time, reason, location }) => ({
      id,
      step,
      kind,
      time,
      ...(reason && { reason }),
      ...(location && { location }),
    }));
    const now = new Date().toISOString();
    const reply = told.length ? await ask(token, 'events', { now, events: told })
      : await ask(token, 'proofs', { now, ...proofIn(events[0]) });
    if (!reply) return standing;
    standing = reply.standing ?? standing;
    await days.dropEvents(events);
    waiting = await days.waitingEvents(link);
  }
  return standing;
}
