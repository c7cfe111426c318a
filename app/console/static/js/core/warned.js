/** What the service warns of: which warnings still hold, and which were dismissed. */

import { getIn, parsePath } from './paths.js';

/** Warnings that say the same of every problem: dismissed once, they stay so. */
const LASTING = new Set(['AS_THE_CROW_FLIES']);

/** Return what tells a warning from others. */
export function warningKey({ code, path, message }) {
  return LASTING.has(code) ? code : [code, path, message].join(' ');
}

/** Tell whether a dismissed warning is not to be shown in later visits either. */
export function isLasting(key) {
  return LASTING.has(key);
}

/**
 * Return the warnings that hold for a problem as it is edited, with `keys` of what they are about.
 *
 * @param warned `{request, warnings}`, what was warned of
 * @param request as it is edited; what was changed since is no longer warned of
 * @param dismissed keys of warnings
 */
export function standingWarnings(warned, request, dismissed) {
  if (!warned || !request) return [];
  return (warned.warnings ?? [])
    .map((warning) => ({ ...warning, key: warningKey(warning), keys: parsePath(warning.path) }))
    .filter(({ key }) => !dismissed.includes(key))
    .filter(({ keys }) => isUntouched(warned.request, request, keys));
}

function isUntouched(before, after, keys) {
  const part = keys.slice(0, 2);
  return before === after || getIn(before, part) === getIn(after, part);
}
