/** The windows of a customer: one or several, one after another. */

import { timeWindow } from './format.js';

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

/** Return a customer with other windows; `time_windows` is stated only where there are several. */
export function withWindows(customer, windows) {
  const { time_window: _one, time_windows: _several, ...rest } = customer;
  if (!windows.length) return rest;
  return windows.length === 1
    ? { ...rest, time_window: windows[0] }
    : { ...rest, time_windows: windows };
}

/** Return a customer whose window, by its number from 0, closes so much later, in seconds. */
export function closingLater(customer, position, seconds) {
  const windows = windowsOf(customer);
  const next = windows[position + 1]?.earliest ?? Infinity;
  const changed = windows.map((window, number) => {
    if (number !== position) return window;
    const latest = Math.round(((window.latest ?? 0) + seconds) * 1000) / 1000;
    // Windows don't touch: a millisecond lies between.
    return { ...window, latest: Math.min(latest, Math.round(next * 1000 - 1) / 1000) };
  });
  return withWindows(customer, changed);
}
