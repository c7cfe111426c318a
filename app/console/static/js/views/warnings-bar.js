/** What looks wrong with the problem, though it can be planned: above the map, one click away. */

import { shownPlan } from '../actions.js';
import { isLasting, standingWarnings } from '../core/warned.js';
import { whereInWords } from '../core/where.js';
import { html } from '../libraries.js';
import { store, useStore } from '../store.js';
import { goTo } from './go-to.js';
import { Said } from './said.js';
import { t } from '../texts.js';

const DISMISSED = 'tandem-dismissed-warnings';

/** The warnings that stand. */
export function WarningsBar() {
  const request = useStore((state) => state.request);
  const entry = useStore(shownPlan);
  const asked = useStore((state) => state.warned);
  const dismissed = useStore((state) => state.dismissed);
  const planned = entry && { request: entry.request, warnings: entry.plan.warnings };
  const warned = asked?.request === request || !planned ? asked : planned;
  const found = standingWarnings(warned, request, dismissed);
  if (!found.length) return null;
  return html`<section class="notice warned" aria-label=${t('warned.title')}><div>
      <strong>${t('warned.meant', { count: found.length })}</strong>
      <ul>${found.map(
        (warning) => html`<${Warning} key=${warning.key} request=${request} warning=${warning} />`,
      )}</ul>
    </div>
    <button type="button" class="quiet" onClick=${() => dismiss(found)}>
      ${t('warned.dismiss')}</button></section>`;
}

function Warning({ request, warning }) {
  const { keys } = warning;
  return html`<li>${
    keys.length > 0 &&
    html`<button type="button" class="link"
      onClick=${() => goTo(keys)}>${whereInWords(request, keys)}</button> `
  }<${Said} ...${warning} /></li>`;
}

/** Hide warnings; those that every problem has stay hidden in later visits. */
function dismiss(found) {
  const dismissed = [...store.get().dismissed, ...found.map(({ key }) => key)];
  try {
    localStorage.setItem(DISMISSED, JSON.stringify(dismissed.filter(isLasting)));
  } catch {
    // A browser that keeps nothing warns again next time.
  }
  store.set({ dismissed });
}

/** Recall what was dismissed in earlier visits. */
export function recallDismissed() {
  try {
    store.set({ dismissed: JSON.parse(localStorage.getItem(DISMISSED)) ?? [] });
  } catch {
    store.set({ dismissed: [] });
  }
}
