/** What looks wrong with the problem, though it can be planned: one click away. */

import { shownPlan } from '../actions.js';
import { standingWarnings } from '../core/warned.js';
import { whereInWords } from '../core/where.js';
import { html } from '../libraries.js';
import { store, useStore } from '../store.js';
import { goTo } from './go-to.js';
import { Icon } from './icon.js';
import { Menu } from './menu.js';
import { Said } from './said.js';
import { t } from '../texts.js';

/** The warnings that stand, counted; a click tells them. */
export function WarningsChip() {
  const request = useStore((state) => state.request);
  const entry = useStore(shownPlan);
  const asked = useStore((state) => state.warned);
  const dismissed = useStore((state) => state.dismissed);
  const planned = entry && { request: entry.request, warnings: entry.plan.warnings };
  const warned = asked?.request === request || !planned ? asked : planned;
  const found = standingWarnings(warned, request, dismissed);
  if (!found.length) return null;
  const title = t('warned.meant', { count: found.length });
  return html`<${Menu} id="warnings" name=${title} label=${html`<${Icon} name="triangle-alert" />
      ${found.length}`}><section aria-label=${t('warned.title')}>
      <h2>${title}</h2>
      <ul>${found.map(
        (warning) => html`<${Warning} key=${warning.key} request=${request} warning=${warning} />`,
      )}</ul>
      <button type="button" onClick=${() => dismiss(found)}>${t('warned.dismiss')}</button>
    </section></${Menu}>`;
}

function Warning({ request, warning }) {
  const { keys } = warning;
  return html`<li>${keys.length > 0 &&
    html`<button type="button" class="link" popovertarget="warnings" popovertargetaction="hide"
      onClick=${() => goTo(keys)}>${whereInWords(request, keys)}</button> `
  }<${Said} ...${warning} /></li>`;
}

/** Hide warnings. */
function dismiss(found) {
  store.set(({ dismissed }) => ({ dismissed: [...dismissed, ...found.map(({ key }) => key)] }));
}
