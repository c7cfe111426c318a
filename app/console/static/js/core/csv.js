/** Cells of CSV that stay what they are, whatever program opens them. */

/**
 * Beginnings that sheets take for a formula, wide ones too, at the start of a cell or behind what
 * some take for its end: a semicolon, a tab, a new line, and the blanks and quotes that they skip.
 */
const FORMULA = /(^|[;\t\r\n])([\s"]*)(?=[=+\-@\uff1d\uff0b\uff0d\uff20\ufe66\ufe62\ufe63\ufe6b])/g;

/** Return a value as a cell of CSV; numbers need no guard, as they have no words. */
export function csvCell(value) {
  const text = typeof value === 'string' ? guarded(value) : String(value);
  return /[",;\t\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function guarded(text) {
  const safe = text.replace(FORMULA, "$1$2'");
  return /^[\t\r\n]/.test(safe) ? `'${safe}` : safe;
}
