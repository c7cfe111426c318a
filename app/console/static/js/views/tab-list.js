/** Tabs that keys go along. */

/** Return the name that a key goes to from another, null if it goes nowhere. In place. */
export function nextOf(event, names, from, isVertical = false) {
  const position = names.indexOf(from);
  const [back, forth] = isVertical ? ['ArrowUp', 'ArrowDown'] : ['ArrowLeft', 'ArrowRight'];
  const next = { [back]: position - 1, [forth]: position + 1, Home: 0, End: names.length - 1 };
  if (!(event.key in next)) return null;
  event.preventDefault();
  return names[(next[event.key] + names.length) % names.length];
}
