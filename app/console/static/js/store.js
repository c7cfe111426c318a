/** The state that all views share, and how they follow it. */

import { useEffect, useState } from './libraries.js';

/** Return a store that holds one object. */
export function createStore(initial) {
  let state = initial;
  const listeners = new Set();
  return {
    get: () => state,
    set(patch) {
      state = { ...state, ...(typeof patch === 'function' ? patch(state) : patch) };
      listeners.forEach((listener) => listener(state));
    },
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

export const store = createStore({
  schemas: null, // of /openapi.json
  examples: [], // {name, summary, request}
  config: { policies: [], tile_url: null, tile_attribution: '' },
  request: null, // the problem as it is edited
  epoch: 0, // counts the problems that were opened
  past: [], // requests before the last edits
  plans: [], // {number, request, plan}, the newest last
  shown: null, // number of the plan that is looked at
  besides: null, // number of the plan that stands beside it
  why: { plan: null, answers: new Map() }, // what was asked about a plan, by customer
  run: { state: 'idle', points: [], message: '' },
  errors: [], // {keys, path, message, code} of a refused request
  failure: null, // {title, detail}
  selection: null, // key of what is selected, see core/plan.js
  hover: null,
  time: null, // instant of the playback, seconds
  playing: false,
  speed: 600, // seconds of the day per second
  tab: 'customers',
  tool: null, // what is drawn on the map, see map/tools.js
  brush: {
    demand: [1],
    service_duration: 300,
    served_by: 'either',
    earliest: 28800,
    latest: 43200,
  },
  dialog: null, // name of the open dialog
  dark: false,
  starting: null, // {detail, progress} until the service is ready
  scenario: null, // comparison or sweep and its job
  scenarioSeconds: 1,
  keptFleets: {}, // fleets by name, to compare
  sweepAxes: [
    { path: 'fleet[*].max_working_duration', text: '4:00, 6:00, 8:00, 10:00' },
    { path: 'fleet[*].capacity[0]', text: '100, 150, 200' },
  ],
  sheet: null, // an imported sheet that is looked over
});

/** Follow a part of the state. */
export function useStore(select) {
  const [value, setValue] = useState(() => select(store.get()));
  useEffect(() => {
    const follow = (state) => setValue(() => select(state));
    follow(store.get());
    return store.subscribe(follow);
  }, []);
  return value;
}
