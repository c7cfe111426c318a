/** The service's endpoints. Every call may throw `ApiError`. */

import { createParser } from '../vendor/eventsource-parser-3.1.1/index.js';
import { t } from './texts.js';

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

/** @type {(wasWrong: boolean) => Promise<string | null>} */
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

/**
 * Send a request, and again with another key if it needs one.
 *
 * @param {string} path
 * @param {{method?: string, body?: any, form?: FormData, headers?: Record<string, string>,
 *   signal?: AbortSignal}} [options]
 * @returns {Promise<Response>}
 */
async function send(path, { method = 'GET', body, form, headers = {}, signal } = {}) {
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
    body: form ?? (body && JSON.stringify(body)),
  });
  if (response.ok) return response;
  if (response.status === 401) {
    const given = await askForKey(key !== null);
    if (given) {
      keepKey(given);
      return send(path, { method, body, form, headers, signal });
    }
  }
  throw await errorOf(response);
}

async function ask(path, options) {
  try {
    return await fetch(new URL(path, document.baseURI), options);
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    throw new ApiError(0, t('failed.unreached'), t('failed.offline'));
  }
}

async function errorOf(response) {
  const isProblem = response.headers.get('content-type')?.includes('problem+json');
  const problem = isProblem ? await response.json() : {};
  const again = response.headers.get('retry-after');
  const wait = again ? ` ${t('failed.again', { seconds: again })}` : '';
  return new ApiError(
    response.status,
    problem.title ?? t('failed.answered', { status: String(response.status) }),
    (problem.detail ?? t('failed.noReason')) + wait,
    problem.errors ?? []);
}

async function json(path, options) {
  return (await send(path, options)).json();
}

/** Return the description of the API. */
export const getDescription = () => json('openapi.json');

/** Return the console's settings. */
export const getConfig = () => json('console/config.json');

/** Return what a tile of streets shows; nothing where there are none. */
export async function getTile(place) {
  const response = await ask(`map/${place}`, {});
  if (response.status === 204) return {};
  if (!response.ok) throw await errorOf(response);
  return response.json();
}

/** Return whether plans can be made now: `{status, detail, progress}`. */
export async function getReadiness() {
  const response = await ask('health/ready');
  if (response.ok) return response.json();
  if (response.status !== 503) throw await errorOf(response);
  return response.json().catch(() => ({ status: 'starting', detail: t('failed.noReason') }));
}

/** Plan and return the reply. */
export const postPlan = (request, signal) =>
  json('plan', { method: 'POST', body: toldInSeconds(request), signal });

/** Return a request whose reply tells instants in seconds, which the console puts in words. */
function toldInSeconds(request) {
  if (!request.plan_start) return request;
  return { ...request, options: { ...request.options, times: 'seconds' } };
}

function aboutPlan({ problem, ...question }) {
  return { ...question, problem: toldInSeconds(problem) };
}

/** Return what looks wrong with a request, without planning it. */
export const postWarnings = (request) => json('warnings', { method: 'POST', body: request });

/** Look addresses up, as far as there is time. */
export const postAddresses = (addresses) =>
  json('addresses', { method: 'POST', body: { addresses } });

/** Have a sheet of customers read and return what it is taken for. */
export function postImport(file, settings) {
  const form = new FormData();
  form.append('file', file, 'sheet');
  form.append('settings', JSON.stringify(settings));
  return json('import', { method: 'POST', form });
}

/** Return why a customer of a plan is served where it is, or what drones save. */
export const postExplain = (question) =>
  json('explain', { method: 'POST', body: aboutPlan(question) });

/** Judge a plan, whose times are made where it states none. */
export const postCheck = (body) => json('check', { method: 'POST', body: aboutPlan(body) });

/** Return the best places of a customer in a plan. */
export const postFit = (question) => json('fit', { method: 'POST', body: aboutPlan(question) });

/** Return a picture of a plan, as SVG. */
export const postPicture = async (question) =>
  (await send('picture', { method: 'POST', body: aboutPlan(question) })).blob();

/** Return a plan's flights as a file: its name and its content. */
export async function postFlights(question) {
  const response = await send('flights', { method: 'POST', body: aboutPlan(question) });
  const [, name] = /filename="(.+)"/.exec(response.headers.get('content-disposition')) ?? [];
  return { name, content: await response.blob() };
}

/** Start a job: `kind` is `jobs`, `compare` or `sweep`, whose plans tell their ways. Return it. */
export const startJob = (kind, { base, ...body }) => json(kind, {
  method: 'POST',
  body: base ? { ...body, base: toldInSeconds(withWays(base)) } : toldInSeconds(body),
});

/** Return a request whose reply tells the ways of all legs. */
export function withWays(request) {
  return { ...request, options: { ...request.options, geometry: true } };
}

/** Return a job with what it has found so far. */
export const getJob = (id) => json(`jobs/${encodeURIComponent(id)}`);

/** Send a plan to its drivers and return their links. */
export const postDispatch = (body) => json('dispatches', { method: 'POST', body });

/** Put another plan of the day in the place of one on the road. */
export const changeDispatch = (id, body) =>
  json(`dispatches/${id}/plan`, { method: 'POST', body });

/** Return the plans that this key has on the road, the youngest first. */
export const getDispatches = async () => (await json('dispatches')).dispatches;

/** Return how far a plan on the road is. */
export const getDispatch = (id) => json(`dispatches/${id}`);

/** Return what to plan on from, by what drivers told. */
export const getGoingOn = (id, answers) => {
  const asked = Object.entries(answers ?? {}).flatMap(([name, value]) =>
    [value].flat().map((each) => [name, String(each)]));
  return json(`dispatches/${id}/replan?${new URLSearchParams(asked)}`);
};

/** Return the proofs of delivery that drivers of a plan sent, the youngest first. */
export const getProofs = async (id) => (await json(`dispatches/${id}/proofs`)).proofs;

/** Return a picture of a proof: its `photo` or its `signature`. */
export const getPicture = async (id, vehicle, proof, part) =>
  (await send(`dispatches/${id}/proofs/${encodeURIComponent(vehicle)}/${proof}/${part}`)).blob();

/** End a plan's day. */
export const endDispatch = (id) => json(`dispatches/${id}`, { method: 'DELETE' });

/** Revoke a driver's link. */
export const revokeLink = (id, link) =>
  json(`dispatches/${id}/links/${link}`, { method: 'DELETE' });

/** Make another link in place of one. */
export const renewLink = (id, link) => json(`dispatches/${id}/links/${link}`, { method: 'POST' });

/** Stop a job and return it with what it found. */
export const stopJob = (id) => json(`jobs/${encodeURIComponent(id)}`, { method: 'DELETE' });

/** Return all kept plans of the service without their content. */
export async function getKeptPlans() {
  const plans = [];
  let cursor = null;
  do {
    const query = cursor ? `&cursor=${encodeURIComponent(cursor)}` : '';
    const page = await json(`plans?limit=200${query}`);
    plans.push(...page.plans);
    cursor = page.next;
  } while (cursor);
  return plans;
}

const planPath = (id) => `plans/${encodeURIComponent(id)}`;

/** Return the headers that name the version to be changed; null: there must be none. */
function known(version) {
  if (version === null) return { 'If-None-Match': '*' };
  return { 'If-Match': version === '*' ? '*' : `"${version}"` };
}

/** Return a kept plan with its content. */
export const getKeptPlan = (id) => json(planPath(id));

/** Keep a plan in place of a version of it, see `known`. */
export const putKeptPlan = (id, body, version) =>
  json(planPath(id), { method: 'PUT', body, headers: known(version) });

/** Change the name or note of a kept plan. */
export const renameKeptPlan = (id, body, version) =>
  json(planPath(id), { method: 'PATCH', body, headers: known(version) });

/** Delete a kept plan. */
export const deleteKeptPlan = (id, version) =>
  send(planPath(id), { method: 'DELETE', headers: known(version) });

/** Make a link to a kept plan and return it with its token. */
export const postLink = (id) => json(`${planPath(id)}/links`, { method: 'POST' });

/** Return the links of a kept plan. */
export const getLinks = async (id) => (await json(`${planPath(id)}/links`)).links;

/** End a link. */
export const deleteLink = (id, link) =>
  send(`${planPath(id)}/links/${encodeURIComponent(link)}`, { method: 'DELETE' });

/** Return the plan that a link shows. */
export const getSharedPlan = (token) =>
  json('shared-plan', { headers: { 'X-Share-Token': token } });

/** Begin a day and return how it stands. */
export const postDay = (body) => json('days', { method: 'POST', body });

const dayPath = (id) => `days/${encodeURIComponent(id)}`;

/** Return how a day stands, or what of it is at a path. */
export const getDay = (id, path = '') => json(`${dayPath(id)}${path}`);

/** Tell a day something, or ask it, at a path. */
export const postToDay = (id, path, body) =>
  json(`${dayPath(id)}/${path}`, { method: 'POST', body });

/** Follow all that happens on a day, from its beginning until `signal` ends it. */
export async function followDay(id, onEvent, signal) {
  try {
    await follow(`${dayPath(id)}/events`, ({ data }) => onEvent(JSON.parse(data)), signal);
  } catch (error) {
    if (error.name !== 'AbortError') throw error;
  }
}

/**
 * Follow a job to its end and return it without its result.
 *
 * @param onProgress called with each progress
 * @param signal ends the following, by an `AbortError`
 */
export const followJob = (id, onProgress, signal) =>
  follow(`jobs/${encodeURIComponent(id)}/events`, ({ event, data }) => {
    if (event === 'progress') onProgress(JSON.parse(data));
    return event === 'end' ? JSON.parse(data) : null;
  }, signal);

/** Follow a stream, over lost connections too, until `onEvent` returns what it ends with. */
async function follow(path, onEvent, signal) {
  let last = null;
  let ended = null;
  const onEach = (event) => {
    last = event.id ?? last;
    ended = onEvent(event) ?? ended;
  };
  for (let failures = 0; !ended;) {
    try {
      await readEvents(path, last, onEach, signal);
      failures = 0;
    } catch (error) {
      failures += 1;
      const mayPass = error.status === 0 || error.status === 503;
      if (!mayPass || failures > MOST_RESUMES) throw error;
    }
    if (!ended) await new Promise((resolve) => setTimeout(resolve, RESUME_MS));
  }
  return ended;
}

async function readEvents(path, last, onEvent, signal) {
  const { feed } = createParser({ onEvent });
  const headers = { Accept: 'text/event-stream', ...(last && { 'Last-Event-ID': last }) };
  const response = await send(path, { headers, signal });
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) feed(part.value);
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    // The connection broke: the caller resumes after the last event.
  }
}
