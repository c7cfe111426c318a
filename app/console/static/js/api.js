/** The service's endpoints. Every call may throw `ApiError`. */

import { eventReader } from './core/sse.js';

const KEY = 'tandem-api-key';
const RESUME_MS = 1000;
const MOST_RESUMES = 30; // in a row, without a word from the service

/** A request that was refused or not answered. */
export class ApiError extends Error {
  constructor(status, title, detail, errors = []) {
    super(detail);
    Object.assign(this, { status, title, errors });
  }
}

let askForKey = async () => null;

/** Set what asks the user for an API key; it returns the key, or null to give up. */
export function onKeyNeeded(ask) {
  askForKey = ask;
}

/** Keep a key until the tab is closed; null forgets it. */
export function keepKey(key) {
  if (key) sessionStorage.setItem(KEY, key);
  else sessionStorage.removeItem(KEY);
}

async function send(path, { method = 'GET', body, headers = {}, signal } = {}) {
  const key = sessionStorage.getItem(KEY);
  const all = {
    ...headers,
    ...(key && { Authorization: `Bearer ${key}` }),
    ...(body && { 'Content-Type': 'application/json' }),
  };
  const response = await ask(path, {
    method,
    headers: all,
    signal,
    body: body && JSON.stringify(body),
  });
  if (response.ok) return response;
  if (response.status === 401) {
    const given = await askForKey(key !== null);
    if (given) {
      keepKey(given);
      return send(path, { method, body, headers, signal });
    }
  }
  throw await errorOf(response);
}

async function ask(path, options) {
  try {
    return await fetch(new URL(path, document.baseURI), options);
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    throw new ApiError(
      0,
      'The service does not answer',
      'No connection: check that the service runs and that you are online, then try again.',
    );
  }
}

async function errorOf(response) {
  const isProblem = response.headers.get('content-type')?.includes('problem+json');
  const problem = isProblem ? await response.json() : {};
  const again = response.headers.get('retry-after');
  const wait = again ? ` Try again in ${again} s.` : '';
  return new ApiError(
    response.status,
    problem.title ?? `The service answered ${response.status}`,
    (problem.detail ?? 'It gave no reason.') + wait,
    problem.errors ?? [],
  );
}

async function json(path, options) {
  return (await send(path, options)).json();
}

/** Return the description of the API. */
export const getDescription = () => json('openapi.json');

/** Return the console's settings. */
export const getConfig = () => json('console/config.json');

/** Return whether plans can be made now: `{status, detail, progress}`. */
export async function getReadiness() {
  const response = await ask('health/ready');
  if (response.ok) return response.json();
  if (response.status !== 503) throw await errorOf(response);
  return response.json().catch(() => ({ status: 'starting', detail: 'It gave no reason.' }));
}

/** Plan and return the reply. */
export const postPlan = (request, signal) =>
  json('plan', { method: 'POST', body: request, signal });

/** Return why a customer of a plan is served where it is, or what drones save. */
export const postExplain = (question) => json('explain', { method: 'POST', body: question });

/** Start a job: `kind` is `jobs`, `compare` or `sweep`. Return it. */
export const startJob = (kind, body) => json(kind, { method: 'POST', body });

/** Return a job with what it has found so far. */
export const getJob = (id) => json(`jobs/${encodeURIComponent(id)}`);

/** Stop a job and return it with what it found. */
export const stopJob = (id) => json(`jobs/${encodeURIComponent(id)}`, { method: 'DELETE' });

/**
 * Follow a job to its end, over lost connections too, and return it without its result.
 *
 * @param onProgress called with each progress
 * @param signal ends the following, by an `AbortError`
 */
export async function followJob(id, onProgress, signal) {
  let last = null;
  let ended = null;
  const read = eventReader(({ event, id: number, data }) => {
    last = number ?? last;
    if (event === 'progress') onProgress(JSON.parse(data));
    if (event === 'end') ended = JSON.parse(data);
  });
  for (let failures = 0; !ended;) {
    try {
      await readEvents(`jobs/${encodeURIComponent(id)}/events`, last, read, signal);
      failures = 0;
    } catch (error) {
      failures += 1;
      const mayPass = error.status === 0 || error.status === 503;
      if (!mayPass || failures > MOST_RESUMES) throw error;
    }
    if (!ended)
      await new Promise((resolve) => {
        setTimeout(resolve, RESUME_MS);
      });
  }
  return ended;
}

async function readEvents(path, last, read, signal) {
  const headers = { Accept: 'text/event-stream', ...(last && { 'Last-Event-ID': last }) };
  const response = await send(path, { headers, signal });
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) read(part.value);
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    // The connection broke: the caller resumes after the last event.
  }
}
