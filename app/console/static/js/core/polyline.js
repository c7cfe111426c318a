/** Encoded polylines of six decimals, as replies state the ways of legs. */

const DECIMALS = 1e6;

/**
 * Return the places `[x, y]` of a line; lines have y first.
 *
 * Numbers may be larger than those that bits are moved in, so they are added up.
 */
export function decodeLine(text) {
  const places = [];
  const read = numbers(text);
  let [x, y] = [0, 0];
  for (let step = read(); step !== null; step = read()) {
    y += step;
    x += read() ?? 0;
    places.push([x / DECIMALS, y / DECIMALS]);
  }
  return places;
}

function numbers(text) {
  let position = 0;
  return () => {
    if (position >= text.length) return null;
    let [value, scale] = [0, 1];
    let chunk;
    do {
      chunk = text.charCodeAt(position) - 63;
      position += 1;
      value += (chunk % 32) * scale;
      scale *= 32;
    } while (chunk >= 32);
    return value % 2 ? -(value + 1) / 2 : value / 2;
  };
}
