/** How long to plan where the user doesn't say: the more customers, the longer. */

const LEAST = 1; // seconds, as the service takes where nothing is stated
const PER_THOUSAND = 3;
const GROWTH = 1.2; // as the time to plans of some quality grows, see docs/operate/scaling.md
const GONE_ON_A_SECOND = 2500; // customers of a plan that is gone on from
const STEPS = [
  [10, 1], [60, 5], [Infinity, 10]];

/** Return the seconds of search that fit a problem, `most` at most. */
export function fittingSeconds({ customers }, most = Infinity) {
  const seconds = PER_THOUSAND * (customers.length / 1000) ** GROWTH;
  const [, step] = STEPS.find(([below]) => seconds <= below);
  return Math.min(Math.max(LEAST, Math.round(seconds / step) * step), most);
}

/** Return the seconds of a short search on from a plan, the work before it included. */
export function shortSeconds({ customers }) {
  return Math.max(LEAST, Math.ceil(customers.length / GONE_ON_A_SECOND));
}

/** Return how long a problem is planned: `{seconds, isChosen}`, whether that fits by itself. */
export function limitOf(request, most) {
  const stated = request.options?.time_limit;
  if (stated !== undefined) return { seconds: stated, isChosen: false };
  return { seconds: fittingSeconds(request, most), isChosen: true };
}
