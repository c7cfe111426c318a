/** Where the keyboard is. */

/** Focus the first element that a selector finds, if there is one. */
export function focusFirst(selector) {
  /** @type {HTMLElement | null} */ (document.querySelector(selector))?.focus();
}
