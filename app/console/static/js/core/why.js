/** Why a customer is served where it is, in words: what else there is, and what binds. */

import { clock, money, number, signed, timesInWords, timeWindow } from './format.js';
import { costTerms } from './terms.js';
import { windowsOf } from './windows.js';

/** So many other vehicles are shown at first. */
export const FIRST_SHOWN = 6;

/** What is reached, by the field that states it, and what a unit more of it is called. */
const RULES = {
  'time_window.latest': ['the end of its window', 'later'],
  'time_window.earliest': ['the beginning of its window', 'earlier'],
  release_time: ['its release', 'earlier'],
  max_time_aboard: ['its time aboard', 'longer'],
  capacity: ['the capacity', 'more'],
  'shift.latest': ['the end of the shift', 'later'],
  max_working_duration: ['the longest working duration', 'more'],
  max_trip_distance: ['the longest trip', 'more'],
  'drones.endurance': ['the endurance', 'more'],
  'drones.turnaround.batteries': ['the number of batteries', 'more'],
  'drones.turnaround.charge_w': ['the power to charge drones', 'more'],
  'drones.energy.battery_wh': ['the battery of drones', 'more'],
  'drones.capacity': ['the drone capacity', 'more'],
  count: ['the number', 'more'],
  max_trips: ['the most trips', 'more'],
  'overtime.max_duration': ['the overtime', 'more'],
  max_stops: ['the most stops on a trip', 'more'],
  max_sorties: ['the most sorties on a trip', 'more'],
  vehicles: ['which vehicles may serve it'],
  served_by: ['whether a truck or a drone must serve it'],
  skills: ['the skills that it needs'],
  goods: ['its goods, kept apart from others'],
  pickups: ['the order of pickups'],
};

/** Return the rows of a table: `{key, what, where, cost, terms, feasible, reasons}`. */
export function alternativeRows(alternatives, customer) {
  return alternatives.map((item, position) => ({
    key: `${item.kind}/${item.vehicle}/${item.window}/${position}`,
    kind: item.kind,
    what: whatInWords(item, customer),
    where: whereInWords(item),
    cost: signed(item.cost.total, money),
    terms: costTerms(item.cost)
      .map(([term, name]) => `${name} ${signed(item.cost[term], money)}`)
      .join(', '),
    feasible: item.feasible,
    reasons: item.reasons.map(({ message }) => timesInWords(message)),
  }));
}

function whatInWords({ kind, vehicle, by, window }, customer) {
  if (kind === 'unassigned') return 'Not at all';
  const who = by === 'drone' ? `a drone of ${vehicle}` : vehicle;
  if (kind === 'place') return `Elsewhere with ${who}`;
  if (kind === 'window') return `Only ${timeWindow(windowsOf(customer)[window])}, by ${who}`;
  return kind === 'by' && by === 'truck' ? `By truck, ${who}` : `By ${who}`;
}

function whereInWords({ position, by, service_start: start }) {
  if (!position) return '';
  const at = clock(start);
  if (by === 'drone') return `from ${position.after}, back at ${position.recovered_at}, ${at}`;
  return position.own_trip ? `on a trip of its own, ${at}` : `after ${position.after}, ${at}`;
}

/** Return a sentence for a limit that binds, or a rule without a number. */
export function bindingInWords({ rule, at, slack, unit, saves_per_unit: saves }) {
  const [, drones] = /^drones\[(.+)\]\./.exec(rule) ?? [];
  const field = rule
    .replace(/^time_windows\[-?\d+\]/, 'time_window')
    .replace(/^drones\[.+\]\./, 'drones.')
    .replace(/\[\d+\]$/, '');
  const [told, more] = RULES[field] ?? [rule, 'more'];
  const name = drones && RULES[field] ? `${told} of ${drones}` : told;
  const whose = /^its |its window| it( |$)/.test(name) ? '' : ` of ${at}`;
  const subject = name.charAt(0).toUpperCase() + name.slice(1) + whose;
  if (unit === 'rule') return `${subject}: without this rule ${money(saves)} would be saved.`;
  const one = unit === 'unit' ? `one ${more}` : `one ${unit} ${more}`;
  const left = slack > 0 ? ` (${number(slack)} ${plural(unit, slack)} left)` : '';
  if (saves > 0) return `${subject}${left}: ${one} would save ${money(saves)}.`;
  return `${subject} is reached: ${one} would save nothing.`;
}

function plural(unit, value) {
  return unit === 'km' || unit === 'Wh' || unit === 'W' || value === 1 ? unit : `${unit}s`;
}

/** Return sentences on what drones save in sum. */
export function drones(told, cost) {
  const { saves, saves_at_most: most, seconds } = told;
  if (saves === null && most === null) {
    const out = (told.trucks_alone?.unassigned ?? 0) > (told.with_drones?.unassigned ?? 0);
    return [out ? 'Trucks alone would leave out more customers.'
      : 'No figure in sum can be told of this plan.'];
  }
  const share = cost > 0 ? ` (${number((100 * most) / cost, 1)} % of this plan)` : '';
  const sentences = [];
  if (saves !== null) {
    sentences.push(`Drones save ${money(saves)} against trucks alone: two searches of ` +
      `${number(seconds, 1)} s from the same plan, one without drones.`);
  }
  if (most !== null) {
    sentences.push(`Against this plan trucks alone cost ${signed(most, money)}${share}: at most ` +
      'that much is saved, as this plan may have been searched for longer.');
  }
  return sentences;
}

/** Return how many sorties save nothing, cost something, can't be driven and weren't tried. */
export function countWorth(sorties) {
  const tried = sorties.filter(({ tried: wasTried }) => wasTried);
  return {
    useless: tried.filter(savesNothing).length,
    needed: tried.filter(({ saves }) => saves === null).length,
    untried: sorties.length - tried.length,
  };
}

/** Tell whether a sortie was found to save nothing. */
export function savesNothing({ tried, saves }) {
  return tried && saves !== null && saves < 0.005;
}
