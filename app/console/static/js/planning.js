/** Plans: the policy's at once, then what a job improves, until it ends or is stopped. */

import { placeAddresses } from './addressing.js';
import * as api from './api.js';
import { showFailure, shownPlan } from './actions.js';
import { entryAfter } from './core/entries.js';
import { limitOf } from './core/limits.js';
import { planName, unlike } from './core/naming.js';
import { soughtIn } from './core/places.js';
import { furtherFrom } from './core/replanning.js';
import { store } from './store.js';
import { t } from './texts.js';

const MOST_PLANS = 12;

/** If the policy alone takes longer, the job begins, with a plan that is quicker made. */
const MOST_DECODE_SECONDS = 0.3;

let current = null; // {number, controller, job}

function note(patch) {
  store.set(({ run }) => ({ run: { ...run, ...patch } }));
}

/** Plan the problem as it stands, in place of any planning under way. */
export async function plan() {
  // A day that goes on is planned by the service.
  if (!store.get().live && await isPlaced()) {
    const { request } = store.get();
    await run(request, request);
  }
}

/** Look up what the problem states by addresses; return whether it can be planned now. */
async function isPlaced() {
  const { request } = store.get();
  if (!soughtIn(request).length) return true;
  if (current) await stop();
  try {
    await placeAddresses((known, all) =>
      note({ state: 'decoding', waiting: t('run.addresses', { known, all }) }));
  } catch (error) {
    showFailure(error);
    return false;
  } finally {
    note({ state: 'idle', waiting: null });
  }
  return true;
}

/** Search on from the plan that is looked at; settled, pinned, locked and broken stays so. */
export function improvePlan() {
  const { request, locks, live } = store.get();
  const entry = shownPlan(store.get());
  return entry && !live ? run(request, furtherFrom(request, entry, locks)) : undefined;
}

/** Plan for a problem what is `asked`, with the lines of legs and flights, which the map draws. */
async function run(request, asked) {
  const { epoch, plans, config } = store.get();
  const limit = limitOf(asked, config.max_job_seconds);
  const options = { ...asked.options, time_limit: limit.seconds, geometry: true };
  const sent = { ...asked, options };
  if (current) await stop();
  const former = formerOf(store.get(), request);
  const task = {
    number: nextNumber(),
    name: unlike(planName(former, request, asked !== request), plans),
    former,
    epoch,
    controller: new AbortController(),
    job: null,
    began: performance.now(),
  };
  current = task;
  store.set({
    failure: null,
    errors: [],
    run: { state: 'decoding', points: [], message: 'Planning', limit, ...known(task, request) },
  });
  task.request = request;
  await finish(task, async () => {
    const inJob = searches(sent);
    const isQuick = decodeSeconds(sent) <= MOST_DECODE_SECONDS;
    if (inJob && !isQuick) lookForWarnings(request);
    if (!inJob || isQuick) await decode(task, sent);
    if (current === task && inJob) await improve(task, sent);
  });
}

/** Return by what a task is known again after the page was left. */
function known({ number, name, former }, request) {
  return { number, name, former: former?.number ?? null, request };
}

/** Go on with what was being planned when the page was left, see `known`; `job` is its job. */
export async function resume({ number, name, former, request, job }) {
  if (!job) {
    await plan();
    return;
  }
  const { epoch, plans } = store.get();
  const task = {
    number,
    name,
    former: plans.find((entry) => entry.number === former) ?? null,
    request,
    epoch,
    job,
    controller: new AbortController(),
    began: performance.now(),
  };
  current = task;
  const limit = limitOf(request, store.get().config.max_job_seconds);
  const run = { state: 'improving', points: [], message: 'Planning', job, limit };
  store.set({ run: { ...run, ...known(task, request) } });
  await finish(task, () => follow(task));
}

/** Do the work of a task, and tell what goes wrong. */
async function finish(task, work) {
  try {
    await work();
  } catch (error) {
    if (current === task) showFailure(error);
  } finally {
    if (current === task) {
      current = null;
      note({ state: 'idle' });
    }
  }
}

/** Ask for warnings where the first plan, which has them, is long in coming. */
async function lookForWarnings(request) {
  try {
    const { warnings } = await api.postWarnings(request);
    if (store.get().request === request) store.set({ warned: { request, warnings } });
  } catch {
    // What is wrong with the request, or the service, is told by planning itself.
  }
}

/** Stop planning and keep the best plan so far. */
export async function stop() {
  const task = current;
  if (!task) return;
  note({ state: 'stopping' });
  try {
    if (task.job) {
      const job = await api.stopJob(task.job);
      if (job.result) keepAndNote(task, job.result);
    }
  } catch (error) {
    showFailure(error);
  } finally {
    task.controller.abort();
    if (current === task) current = null;
    note({ state: 'idle', message: 'Stopped' });
  }
}

function nextNumber() {
  const { plans } = store.get();
  return plans.length ? plans[plans.length - 1].number + 1 : 1;
}

/** @param {{options?: Options}} request */
function searches({ options = {} }) {
  return options.time_limit !== 0 && options.search_iterations !== 0;
}

/**
 * Return about how long the policy takes on a quiet machine, as the planner reckons it.
 *
 * @param {{customers: any[], options?: Options}} request
 */
function decodeSeconds({ customers, options = {} }) {
  const samples = options.decoding === 'sample' ? 1 + (options.num_samples ?? 64) / 6 : 1;
  return 1.2e-4 * customers.length * (1 + customers.length / 300) * samples;
}

async function decode(task, request) {
  const options = { ...request.options, time_limit: 0 };
  delete options.search_iterations;
  const reply = await api.postPlan({ ...request, options }, task.controller.signal);
  keepAndNote(task, reply);
}

async function improve(task, request) {
  note({ state: 'improving' });
  const job = await api.startJob('jobs', request);
  task.job = job.id;
  if (current !== task) {
    await api.stopJob(job.id);
    return;
  }
  note({ job: job.id });
  await follow(task);
}

/** Follow the job of a task to its end. */
async function follow(task) {
  const fetching = latestOf(async () => {
    const { result } = await api.getJob(task.job);
    if (result && current === task) keep(task, result);
  });
  await api.followJob(
    task.job,
    (progress) => {
      if (current !== task) return;
      note({
        share: progress.progress,
        iterations: progress.search_iterations,
        waiting: progress.waiting_for ? t('run.waiting', { what: progress.waiting_for }) : null,
      });
      if (progress.cost !== null && progress.cost !== undefined) addPoint(task, progress.cost);
      if (progress.improved) fetching();
    },
    task.controller.signal);
  const ended = await api.getJob(task.job);
  if (current !== task) return;
  if (ended.error) throw new api.ApiError(0, t('failed.search'), ended.error);
  if (ended.result) keepAndNote(task, ended.result);
}

/** Return a function that runs `work` again only when it has ended, and once more if asked to. */
export function latestOf(work) {
  let running = false;
  let again = false;
  return async function run() {
    if (running) {
      again = true;
      return;
    }
    running = true;
    try {
      await work();
    } catch (error) {
      showFailure(error);
    } finally {
      running = false;
      if (again) {
        again = false;
        run();
      }
    }
  };
}

function keepAndNote(task, reply) {
  keep(task, reply);
  addPoint(task, reply.cost.total);
}

/** Show a reply as the plan of a task, unless a cheaper one is there already. */
function keep(task, reply) {
  store.set((state) => {
    if (task.epoch !== state.epoch) return {};
    const before = state.plans.find(({ number }) => number === task.number);
    if (before && before.plan.cost.total < reply.cost.total) return {};
    const entry = entryAfter(task.former, {
      number: task.number, name: before?.name ?? task.name, request: task.request, plan: reply,
    });
    const others = state.plans.filter(({ number }) => number !== task.number);
    const besides = before ? state.besides : (task.former?.number ?? null);
    return { plans: [...others.slice(-MOST_PLANS), entry], shown: task.number, besides };
  });
}

/** Return the entry that a new plan is to be seen beside: what it goes on from, if any. */
function formerOf(state, { replan }) {
  return state.plans.find(({ plan: other }) => other === replan?.plan) ?? shownPlan(state);
}

function addPoint(task, cost) {
  const seconds = (performance.now() - task.began) / 1000;
  store.set(({ run }) => {
    const last = run.points[run.points.length - 1];
    const lowest = last ? Math.min(last.cost, cost) : cost;
    return { run: { ...run, points: [...run.points, { seconds, cost: lowest }] } };
  });
}
