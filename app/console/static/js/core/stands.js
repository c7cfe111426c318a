/** Where vehicles start and end, if that is at places of their own. */

/** Return these places as `{kind, id, location}`: `start` or `end`, and the vehicle type. */
export function standsOf(request) {
  return (request.fleet ?? []).flatMap(({ id, start_location: start, end }) => [
    ...(Array.isArray(start) ? [{ kind: 'start', id, location: start }] : []),
    ...(Array.isArray(end?.location) ? [{ kind: 'end', id, location: end.location }] : []),
  ]);
}
