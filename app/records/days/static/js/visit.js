/** A customer's page: when who comes, asked again each half minute. */

import { html, render } from '../../console/vendor/htm-3.1.1/standalone.module.js';
import { LanguageChoice } from '../../drive/js/language-choice.js';
import { choose, language, t } from './texts.js';

const REFRESH_MS = 30000;
const [UNKNOWN, OVER] = [401, 410];

const root = document.getElementById('visit');
const state = { visit: null, failure: '', at: null };

/** Return an instant as a time of day, in the zone of the delivery. */
function clock(instant) {
  const timeZone = state.visit?.time_zone;
  if (timeZone) {
    const format = { hour: 'numeric', minute: '2-digit', timeZone };
    return new Intl.DateTimeFormat(language(), format).format(new Date(instant));
  }
  // Told with the offset of the place it is about.
  return /T0?(\d+:\d\d)/.exec(instant)[1];
}

function ask() {
  const headers = { Authorization: `Bearer ${decodeURIComponent(location.hash.slice(1))}` };
  return fetch('order', { headers, cache: 'no-store' });
}

/** Ask how the order stands, and show it; what was known stays while nobody answers. */
async function refresh() {
  try {
    const reply = await ask();
    if (reply.ok) {
      Object.assign(state, { visit: await reply.json(), failure: '', at: new Date() });
    } else if (reply.status === UNKNOWN || reply.status === OVER) {
      const failure = reply.status === OVER ? 'over' : 'wrong';
      Object.assign(state, { visit: null, failure });
    } else {
      state.failure = 'unreached';
    }
  } catch {
    state.failure = 'unreached';
  }
  draw();
}

function When({ visit }) {
  if (visit.state !== 'coming') return html`<p><strong>${t(`visit.${visit.state}`)}</strong></p>`;
  const [from, to] = [clock(visit.earliest), clock(visit.latest)];
  return html`<p class="title">${
    from === to ? t('visit.arriving', { arrival: from }) : t('visit.coming', { from, to })
  }</p>`;
}

function Visit({ visit }) {
  const changes = visit.told.slice(1).reverse();
  return html`<section class="step"><div class="head" aria-live="polite"><${When} visit=${visit} />
    </div><div class="body">
    ${visit.by && html`<p>${t(`visit.${visit.by}`, { vehicle: visit.vehicle })}</p>`}
    ${changes.length > 0 && html`<h2>${t('visit.changes')}</h2><ul>${changes.map(
      ({ at, arrival }) => html`<li key=${at}>${
        t('visit.changed', { at: clock(at), arrival: clock(arrival) })}</li>`,
    )}</ul>`}</div></section>`;
}

async function speak(name) {
  await choose(name);
  draw();
}

function draw() {
  const { visit, failure, at } = state;
  document.title = t('visit.title');
  const current = at && at.toLocaleTimeString(language(), { hour: 'numeric', minute: '2-digit' });
  render(html`<header><h1>${t('visit.title')}</h1>
      ${visit && html`<p>${t('visit.order', { order: visit.order })}</p>`}
      <p role="status">${failure ? t(`failure.${failure}`) : visit && t('visit.current', { at: current })}</p>
    </header>
    ${visit && html`<${Visit} visit=${visit} />`}
    <footer><${LanguageChoice} label=${t('visit.language')} language=${language()}
      onChoose=${speak} /></footer>`, root);
}

await refresh();
setInterval(() => document.hidden || refresh(), REFRESH_MS);
addEventListener('visibilitychange', () => document.hidden || refresh());
addEventListener('hashchange', refresh);
