/** Comparisons and sweeps: jobs that plan a problem in several ways. */

import { openTab, showFailure } from './actions.js';
import * as api from './api.js';
import { store } from './store.js';

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
  try {
    const job = await api.startJob(kind, body);
    note({ job: job.id, state: job.state });
    await api.followJob(
      job.id,
      async (progress) => {
        if (controller !== own) return;
        note({ progress: progress.progress, state: progress.state });
        if (progress.improved) {
          const { result } = await api.getJob(job.id);
          if (controller === own && result && store.get().scenario?.state !== 'done')
            note({ result });
        }
      },
      own.signal,
    );
    const ended = await api.getJob(job.id);
    if (controller === own)
      note({ state: ended.state, progress: 1, result: ended.result, error: ended.error });
  } catch (error) {
    if (controller === own) {
      store.set({ scenario: null });
      showFailure({
        ...error,
        title: error.title,
        message: error.message,
        errors: (error.errors ?? []).map((entry) => ({
          ...entry,
          path: entry.path.replace(/^\$\.base\b/, '$'),
        })),
      });
    }
  }
}

/** Stop the comparison or sweep under way; what it found stays. */
export async function stopScenario() {
  const scenario = store.get().scenario;
  if (!scenario?.job || ['done', 'failed', 'cancelled'].includes(scenario.state)) return;
  try {
    const { state, result } = await api.stopJob(scenario.job);
    note({ state, result });
  } catch (error) {
    showFailure(error);
  } finally {
    controller?.abort();
  }
}

/** Show a plan that a scenario found as one of the plans. */
export function showScenarioPlan(request, plan) {
  store.set((state) => {
    const number = (state.plans.at(-1)?.number ?? 0) + 1;
    return {
      plans: [...state.plans, { number, request, plan }],
      shown: number,
      besides: state.shown,
      request,
      past: [...state.past, state.request],
      selection: null,
      hover: null,
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
