/** The plans that were made, what runs, and what is asked about a plan. */

import { NOTHING_TYPED } from '../core/orders.js';

export const PLANS = {
  plans: [], // {number, name, request, plan, numbers}, the newest last, see core/entries.js
  shown: null, // number of the plan that is looked at
  besides: null, // number of the plan that stands beside it
  run: { state: 'idle', points: [], message: '' },
  errors: [], // {keys, path, message, code} of a refused request
  failure: null, // {title, detail}
  steps: [], // changes of plans by hand, the newest last, see hands.js
  undone: [], // those that were taken back, the newest last
  judging: null, // what was done by hand and is being judged, in words
  locks: [], // customers who stay with their vehicles where a plan is improved
  fit: null, // {customer, entry, base, isOrder, told}: the best places of a customer, see hands.js
  order: NOTHING_TYPED, // what is typed of an order that comes in
  why: { plan: null, answers: new Map() }, // what was asked about a plan, by customer
  prices: { plan: null, found: new Map() }, // of remedies in a plan, by their group
  dispatch: null, // a plan on the road: its reply, links by id as made, its plan if known
  live: null, // the day that is followed, see living.js
  untold: null, // what drivers told, while it is asked whether others were served
  onTheRoad: null, // plans on the road that may be followed, once they were asked for
};
