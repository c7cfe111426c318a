/** The page: header, map, timeline, panel and dialogs. */

import { closeFailure, openTab } from '../actions.js';
import { count } from '../core/format.js';
import { html } from '../libraries.js';
import { MapPane } from '../map/pane.js';
import { useStore } from '../store.js';
import { TimelinePane } from '../timeline/pane.js';
import { Dialogs } from './dialogs.js';
import { Header } from './header.js';
import { Panel, tabOf } from './panel.js';

const MOST_LISTED = 20;

/** Everything. */
export function App() {
  const ready = useStore((state) => state.request !== null && state.schemas !== null);
  return html`<main class="console">
    <${Header} />
    <${Notice} />
    ${
      ready
        ? html`<${MapPane} /><${Panel} /><${TimelinePane} />`
        : html`<p class="loading maps">Loading the console.</p>`
    }
    <${Dialogs} />
  </main>`;
}

/** What went wrong, or that the service is starting. */
function Notice() {
  const failure = useStore((state) => state.failure);
  const errors = useStore((state) => state.errors);
  const starting = useStore((state) => state.starting);
  if (failure) {
    return html`<div class="notice" role="alert">
      <div><strong>${failure.title}.</strong> ${failure.detail}
        ${
          errors.length > 0 &&
          html`<ul>${errors.slice(0, MOST_LISTED).map(
            (error) => html`
          <li key=${error.path + error.code}><button type="button" class="link"
            onClick=${() => goTo(error)}><code>${error.path}</code></button> ${error.message}</li>`,
          )}
          ${
            errors.length > MOST_LISTED &&
            html`<li>and ${count(errors.length - MOST_LISTED, 'more').replace(
              'mores',
              'more',
            )}</li>`
          }</ul>`
        }
      </div>
      <button type="button" class="quiet" onClick=${closeFailure}>Close</button></div>`;
  }
  if (!starting) return null;
  return html`<div class="notice starting"
    role="status"><div><strong>The service is starting.</strong>
    ${' '}${starting.detail}
    ${
      starting.progress != null &&
      html`<progress max="1" value=${starting.progress} aria-label="How far it is"></progress>`
    }</div></div>`;
}

/** Return the field at a place, or the nearest that holds it. */
function nearestField(keys) {
  if (!keys.length) return null;
  return (
    document.getElementById(`field-${keys.join('-')}`) ?? nearestField(keys.slice(0, -1))
  );
}

/** Open the tab with the field that an error is at, and go there. */
function goTo({ keys }) {
  openTab(tabOf(keys));
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      const field = nearestField(keys);
      field?.closest('details')?.setAttribute('open', '');
      field?.scrollIntoView({ block: 'center' });
      field?.focus();
    }),
  );
}
