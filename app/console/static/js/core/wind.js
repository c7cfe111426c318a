/** The wind of a request: steady, by the hour, or as Open-Meteo's forecast tells it. */

import { droneTypes } from './drones.js';
import { dayOf } from './day.js';
import { getIn, removeIn, setIn } from './paths.js';

/** Kinds of wind, in the order in which they are chosen from. */
export const KINDS = ['steady', 'hourly', 'forecast'];

const WIND = ['airspace', 'wind'];

/** Units of speeds, in km/h. */
const KMH = { 'km/h': 1, 'm/s': 3.6, 'mp/h': 1.609344, kn: 1.852 };

/** What of a forecast the service reads. */
const READ = ['time', 'wind_speed_10m', 'wind_direction_10m', 'wind_gusts_10m'];

/** Return how a request states its wind. */
export function kindOfWind({ airspace }) {
  if (Array.isArray(airspace?.wind)) return 'hourly';
  return airspace?.wind?.open_meteo ? 'forecast' : 'steady';
}

/** Return the wind that a parsed file of Open-Meteo holds as a request states it, or null. */
export function forecastOf(content) {
  const hourly = content?.hourly;
  if (!Array.isArray(hourly?.time) || !Array.isArray(hourly.wind_speed_10m)) return null;
  const kept = (from, names) =>
    Object.fromEntries(names.filter((name) => from?.[name] != null).map((name) => [
      name, from[name]]));
  return {
    open_meteo: {
      ...kept(content, ['utc_offset_seconds']),
      hourly_units: kept(content.hourly_units, ['wind_speed_10m', 'wind_gusts_10m']),
      hourly: kept(hourly, READ),
    },
  };
}

/** Return a request with a wind. */
export function withWind(request, wind) {
  return setIn(request, WIND, wind);
}

/**
 * Return the hours of a wind that isn't steady, `{from, speed_kmh, direction_deg, gust_kmh}` each:
 * seconds since plan start; null where that can't be told, or no gust is known.
 */
export function windHours(request) {
  const wind = getIn(request, WIND);
  if (Array.isArray(wind)) return wind;
  return wind?.open_meteo ? hoursOfForecast(wind.open_meteo, dayOf(request)) : [];
}

function hoursOfForecast({ hourly, hourly_units: units, utc_offset_seconds: ahead = 0 }, day) {
  const [kmh, gustKmh] = [units?.wind_speed_10m, units?.wind_gusts_10m].map(
    (unit) => KMH[unit ?? 'km/h'] ?? 1);
  const rounded = (speed, factor) => (speed == null ? null : Number((speed * factor).toFixed(1)));
  return hourly.time.map((time, hour) => ({
    from: day && secondsOf(time, ahead, day),
    speed_kmh: rounded(hourly.wind_speed_10m[hour], kmh),
    direction_deg: hourly.wind_direction_10m?.[hour] ?? null,
    gust_kmh: rounded(hourly.wind_gusts_10m?.[hour], gustKmh),
  }));
}

/** Return the seconds since plan start of an hour: Unix time, or local date and time. */
function secondsOf(time, ahead, day) {
  if (typeof time === 'number') return time - day.start / 1000;
  const isFixed = /(Z|[+-]\d\d:?\d\d)$/.test(time);
  const seconds = day.secondsAt(isFixed ? time : `${time}Z`);
  return seconds === null || isFixed ? seconds : seconds - ahead;
}

/** Return a request whose wind is stated in another way, as much of it as can be. */
export function changeKind(request, kind) {
  if (kind === kindOfWind(request)) return request;
  const hours = windHours(request).filter(({ speed_kmh: speed }) => speed !== null);
  if (kind === 'steady') {
    const [first] = hours;
    return first ? withWind(request, steadyOf(first)) : removeIn(request, WIND);
  }
  if (!hours.length) return withWind(request, [{ from: 0, ...steadyOf(getIn(request, WIND)) }]);
  // Of hours before the plan's start, the last one is what holds from then on.
  const begun = hours.filter(({ from }) => from !== null);
  const first = begun.findLastIndex(({ from }) => from <= 0);
  return withWind(request, begun.slice(Math.max(first, 0)).map((hour) => ({
    ...hour, from: Math.max(hour.from, 0) })));
}

function steadyOf(wind) {
  return { speed_kmh: wind?.speed_kmh ?? 0, direction_deg: wind?.direction_deg ?? 0 };
}

/** Return a request with an hour more. */
export function addHour(request) {
  const hours = getIn(request, WIND);
  const last = hours.at(-1);
  return withWind(request, [...hours, { ...last, from: last.from + 3600 }]);
}

/** Return a request without an hour; the last one that is left stays. */
export function removeHour(request, hour) {
  return getIn(request, WIND).length > 1 ? removeIn(request, [...WIND, hour]) : request;
}

/** Return the names of the types whose drones stay down in an hour, since it blows too much. */
export function staysDown({ fleet }, { speed_kmh: speed, gust_kmh: gust }) {
  const strongest = Math.max(speed ?? 0, gust ?? 0);
  const isTooMuch = ({ max_wind_kmh: most }) => most != null && strongest > most;
  return fleet
    .filter((type) => (type.flies ? [type] : droneTypes(type)).some(isTooMuch))
    .map(({ id }) => id);
}
