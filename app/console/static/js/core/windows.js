/** The windows of a customer: one or several, one after another. */

import { timeWindow } from './format.js';
import { t } from '../texts.js';

/** Return a customer's windows, as far as any is stated. */
export function windowsOf(customer) {
  if (customer?.time_windows?.length) return customer.time_windows;
  return customer?.time_window ? [customer.time_window] : [];
}

/** Return the window in which service begins at an instant, null if none is stated. */
export function windowAt(customer, time) {
  const windows = windowsOf(customer);
  const begun = windows.filter(({ earliest = 0 }) => earliest <= time);
  return begun[begun.length - 1] ?? windows[0] ?? null;
}

/** Return windows such as `8:00 to 9:00, from 14:00`, or `any time`. */
export function windowsInWords(windows) {
  return windows.length ? windows.map(timeWindow).join(', ') : timeWindow(null);
}

/** Return windows such as `8:00\u20139:00`, which leave names in a table more room. */
export function windowsInCell(windows) {
  return windows.length ? windowsInWords(windows).replaceAll(` ${t('format.to')} `, '\u2013') : '';
}

/** Return a customer with other windows; `time_windows` is stated only where there are several. */
export function withWindows(customer, windows) {
  const { time_window: _one, time_windows: _several, ...rest } = customer;
  if (!windows.length) return rest;
  return windows.length === 1
    ? { ...rest, time_window: windows[0] }
    : { ...rest, time_windows: windows };
}
