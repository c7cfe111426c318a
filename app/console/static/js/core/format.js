/** Numbers and times as people read them, and back. Times in seconds, distances in metres. */

const MINUS = '\u2212';

/** Return an instant such as `8:05`, or `8:05:30` where seconds matter. */
export function clock(seconds, { precise = false } = {}) {
  if (seconds === null || seconds === undefined) return '';
  const whole = precise ? Math.round(seconds) : Math.round(seconds / 60) * 60;
  const sign = whole < 0 ? MINUS : '';
  const size = Math.abs(whole);
  const pad = (number) => String(number).padStart(2, '0');
  const head = `${sign}${Math.floor(size / 3600)}:${pad(Math.floor(size / 60) % 60)}`;
  return precise && size % 60 ? `${head}:${pad(size % 60)}` : head;
}

/** Return the seconds of `8:05`, `8:05:30` or a plain number; null for any other text. */
export function parseClock(text) {
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

/** Return a message of the service with its seconds as times, `36000 s` as `10:00`. */
export function timesInWords(message) {
  return message.replace(/\b(\d+(?:\.\d+)?) s\b/g, (_, seconds) =>
    clock(Number(seconds), { precise: true }),
  );
}

/** Return a length of time such as `2 h 05 min`, `12 min` or `40 s`. */
export function duration(seconds) {
  const size = Math.abs(Math.round(seconds));
  const sign = seconds < 0 && size ? MINUS : '';
  if (size < 60) return `${sign}${size} s`;
  const minutes = Math.round(size / 60);
  if (minutes < 60) return `${sign}${minutes} min`;
  return `${sign}${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, '0')} min`;
}

/** Return a number with thousands set apart and at most `digits` decimals. */
export function number(value, digits = 2) {
  const text = Math.abs(value).toLocaleString('en', { maximumFractionDigits: digits });
  return value < 0 && text !== '0' ? MINUS + text : text;
}

/** Return an amount of money, always with two decimals. */
export function money(value) {
  const options = { minimumFractionDigits: 2, maximumFractionDigits: 2 };
  const text = Math.abs(value).toLocaleString('en', options);
  return value < 0 && text !== '0.00' ? MINUS + text : text;
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

/** Return a share, 0 to 1, in percent. */
export function percent(share) {
  return share === null || share === undefined ? '' : `${number(share * 100, 1)} %`;
}

/** Return amounts such as `12 / 3.5`. */
export function amounts(values) {
  return values.map((value) => number(value, 3)).join(' / ');
}

/** Return a window such as `8:00 to 10:30`, `from 8:00`, `until 10:30` or `any time`. */
export function timeWindow(window) {
  const opens = window?.earliest > 0;
  const closes = window?.latest !== null && window?.latest !== undefined;
  if (opens && closes) return `${clock(window.earliest)} to ${clock(window.latest)}`;
  if (opens) return `from ${clock(window.earliest)}`;
  return closes ? `until ${clock(window.latest)}` : 'any time';
}

/** Return a count and its noun. */
export function count(value, noun, plural = `${noun}s`) {
  return `${number(value, 0)} ${value === 1 ? noun : plural}`;
}
