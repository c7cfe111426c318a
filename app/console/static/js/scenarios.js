/** Comparisons and sweeps: jobs that plan a problem in several ways. */

import { editedTo, openTab, showFailure, shownPlan } from './actions.js';
import * as api from './api.js';
import { entryAfter } from './core/entries.js';
import { planName, unlike } from './core/naming.js';
import { store } from './store.js';

const FINAL = ['done', 'failed', 'cancelled'];

let controller = null;

function note(patch) {
  store.set(({ scenario }) => ({ scenario: scenario && { ...scenario, ...patch } }));
}

/** Start a comparison or sweep and follow it. `kind` is `compare` or `sweep`. */
export async function startScenario(kind, body) {
  await stopScenario();
  const own = new AbortController();
  controller = own;
  store.set({
    scenario: { kind, body, state: 'queued', progress: 0, result: null, job: null },
    failure: null,
    errors: [],
  });
  await finish(own, async () => {
    const job = await api.startJob(kind, body);
    note({ job: job.id, state: job.state });
    await follow(own, job.id);
  });
}

/** Go on with the comparison or sweep that was under way when the page was left. */
export async function resumeScenario() {
  const { scenario } = store.get();
  if (!scenario || FINAL.includes(scenario.state)) return;
  if (!scenario.job) {
    store.set({ scenario: null });
    return;
  }
  const own = new AbortController();
  controller = own;
  await finish(own, () => follow(own, scenario.job));
}

async function follow(own, id) {
  await api.followJob(
    id,
    async (progress) => {
      if (controller !== own) return;
      note({ progress: progress.progress, state: progress.state });
      if (progress.improved) {
        const { result } = await api.getJob(id);
        if (controller === own && result && store.get().scenario?.state !== 'done')
          note({ result });
      }
    },
    own.signal);
  const ended = await api.getJob(id);
  if (controller === own)
    note({ state: ended.state, progress: 1, result: ended.result, error: ended.error });
}

/** Do the work of a comparison or sweep, and tell what goes wrong. */
async function finish(own, work) {
  try {
    await work();
  } catch (error) {
    if (controller === own) {
      store.set({ scenario: null });
      const { title, message, errors = [] } = error;
      showFailure({ ...error, title, message, errors: errors.map((entry) => ({
        ...entry, path: entry.path.replace(/^\$\.base\b/, '$'),
      })) });
    }
  }
}

/** Stop the comparison or sweep under way; what it found stays. */
export async function stopScenario() {
  const scenario = store.get().scenario;
  if (!scenario?.job || FINAL.includes(scenario.state)) return;
  try {
    const { state, result } = await api.stopJob(scenario.job);
    note({ state, result });
  } catch (error) {
    showFailure(error);
  } finally {
    controller?.abort();
  }
}

/** Show a plan that a scenario found as one of the plans; without a name, by what changed. */
export function showScenarioPlan(request, plan, name = null) {
  store.set((state) => {
    const number = (state.plans.at(-1)?.number ?? 0) + 1;
    const former = shownPlan(state);
    const entry = entryAfter(former, {
      number,
      name: unlike(name ?? planName(former, request), state.plans),
      request,
      plan,
    });
    return {
      plans: [...state.plans, entry], shown: number, besides: state.shown,
      ...editedTo(state, request), selection: null, hover: null,
    };
  });
  openTab('changes');
}

/** Fetch the plan of a scenario's own job and show it. */
export async function showScenarioJob(id, request) {
  try {
    const { result } = await api.getJob(id);
    if (result) showScenarioPlan(request, result);
  } catch (error) {
    showFailure(error);
  }
}
