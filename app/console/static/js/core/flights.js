/** The lines that flights of a plan take. */

/** Return a sortie's legs as its reply tells them, else straight; none where a place lacks. */
export function flownLegs(sortie) {
  const places = [sortie.from, ...sortie.visits, sortie.to].map((halt) => halt.location);
  if (places.includes(null)) return [];
  return places.slice(1).map((to, index) => sortie.lines?.[index] ?? [places[index], to]);
}
