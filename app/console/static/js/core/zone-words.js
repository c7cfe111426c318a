/** Published zones of the airspace in words: what they ask for, where they reach, and whose. */

import { clock, number } from './format.js';
import { t } from '../texts.js';

/** Return what a zone is called. */
export function titleOfZone({ name, identifier }) {
  return name && identifier && name !== identifier
    ? `${name} (${identifier})`
    : name || identifier || t('zone.unnamed');
}

/** Return what a zone asks of those who fly. */
export function asksOf({ restriction }) {
  return t(`zone.asks.${restriction}`, { defaultValue: restriction });
}

/** Return from which height to which a zone reaches; null is a height that isn't stated. */
export function reachOf({ lower, upper }) {
  const from = lower
    ? t(`zone.from.${kindOf(lower)}`, { height: heightOf(lower) })
    : t('zone.from.unknown');
  const to = upper
    ? t(`zone.to.${kindOf(upper)}`, { height: heightOf(upper) })
    : t('zone.to.none');
  return `${from} ${to}`;
}

/** Tell whether a zone has a limit above the sea, for which the ground's heights are needed. */
export function isAboveSea({ lower, upper }) {
  return [lower, upper].some((limit) => limit && limit.reference !== 'AGL');
}

/** Return what a zone is, as pairs of a term and its value. */
export function describeZone(zone) {
  return { title: titleOfZone(zone), facts: [
    [t('zone.rule'), asksOf(zone)], [t('zone.reaches'), reachOf(zone)],
    ...(zone.authority ? [[t('zone.whose'), zone.authority]] : [])] };
}

/** Return why a zone keeps drones away, as the service's reply tells it. */
export function closureInWords(zone) {
  const { holds, metres, buffer } = zone;
  return t(`zone.${metres ? 'beside' : 'holds'}.${holds}`, {
    zone: zoneInWords(zone), metres: number(metres ?? 0), buffer: number(buffer ?? 0),
  });
}

/** Return all that is told of a zone. */
export function zoneInWords(zone) {
  const told = t('zone.told', {
    title: titleOfZone(zone), asks: asksOf(zone), reach: reachOf(zone),
  });
  const whose = zone.authority ? t('zone.authority', { authority: zone.authority }) : '';
  const closed = (zone.times ?? []).map(({ begin, end }) =>
    end === null
      ? t('zone.closedFrom', { begin: clock(begin) })
      : t('zone.closed', { begin: clock(begin), end: clock(end) }));
  return [told, whose, ...closed].filter(Boolean).join(' ');
}

function kindOf({ value, reference }) {
  return value === 0 && reference === 'AGL' ? 'ground' : 'height';
}

function heightOf({ value, unit, reference }) {
  return `${number(value)} ${unit.toLowerCase()} ${t(`zone.above.${reference}`)}`;
}
