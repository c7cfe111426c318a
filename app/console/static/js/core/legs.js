/** What the legs of a plan are made of, in words. */

/** Return a line for each profile that trucks drive by, from the reply's `legs`. */
export function legsInWords(legs) {
  return (legs ?? []).filter(({ by }) => by !== 'flight').map(legInWords);
}

function legInWords({ profile, by, engine, estimated, detour, note }) {
  if (by === 'matrix') return `${profile}: by the request's matrix`;
  if (by === 'straight') return `${profile}: in straight lines`;
  if (by !== 'roads') return `${profile}: as the crow flies. ${note ?? ''}`.trim();
  const roads = `${profile}: by roads (${engine})`;
  return estimated ? `${roads}, ${estimated} legs estimated (detour ${detour}). ${note}` : roads;
}
