/** The header: what problem is open, planning, and what came of it. */

import { isWaiting, openRequest, shownPlan } from '../actions.js';
import { flightCount } from '../core/drones.js';
import { duration, money } from '../core/format.js';
import { penaltyOf, trueCost } from '../core/terms.js';
import { html, useRef } from '../libraries.js';
import { plan, stop } from '../planning.js';
import { store, useStore } from '../store.js';
import { openPlans } from '../keeping/kept.js';
import { parts, t } from '../texts.js';
import { openFile } from './files.js';
import { LanguageChoice } from './language-choice.js';
import { ProblemName } from './problem-name.js';

const OPENED = '.json,.csv,.tsv,.txt,.xlsx,.xlsm,.xlsb,.xls,.ods,.html,.htm,.xml,.kml,.kmz,.gpx,'
  + '.geojson';
const SHEET = new URL('../../examples/working-day.xlsx', import.meta.url).href;
const ICON = new URL('../../icon.svg', import.meta.url).href;

/** The bar at the top. */
export function Header() {
  const busy = useStore((state) => !['idle'].includes(state.run.state));
  const ready = useStore((state) => state.request !== null);
  const goesOn = useStore((state) => Boolean(state.request?.replan));
  return html`<header class="head">
    <h1><img src=${ICON} alt="" /><span class="word">Tandem</span></h1>
    ${ready && html`<${ProblemName} /><${Opener} />`}
    <button type="button" class="primary" disabled=${!ready} onClick=${plan}
      id="plan-button">${goesOn ? t('header.goOn') : t('header.plan')}</button>
    <button type="button" class="stop" disabled=${!busy} onClick=${stop}>
      ${t('header.stop')}</button>
    <${Result} />
    <button type="button" class="quiet" onClick=${() => store.set({ dialog: { name: 'keys' } })}
      ><${Sign} sign="\u2328" /><span class="word">${t('header.keys')}</span></button>
    <button type="button" class="quiet" onClick=${switchTheme}
      ><${Sign} sign="\u25d0" /><span class="word"><${ThemeName} /></span></button>
    <${LanguageChoice} />
    <a href="guide/"><${Sign} sign="?" /><span class="word">${t('header.guide')}</span></a>
    <a href="docs">API</a>
  </header>`;
}

/** What stands for a word where there is little room; it is read out all the same. */
function Sign({ sign }) {
  return html`<span class="sign" aria-hidden="true">${sign}</span>`;
}

function ThemeName() {
  return useStore((state) => state.dark) ? t('header.light') : t('header.dark');
}

/** Change between light and dark, and remember it. */
export function switchTheme() {
  const theme = store.get().dark ? 'light' : 'dark';
  localStorage.setItem('tandem-theme', theme);
  document.documentElement.dataset.theme = theme;
}

/** Open the spreadsheet that shows what columns are understood. */
async function openSheet() {
  const content = await (await fetch(SHEET)).blob();
  await openFile(new File([content], SHEET.split('/').at(-1)));
}

function Opener() {
  const examples = useStore((state) => state.examples);
  const input = useRef(null);
  const choose = (event) => {
    const { value } = event.target;
    event.target.value = '';
    if (value === SHEET) return openSheet();
    const example = examples.find(({ name }) => name === value);
    openRequest(example.request, { name: example.name, isSafe: true });
    return plan();
  };
  return html`<div class="problem">
    <select aria-label=${t('header.example')} onChange=${choose} value="">
      <option value="" disabled hidden>${t('header.examples')}</option>
      ${examples.map(({ name, summary }) => html`<option key=${name}
        value=${name}>${name}: ${summary}</option>`)}
      <option value=${SHEET}>${t('header.exampleSheet')}</option>
    </select>
    <button type="button" onClick=${() => input.current.click()}>
      ${t('header.file')}</button>
    <button type="button" id="saved-plans" onClick=${openPlans}>
      ${t('header.saved')}</button>
    <input type="file" hidden ref=${input} id="file-input" aria-label=${t('header.fileInput')}
      accept=${OPENED}
      onChange=${(event) => {
        openFile(event.target.files[0]);
        event.target.value = '';
      }} />
  </div>`;
}

/** Seconds that are planned without telling how long it takes. */
const MOST_UNTOLD = 5;

function Result() {
  const entry = useStore(shownPlan);
  const run = useStore((state) => state.run);
  const stale = useStore((state) => shownPlan(state)?.request !== state.request);
  const goesOn = useStore((state) => Boolean(state.request?.replan));
  const waits = useStore(isWaiting) && run.state !== 'stopping';
  return html`<div class="result-line" aria-live="polite">
    ${entry && html`<${Totals} entry=${entry} />`}
    ${run.state !== 'idle' && html`<span>${
      run.waiting ?? t(`run.${waits ? 'decoding' : run.state}`)}</span>`}
    ${
      ['decoding', 'improving'].includes(run.state) &&
      run.limit?.isChosen &&
      run.limit.seconds > MOST_UNTOLD &&
      html`<span id="chosen-limit">${t('solve.upTo', {
        time: duration(run.limit.seconds),
        count: run.request.customers.length,
      })}</span>`
    }
    ${waits && entry && html`<span class="stale">${t('run.meanwhile')}</span>`}
    ${
      run.state === 'improving' &&
      html`<span class="progress" role="progressbar" aria-label=${t('run.search')}
      aria-valuenow=${Math.round((run.share ?? 0) * 100)} aria-valuemin="0" aria-valuemax="100">
      <span style=${{ width: `${(run.share ?? 0) * 100}%` }}></span></span>`
    }
    ${
      entry &&
      stale &&
      run.state === 'idle' &&
      html`<span class="stale"><span class="long">${t('header.changedSince')}</span><span
        class="short">${t('header.changed')}</span>
        ${' '}${t(`header.${goesOn ? 'planOn' : 'planAgain'}`)}</span>`
    }
  </div>`;
}

function Totals({ entry }) {
  const { summary } = entry.plan;
  const out = summary.customers - summary.served;
  const penalty = penaltyOf(entry);
  return html`<span>${parts('header.cost', {
      sum: html`<strong id="total-cost">${money(trueCost(entry))}</strong>`,
    })}</span>
    ${penalty > 0 && html`<span id="total-penalty" title=${t('header.penaltyHelp')}>${
      t('header.penalty', { sum: money(penalty) })}</span>`}
    <span class="served">${t('header.served', {
      served: String(summary.served),
      customers: String(summary.customers),
    })}</span>
    ${out > 0 && html`<span class="out">${t('header.out', { count: out })}</span>`}
    <span class="least">${t('header.vehicles', { count: summary.vehicles })}</span>
    <span class="least">${t('routes.trips', { count: summary.trips })}</span>
    <span class="least">${t('header.flights', { count: flightCount(entry) })}</span>`;
}
