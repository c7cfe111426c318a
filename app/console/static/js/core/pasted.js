/** What is pasted, told from what a sheet gives. */

/** Return a pasted text if it looks like cells of a sheet, else null. */
export function pastedSheet(content) {
  const lines = content.trim().split(/\r?\n/);
  const cut = lines.filter((line) => line.includes('\t'));
  return cut.length > 1 ? content : null;
}
