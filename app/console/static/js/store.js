/** The state that all views share, and how they follow it. */

import { tellBy } from './core/format.js';
import { useEffect, useState } from './libraries.js';
import { NOTHING_TYPED } from './core/orders.js';
import { language } from './texts.js';

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
  config: {
    policies: [],
    tile_url: null,
    tile_attribution: '',
    streets: [],
    max_job_seconds: Infinity,
  },
  request: null, // the problem as it is edited, all its times in seconds
  stated: null, // the problem as it was opened
  name: '', // of the problem, and what is noted with it
  note: '',
  home: null, // {where, id, version} of the kept plan that is open, see keeping/kept.js
  saved: null, // {request, plan} as they are kept, or were opened
  viewing: null, // token of the link by which a shared plan is looked at
  unkept: null, // why the browser doesn't keep what is done here
  epoch: 0, // counts the problems that were opened
  past: [], // requests before the last edits
  ahead: [], // those that were undone, the one undone last at the end
  plans: [], // {number, name, request, plan, numbers}, the newest last, see core/entries.js
  shown: null, // number of the plan that is looked at
  besides: null, // number of the plan that stands beside it
  steps: [], // changes of plans by hand, the newest last, see hands.js
  undone: [], // those that were taken back, the newest last
  judging: null, // what was done by hand and is being judged, in words
  locks: [], // customers who stay with their vehicles where a plan is improved
  fit: null, // {customer, entry, base, isOrder, told}: the best places of a customer, see hands.js
  order: NOTHING_TYPED, // what is typed of an order that comes in
  why: { plan: null, answers: new Map() }, // what was asked about a plan, by customer
  prices: { plan: null, found: new Map() }, // of remedies in a plan, by their group
  run: { state: 'idle', points: [], message: '' },
  errors: [], // {keys, path, message, code} of a refused request
  failure: null, // {title, detail}
  warned: null, // {request, warnings} that were asked for before there is a plan
  dismissed: [], // keys of warnings that are not shown, see core/warned.js
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
  language: language(), // of the texts
  starting: null, // {detail} until the service is ready
  scenario: null, // comparison or sweep and its job
  scenarioSeconds: null, // of each scenario; null: as long as fits the problem
  keptFleets: {}, // fleets by name, to compare
  sweepAxes: null, // `[{path, text}]` as chosen; null: around the fleet at hand
  dispatch: null, // a plan on the road: its reply, links by id as made, its plan if known
  onTheRoad: null, // plans on the road that may be followed, once they were asked for
  keeping: null, // a dialog about kept plans, see keeping/kept.js
  doubts: {}, // of where customers are, by key, see core/places.js
  importing: null, // a sheet that is looked over, see importing.js
});

// Before any view: all of them tell times and money alike.
store.subscribe(({ request }) => tellBy(request));

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
