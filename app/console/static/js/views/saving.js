/** Saves what the browser holds as a file. */

const KEPT_MS = 10000;

/** Have the browser save a text or a blob under a name. */
export function save(name, type, content) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement('a');
  Object.assign(link, { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), KEPT_MS);
}
