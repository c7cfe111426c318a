/** Where vehicles start and end, if that is at places of their own, and launch sites. */

/**
 * Return these places as `{kind, id, location}`: `start` or `end`, and the vehicle type, or
 * `launch_site`.
 */
export function standsOf(request) {
  const sites = (request.launch_sites ?? [])
    .filter(({ location }) => Array.isArray(location))
    .map(({ id, location, time_window }) => ({ kind: 'launch_site', id, location, time_window }));
  const stands = (request.fleet ?? []).flatMap(({ id, start_location: start, end }) => [
    ...(Array.isArray(start) ? [{ kind: 'start', id, location: start }] : []),
    ...(Array.isArray(end?.location) ? [{ kind: 'end', id, location: end.location }] : [])]);
  return [...stands, ...sites];
}
