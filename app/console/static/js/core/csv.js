/** Cells of CSV that stay what they are, whatever program opens them. */

/** Signs that begin a formula, and all that sheets may read as one of them: wide, small, raised. */
const SIGNS = [
  '=+\\-@\uff1d\uff0b\uff0d\uff20\ufe66\ufe62\ufe63\ufe6b',
  '\u207c\u207a\u207b\u208c\u208a\u208b\u2212\ufb29',
].join('');

/** What sheets skip, or nobody sees: blanks, quotes, what has no width or turns the direction. */
const UNSEEN = '\\s"\\p{Cc}\\p{Cf}\\p{DI}\u2800';

/** What some take for the end of a cell. */
const ENDS = ';\t\v\f\r\n\u0085\u2028\u2029';

const FORMULA = new RegExp(`(^|[${ENDS}])([${UNSEEN}]*)(?=[${SIGNS}])`, 'gu');

/** Return a value as a cell of CSV; numbers need no guard, as they have no words. */
export function csvCell(value) {
  const text = typeof value === 'string' ? guarded(value) : String(value);
  return /[",;\t\v\f\r\n\u0085\u2028\u2029]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function guarded(text) {
  const safe = text.replace(FORMULA, "$1$2'");
  return /^[\t\r\n]/.test(safe) ? `'${safe}` : safe;
}
