/** Places in a request: keys from its root, such as `['fleet', 0, 'count']`. */

/** Return the value at a place, undefined where there is none. */
export function getIn(value, keys) {
  return keys.reduce(
    (part, key) => (part === null || part === undefined ? undefined : part[key]),
    value);
}

/** Return `value` with another value at a place; objects on the way are copied or made. */
export function setIn(value, keys, replacement) {
  if (keys.length === 0) return replacement;
  const [key, ...rest] = keys;
  const holder = value ?? (typeof key === 'number' ? [] : {});
  const copy = Array.isArray(holder) ? [...holder] : { ...holder };
  copy[key] = setIn(holder[key], rest, replacement);
  return copy;
}

/** Return `value` without the field or entry at a place. */
export function removeIn(value, keys) {
  const holder = getIn(value, keys.slice(0, -1));
  const last = keys[keys.length - 1];
  if (holder === undefined || holder === null) return value;
  if (Array.isArray(holder)) {
    return setIn(
      value,
      keys.slice(0, -1),
      holder.filter((_, index) => index !== last));
  }
  const { [last]: removed, ...rest } = holder;
  return setIn(value, keys.slice(0, -1), rest);
}

/** Return the keys of a path as errors state it, such as `$.customers[3].time_window.latest`. */
export function parsePath(path) {
  const keys = [];
  const step = /\.([A-Za-z_][A-Za-z0-9_]*)|\[(\d+)\]|\['([^']*)'\]|\["([^"]*)"\]/g;
  for (const [, name, index, quoted, double] of path.matchAll(step)) {
    keys.push(index === undefined ? (name ?? quoted ?? double) : Number(index));
  }
  return keys;
}

/** Return keys as the API writes a path: `fleet[0].profile`. */
export function pathOf(keys) {
  return keys
    .map((key, at) => (typeof key === 'number' ? `[${key}]` : at ? `.${key}` : key))
    .join('');
}

/** Return keys as one text, to compare places. */
export function keyOf(keys) {
  return keys.join('/');
}
