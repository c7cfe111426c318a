/** What the service warns of: which warnings still hold, and which were dismissed. */

import { getIn, parsePath } from './paths.js';

const STRAIGHT = 'AS_THE_CROW_FLIES';

/** Return what tells a warning from others. */
function warningKey({ code, path, message }) {
  return [code, path, message].join(' ');
}

/** Tell whether a plan's vehicles drive straight ways, for want of roads; flights always do. */
export function drivesStraight({ request, plan }) {
  return request.fleet.some(({ flies }) => !flies)
    && (plan.warnings ?? []).some(({ code }) => code === STRAIGHT);
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
    // That is as true of every other problem, and stands on the map.
    .filter(({ code }) => code !== STRAIGHT)
    .map((warning) => ({ ...warning, key: warningKey(warning), keys: parsePath(warning.path) }))
    .filter(({ key }) => !dismissed.includes(key))
    .filter(({ keys }) => isUntouched(warned.request, request, keys));
}

function isUntouched(before, after, keys) {
  const part = keys.slice(0, 2);
  return before === after || getIn(before, part) === getIn(after, part);
}
