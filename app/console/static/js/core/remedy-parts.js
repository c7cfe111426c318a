/** Remedies that consist of several: of several limits, or of windows at several ends. */

const AND = / and (?=if |with |without )/;

const WINDOW =
  /(?:the )?(last )?window of its (pickup|delivery)(?: (.+?))?? closed ([\d.,]+ minutes?) later/g;
const WINDOWS = new RegExp(`^fits if ${WINDOW.source}(?: and ${WINDOW.source})*$`);

/** Return the remedies that are to be taken together, each as if it were one. */
export function partsOf(remedy) {
  const [first, ...others] = remedy.split(AND);
  return [first, ...others.map((part) => `fits ${part}`)];
}

/** Return `{end, name, minutes}` of the windows of a shipment to be changed, null if none are. */
export function endWindows(remedy) {
  if (!WINDOWS.test(remedy)) return null;
  return [...remedy.matchAll(WINDOW)].map(([, , end, name, minutes]) => ({ end, name, minutes }));
}
