/** Why a customer is served where it is, in words: what else there is, and what binds. */

import { droneCount } from './drones.js';
import { clock, money, number, signed, timeWindow } from './format.js';
import { endsInWords } from './end-words.js';
import { saidOf } from './said.js';
import { costTerms } from './terms.js';
import { windowsOf } from './windows.js';
import { zoneInWords } from './zone-words.js';
import { t } from '../texts.js';
import { nameOfVehicle } from './vehicle-labels.js';

/** So many other vehicles are shown at first. */
export const FIRST_SHOWN = 6;

/** What is called more of when there is a unit more of it; all else is `more`. */
const MORE = {
  'time_window.latest': 'later', 'time_window.earliest': 'earlier', release_time: 'earlier',
  max_time_aboard: 'longer', 'shift.latest': 'later', 'breaks.start.latest': 'later',
  max_time_between: 'longer', 'fairness.min_vehicles': 'fewer',
};

/** Rules that are a customer's: what they are called says so. */
const ITS_OWN = [
  'time_window.latest', 'time_window.earliest', 'release_time', 'max_time_aboard',
  'max_time_between', 'vehicles', 'served_by', 'skills', 'goods', 'relations'];

/** Rules by which drones alone are held. */
const OF_DRONES = new Set([
  'AIRSPACE', 'PAYLOAD', 'ENDURANCE', 'ENERGY', 'BATTERIES', 'CHARGERS', 'WIND', 'MAX_RANGE',
  'LAUNCH', 'SERVED_BY']);

/**
 * Return the rows of a table: `{key, what, where, cost, terms, feasible, reasons}`.
 *
 * @param visits among whom are the ends of a shipment that is told of
 */
export function alternativeRows(alternatives, customer, visits = []) {
  return alternatives.map((item, position) => ({
    key: `${item.kind}/${item.vehicle}/${item.window}/${position}`,
    kind: item.kind,
    what: whatInWords(item, visits.find(({ id }) => id === item.window_at) ?? customer),
    where: whereInWords(item),
    cost: signed(item.cost.total, money),
    terms: costTerms(item.cost)
      .map(([term, name]) => `${name} ${signed(item.cost[term], money)}`)
      .join(', '),
    feasible: item.feasible,
    reasons: item.reasons.map(saidOf),
  }));
}

/** Tell whether it is a truck's drone that comes; vehicles that fly by themselves come as such. */
export function isOnSortie({ position }) {
  return Boolean(position?.recovered_at);
}

function whoseOf(item) {
  const vehicle = nameOfVehicle(item.vehicle);
  return isOnSortie(item) ? t('place.drone', { vehicle }) : vehicle;
}

function whoInWords(item) {
  const who = whoseOf(item);
  const { companions } = item;
  return companions ? t('why.goingAlong', { who, names: companions.join(', ') }) : who;
}

function whatInWords(item, customer) {
  const { kind, by, window } = item;
  if (kind === 'unassigned') return t('why.notAtAll');
  const who = whoInWords(item);
  if (kind === 'place') return t('why.elsewhere', { who });
  if (kind === 'window') {
    const only = t('why.only', { window: timeWindow(windowsOf(customer)[window]), who });
    return item.window_at ? `${item.window_at}: ${only}` : only;
  }
  return kind === 'by' && by === 'truck' ? t('why.byTruck', { who }) : t('why.by', { who });
}

function whereInWords(item) {
  const { position, service_start: start } = item;
  if (!position) return '';
  const ends = endsInWords(item);
  if (ends) return ends;
  const at = clock(start);
  if (isOnSortie(item)) {
    return t('place.flight', { from: position.after, back: position.recovered_at, at });
  }
  const where = position.own_trip
    ? t('place.onOwnTrip')
    : t('place.after', { stop: position.after });
  return `${where}, ${at}`;
}

/**
 * Return why no drone serves a customer, as sentences; empty where one does, or none could.
 *
 * @param told what was told of the customer
 * @param request in which customer and vehicles stand
 */
export function noDroneInWords(
  { here, zones = [], alternatives, reasons = [] },
  request,
  customer,
) {
  if (here?.by === 'drone' || !request.fleet.some((type) => type.flies || droneCount(type) > 0)) {
    return [];
  }
  const own = customer.served_by === 'truck' ? [t('why.noDrone.byTruck')] : [];
  const inZones = zones.map((zone) => t('why.noDrone.zone', { zone: zoneInWords(zone) }));
  const flown = alternatives.filter(({ by }) => by === 'drone');
  const told = flown.map((item) => t('why.noDrone.each', {
    who: whoseOf(item),
    why: item.feasible
      ? t('why.noDrone.costs', { sum: signed(item.cost.total, money) })
      : item.reasons.map(saidOf).join('; '),
  }));
  const left = reasons
    .filter(({ vehicle_type: id, code }) => isOfDrones(request, id, code))
    .map((reason) => t('why.noDrone.each', { who: reason.vehicle_type, why: saidOf(reason) }));
  const found = [...new Set([...own, ...inZones, ...left, ...told])];
  return found.length ? found : [t('why.noDrone.untried')];
}

/** Tell whether a reason why a customer is left out is one of what flies. */
function isOfDrones({ fleet }, id, code) {
  return fleet.some((type) => type.id === id && (type.flies || OF_DRONES.has(code)));
}

/**
 * Return a sentence for a limit that binds, or a rule without a number.
 *
 * @param id of whom it is told; a limit of one of its ends names that
 */
export function bindingInWords({ rule, at, slack, unit, saves_per_unit: saves }, id = at) {
  const [, part] = /^(?:drones|breaks)\[(.+)\](?:\.|$)/.exec(rule) ?? [];
  const field = rule
    .replace(/^time_windows\[-?\d+\]/, 'time_window')
    .replace(/^(drones|breaks)\[.+\](?=\.|$)/, '$1')
    .replace(/\[\d+\]$/, '');
  const told = t(`rule.${field.replaceAll('.', '_')}`, { defaultValue: rule });
  const name = part ? t('why.of', { what: told, whose: part }) : told;
  const isIts = ITS_OWN.includes(field) && at === id;
  const subject = isIts || !at ? name : t('why.of', { what: name, whose: at });
  const sum = money(saves);
  if (unit === 'rule') return t('why.without', { subject, sum });
  const more = t(`why.unit.${MORE[field] ?? 'more'}`, { unit: unitOf(unit, 1) });
  const one = unit === 'unit' ? t('why.oneMore') : more;
  const left = slack > 0
    ? ` (${t('why.left', { amount: `${number(slack)} ${unitOf(unit, slack)}` })})`
    : '';
  return saves > 0
    ? t('why.saves', { subject: subject + left, one, sum })
    : t('why.saveNothing', { subject, one });
}

function unitOf(unit, count) {
  return t(`unit.${unit}`, { count, defaultValue: unit });
}

/** Return sentences on what drones save in sum. */
export function drones(told, cost) {
  const { saves, saves_at_most: most, seconds } = told;
  if (saves === null && most === null) {
    const out = (told.trucks_alone?.unassigned ?? 0) > (told.with_drones?.unassigned ?? 0);
    return [out ? t('why.drones.leaveOut') : t('why.drones.unknown')];
  }
  const share = cost > 0
    ? ` (${t('why.drones.share', { share: number((100 * most) / cost, 1) })})`
    : '';
  const sentences = [];
  if (saves !== null) {
    const searched = { sum: money(saves), seconds: number(seconds, 1) };
    sentences.push(t('why.drones.save', searched));
  }
  if (most !== null) {
    sentences.push(t('why.drones.atMost', { sum: signed(most, money) + share }));
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
