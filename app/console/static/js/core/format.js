/** Numbers and times as people read them, and back. Times in seconds, distances in metres. */

import { dayOf } from './day.js';
import { language, t } from '../texts.js';

const MINUS = '\u2212';

let shownDay = null;
let shownCurrency = '';
let shownUnits = []; // of the dimensions of loads

/** Tell instants by a problem's day from now on, money in its currency, loads in its units. */
export function tellBy(request) {
  const { plan_start: start, time_zone: zone = null, currency } = request ?? {};
  shownUnits = (request?.load_dimensions ?? []).map(({ name, unit }) => `\u00a0${unit || name}`);
  if (shownDay?.stated !== start || shownDay?.zone !== zone) {
    shownDay = dayOf({ plan_start: start, time_zone: zone });
  }
  shownCurrency = currency ? `\u00a0${currency}` : '';
}

/** Return an instant such as `8:05`, or `8:05:30` where seconds matter; `+1 6:00` the day after. */
export function clock(seconds, options = {}) {
  if (seconds === null || seconds === undefined) return '';
  if (!shownDay) return hours(seconds, options);
  const { days, clock: passed } = shownDay.clockAt(options.precise ? seconds : seconds + 30);
  const text = options.precise
    ? hours(passed / 1000, options)
    : hours(Math.floor(passed / 60000) * 60);
  return days ? `${days > 0 ? '+' : MINUS}${Math.abs(days)} ${text}` : text;
}

/** Return an instant with its date, where the problem has one. */
export function dated(seconds) {
  return shownDay ? `${shownDay.date}, ${clock(seconds)}` : clock(seconds);
}

/** Return the date of the problem's day, empty if it has none. */
export function shownDate() {
  return shownDay?.date ?? '';
}

/** Return the instant that begins the hour of plan start, for ticks on whole hours. */
export function firstHour() {
  return shownDay ? -((shownDay.wallAt(shownDay.start) - shownDay.midnight) / 1000) : 0;
}

/** Return a length as hours and minutes, such as `8:05`, or `8:05:30` where seconds matter. */
export function hours(seconds, { precise = false } = {}) {
  if (seconds === null || seconds === undefined) return '';
  const whole = precise ? Math.round(seconds) : Math.round(seconds / 60) * 60;
  const sign = whole < 0 ? MINUS : '';
  const size = Math.abs(whole);
  const pad = (number) => String(number).padStart(2, '0');
  const head = `${sign}${Math.floor(size / 3600)}:${pad(Math.floor(size / 60) % 60)}`;
  return precise && size % 60 ? `${head}:${pad(size % 60)}` : head;
}

/** Return the instant of `8:05`, `8:05:30`, `+1 6:00` or plain seconds; null for any other text. */
export function parseClock(text) {
  const seconds = shownDay?.secondsAt(String(text)) ?? null;
  return seconds ?? parseHours(text);
}

/** Return the seconds of `8:05`, `8:05:30` or a plain number; null for any other text. */
export function parseHours(text) {
  const trimmed = String(text).trim();
  const parts = /^(\d+):([0-5]?\d)(?::([0-5]?\d(?:\.\d+)?))?$/.exec(trimmed);
  if (parts) return Number(parts[1]) * 3600 + Number(parts[2]) * 60 + Number(parts[3] ?? 0);
  return parseNumber(trimmed);
}

/** Return the number that a text states, with a point or a comma before the decimals, or null. */
export function parseNumber(text) {
  const trimmed = String(text)
    .trim()
    .replace(/^[\u2212]/, '-')
    .replace(/^([-+]?\d+),(\d+)$/, '$1.$2');
  if (!/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(trimmed)) return null;
  return Number(trimmed);
}

/** Return a text's one decimal point as the language has it, as `parseNumber` reads it. */
export function withDecimals(text) {
  const sign = (0.5).toLocaleString(language()).charAt(1);
  return text.replace(/^([^\d.,]*\d+)\.(\d+[^\d.,]*)$/, `$1${sign}$2`);
}

/**
 * Return a message of the service in words: `at 36000 s` as `at 10:00`, `7332.8 minutes` and
 * `600 s` as hours and minutes.
 */
export function timesInWords(message) {
  const exact = (seconds) => clock(Number(seconds), { precise: true });
  return message
    .replace(
      /\b(arrival|service_start|departure|\w+_time) is ([\d.]+) s, computed ([\d.]+) s\b/g,
      (_, what, stated, computed) => `${what} is ${exact(stated)}, computed ${exact(computed)}`)
    .replace(
      /\b((?:at|before|after|from|until) )(\d+(?:\.\d+)?) s\b/g,
      (_, when, seconds) => when + exact(seconds))
    .replace(/\b(\d+(?:\.\d+)?) (s|minutes?)\b(?!')/g, (_, amount, unit) =>
      enough(Number(amount) * (unit === 's' ? 1 : 60)));
}

/** Return a length in words, from an hour on rounded up, so that what is said to suffice does. */
export function enough(seconds) {
  if (seconds < 3600) {
    const minutes = Math.floor(seconds / 60);
    const rest = Number((seconds - minutes * 60).toFixed(3));
    return [minutes && `${minutes} min`, rest && `${rest} s`].filter(Boolean).join(' ') || '0 s';
  }
  const minutes = Math.ceil(Number((seconds / 60).toFixed(6)));
  return [`${Math.floor(minutes / 60)} h`, minutes % 60 && `${minutes % 60} min`]
    .filter(Boolean)
    .join(' ');
}

/** Return a length of time such as `2 h 05 min`, `2 h`, `12 min` or `40 s`. */
export function duration(seconds) {
  const size = Math.abs(Math.round(seconds));
  const sign = seconds < 0 && size ? MINUS : '';
  if (size < 60) return `${sign}${size} s`;
  const minutes = Math.round(size / 60);
  if (minutes < 60) return `${sign}${minutes} min`;
  const rest = minutes % 60 ? ` ${String(minutes % 60).padStart(2, '0')} min` : '';
  return `${sign}${Math.floor(minutes / 60)} h${rest}`;
}

/** Return a number with thousands set apart and at most `digits` decimals. */
export function number(value, digits = 2) {
  const text = Math.abs(value).toLocaleString(language(), { maximumFractionDigits: digits });
  return value < 0 && text !== '0' ? MINUS + text : text;
}

/** Return an amount of money, always with two decimals, in the problem's currency. */
export function money(value) {
  return `${plainMoney(value)}${shownCurrency}`;
}

function plainMoney(value) {
  const options = { minimumFractionDigits: 2, maximumFractionDigits: 2 };
  const text = Math.abs(value).toLocaleString(language(), options);
  return value < 0 && /[1-9]/.test(text) ? MINUS + text : text;
}

/** Return a change with its sign, `0` as it is. */
export function signed(value, show = money) {
  const text = show(value);
  return value > 0 && text !== show(0) ? `+${text}` : text;
}

/** Return metres as kilometres. */
export function km(metres) {
  return `${number(metres / 1000, 1)} km`;
}

/** Return a length in metres, of a kilometre and more in kilometres. */
export function length(metres) {
  return metres < 999.5 ? `${number(metres, 0)} m` : km(metres);
}

/** Return a share, 0 to 1, in percent. */
export function percent(share) {
  return share === null || share === undefined ? '' : `${number(share * 100, 1)} %`;
}

/** Return amounts such as `12 / 3.5`, or `12 kg / 3.5 l` where units are known. */
export function amounts(values) {
  return values.map((value, at) => `${number(value, 3)}${shownUnits[at] ?? ''}`).join(' / ');
}

/** Return a window such as `8:00 to 10:30`, `from 8:00`, `until 10:30` or `any time`. */
export function timeWindow(window) {
  const opens = window?.earliest > 0;
  const closes = window?.latest !== null && window?.latest !== undefined;
  const [from, until] = [window?.earliest, window?.latest].map((instant) => clock(instant));
  if (opens && closes) return `${from} ${t('format.to')} ${until}`;
  if (opens) return t('format.from', { from });
  return closes ? t('format.until', { until }) : t('format.anyTime');
}

/** Return where a place is; degrees as navigators take them, latitude first. */
export function pointText([x, y], { isGeographic }) {
  return isGeographic ? t('format.point', { y: String(y), x: String(x) }) : `x, y: ${x}, ${y}`;
}

/** Return the name of a file without its ending. */
export function withoutEnding(name) {
  return name.replace(/(?<=.)\.[^.]*$/, '');
}
