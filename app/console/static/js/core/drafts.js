/**
 * What is worked on, as records that the browser keeps: a head, which says how all belongs
 * together, and parts: requests and plans, which never change once made, so each is written once.
 */

import { trueCost } from './terms.js';

/** Most undos that are kept. */
const MOST_PAST = 20;

/** What of the state is kept as it is, with the head. */
const PLAIN = [
  'name', 'note', 'home', 'shown', 'besides', 'tab', 'scenarioSeconds', 'keptFleets', 'sweepAxes',
  'doubts', 'locks'];

/** What of the state has to be kept anew when it is another. */
const KEPT = [...PLAIN, 'request', 'stated', 'past', 'ahead', 'plans', 'saved', 'scenario'];

/** Return a function that names objects: the same while they live. */
export function identifier(makeId) {
  const ids = new WeakMap();
  const identify = (value) => {
    if (!ids.has(value)) ids.set(value, makeId());
    return ids.get(value);
  };
  identify.note = (value, id) => ids.set(value, id);
  return identify;
}

/** Tell whether two states are kept as the same. */
export function isKeptAlike(before, after) {
  return (
    KEPT.every((field) => before[field] === after[field]) && jobOf(before) === jobOf(after));
}

function jobOf({ run }) {
  return run.state === 'idle' ? null : (run.job ?? run.number);
}

/**
 * Return a state as `{head, parts}`.
 *
 * @param identify names objects, see `identifier`
 */
export function pack(state, identify) {
  const parts = new Map();
  const bases = {}; // of requests that go on from a plan: the plan's part
  const keep = (value) => {
    if (!value) return null;
    const id = identify(value);
    parts.set(id, value);
    return id;
  };
  const keepRequest = (request) => {
    const id = keep(request);
    const basis = request?.replan?.plan;
    if (!basis || bases[id]) return id;
    bases[id] = keep(basis);
    // The plan is one of the parts already; whoever goes on from it goes by which it is.
    parts.set(id, { ...request, replan: { ...request.replan, plan: null } });
    return id;
  };
  const { run, saved, scenario } = state;
  const head = {
    ...Object.fromEntries(PLAIN.map((field) => [field, state[field]])),
    request: keepRequest(state.request),
    stated: keepRequest(state.stated),
    past: state.past.slice(-MOST_PAST).map(keepRequest),
    ahead: state.ahead.slice(-MOST_PAST).map(keepRequest),
    plans: state.plans.map((entry) => ({
      ...entry, request: keepRequest(entry.request), plan: keep(entry.plan),
    })),
    saved: saved && { request: keepRequest(saved.request), plan: keep(saved.plan) },
    run:
      run.state === 'idle'
        ? null
        : {
            number: run.number, name: run.name, former: run.former, job: run.job ?? null,
            request: keepRequest(run.request),
          },
    scenario: scenario && { ...scenario, body: keep(scenario.body), result: keep(scenario.result) },
    isTrivial: !state.home && !isUnsaved(state),
    customers: state.request?.customers?.length ?? 0,
    cost: costOf(state.plans.find(({ number }) => number === state.shown)),
  };
  return { head: { ...head, bases }, parts };
}

function costOf(entry) {
  return entry ? trueCost(entry) : null;
}

/**
 * Return the part of the state that a head and its parts make, or null where one is missing.
 *
 * @param parts a map by id
 * @param identify names objects: those returned have the names of their parts
 */
export function unpack(head, parts, identify) {
  if (partsOf(head).some((id) => !parts.has(id))) return null;
  const whole = new Map(parts);
  for (const [id, basis] of Object.entries(head.bases)) {
    const request = parts.get(id);
    whole.set(id, { ...request, replan: { ...request.replan, plan: parts.get(basis) } });
  }
  whole.forEach((value, id) => identify.note(value, id));
  const part = (id) => (id ? whole.get(id) : null);
  return {
    ...Object.fromEntries(
      PLAIN.filter((field) => field in head).map((field) => [field, head[field]])),
    request: part(head.request),
    ...(head.stated && { stated: part(head.stated) }),
    past: head.past.map(part),
    ahead: (head.ahead ?? []).map(part),
    plans: head.plans.map((entry) => ({
      ...entry, request: part(entry.request), plan: part(entry.plan),
    })),
    saved: head.saved && { request: part(head.saved.request), plan: part(head.saved.plan) },
    cut: head.run && { ...head.run, request: part(head.run.request) },
    scenario: head.scenario && {
      ...head.scenario, body: part(head.scenario.body), result: part(head.scenario.result),
    },
  };
}

/** Return the ids of all parts that a head needs. */
export function partsOf(head) {
  const { request, stated, past, ahead = [], plans, saved, run, scenario, bases } = head;
  const ids = [
    request,
    stated,
    ...past,
    ...ahead,
    ...plans.flatMap((entry) => [entry.request, entry.plan]),
    saved?.request,
    saved?.plan,
    run?.request,
    scenario?.body,
    scenario?.result,
    ...Object.values(bases)];
  return [...new Set(ids.filter(Boolean))];
}

/**
 * Tell whether what is open differs from what is kept by a name, or is kept by none.
 *
 * What was only opened, such as an example, has nothing to lose.
 */
export function isUnsaved(state) {
  const { request, saved, home } = state;
  if (!request) return false;
  if (!saved || saved.request !== request) return true;
  return Boolean(home) && planToSave(state) !== saved.plan;
}

/** Return the plan that is looked at, or null if it is one of the problem as it was before. */
export function planToSave({ request, plans, shown }) {
  const entry = plans.find(({ number }) => number === shown);
  return entry?.request === request ? entry.plan : null;
}
