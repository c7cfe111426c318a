/** The state that all views share, and how they follow it. */

import { tellBy } from './core/format.js';
import { callBy } from './core/vehicle-labels.js';
import { useEffect, useState } from './libraries.js';
import { LOOKING } from './state/looking.js';
import { PLANS } from './state/plans.js';
import { PROBLEM } from './state/problem.js';
import { SCENARIOS } from './state/scenarios.js';
import { SERVICE } from './state/service.js';

/**
 * Return a store that holds one object.
 *
 * @template T
 * @param {T} initial
 */
export function createStore(initial) {
  let state = initial;
  /** @type {Set<(state: T) => void>} */
  const listeners = new Set();
  return {
    get: () => state,
    /** @param {Partial<T> | ((state: T) => Partial<T>)} patch */
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

/** @typedef {ReturnType<typeof initial>} State */

function initial() {
  return { ...SERVICE, ...PROBLEM, ...PLANS, ...LOOKING, ...SCENARIOS };
}

export const store = createStore(initial());

// Before any view: all of them tell times and money alike.
store.subscribe(({ request }) => {
  tellBy(request);
  if (request) callBy(request.fleet);
});

/**
 * Follow a part of the state.
 *
 * @template T
 * @param {(state: State) => T} select
 * @returns {T}
 */
export function useStore(select) {
  const [value, setValue] = useState(() => select(store.get()));
  useEffect(() => {
    const follow = (state) => setValue(() => select(state));
    follow(store.get());
    return store.subscribe(follow);
  }, []);
  return value;
}
