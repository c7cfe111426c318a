/** The page: rail, header, panel, map, timeline and dialogs. */

import { closeFailure, isWaiting, shownPlan } from '../actions.js';
import { whereInWords } from '../core/where.js';
import { html } from '../libraries.js';
import { MapPane } from '../map/pane.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';
import { TimelinePane } from '../timeline/pane.js';
import { Dialogs } from './dialogs.js';
import { goTo } from './go-to.js';
import { Header } from './header.js';
import { LiveDay } from './live-day.js';
import { KeepingNotice, isToBeTold } from './keeping-notice.js';
import { Panel } from './panel.js';
import { Rail } from './rail.js';
import { Plain, Said } from './said.js';

const MOST_LISTED = 20;

/** Everything. */
export function App() {
  const ready = useStore((state) => state.request !== null && state.schemas !== null);
  const waits = useStore((state) => isWaiting(state) && shownPlan(state) !== null);
  const language = useStore((state) => state.language);
  // Another language is another page: what views keep for themselves is made anew.
  const isWall = useStore((state) => state.live?.isWall);
  return html`<main class="console" key=${language} data-waiting=${waits} data-wall=${isWall}
      ...${useLayout()}>
    ${ready ? html`<${Rail} />` : html`<nav class="rail"></nav>`}
    <${Header} />
    <${Notice} />
    ${ready
        ? html`${isWall ? html`<aside class="panel"><${LiveDay} /></aside>` : html`<${Panel} />`}
          <${MapPane} /><${TimelinePane} />`
        : html`<p class="loading maps">${t('app.loading')}</p>`
    }
    <${Dialogs} />
  </main>`;
}

/** Return how the desk is laid out, for its style sheet. */
function useLayout() {
  const { panel, timeline, folded, timelineFolded, sheet } = useStore((state) => state.frame);
  return {
    'data-folded': folded,
    'data-timeline': timelineFolded ? 'folded' : 'open',
    'data-sheet': sheet,
    style: { '--panel-width': `${panel}px`, '--timeline-height': `${timeline}px` },
  };
}

/** What went wrong, or that the service is starting. */
function Notice() {
  const failure = useStore((state) => state.failure);
  const errors = useStore((state) => state.errors);
  const request = useStore((state) => state.request);
  const starting = useStore((state) => state.starting);
  const tells = useStore(isToBeTold);
  if (failure) {
    return html`<div class="notice" role="alert">
      <div><strong>${failure.title}.</strong> <${Plain} message=${failure.detail} />
        ${errors.length > 0 && html`<ul>${errors.slice(0, MOST_LISTED).map((error) => html`
          <li key=${error.path + error.code}><button type="button" class="link"
            onClick=${() => goTo(error.keys)}>${whereInWords(request, error.keys)}</button>
            ${' '}<${Said} ...${error} /></li>`)}
          ${errors.length > MOST_LISTED &&
            html`<li>${t('app.more', { count: errors.length - MOST_LISTED })}</li>`
          }</ul>`}
      </div>
      <button type="button" class="quiet" onClick=${closeFailure}>${t('app.close')}</button></div>`;
  }
  if (!starting) return tells && html`<${KeepingNotice} />`;
  return html`<div class="notice starting"
    role="status"><div><strong>${t('app.starting')}</strong>
    ${' '}${starting.detail}</div></div>`;
}
