/** The link by which the page was opened: its token stands behind `#`, which no server is told. */

const KEPT = 'tandem-drive-token';

/** Return the token of the link, that of the last one where the page is opened without. */
export function tokenOf(hash, storage) {
  const told = decodeURIComponent(hash.slice(1)).trim();
  if (told) storage.setItem(KEPT, told);
  return told || storage.getItem(KEPT);
}

/** Forget a token, unless another link was opened since. */
export function forgetToken(token, storage) {
  if (storage.getItem(KEPT) === token) storage.removeItem(KEPT);
}

/** Return the part of a token that is no secret: the link's id. */
export function linkOf(token) {
  return token.split('_')[2] ?? '';
}
