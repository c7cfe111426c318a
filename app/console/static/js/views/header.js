/** The header: what problem is open, what its plan comes to, and planning. */

import { isWaiting, openRequest, openTab, shownPlan } from '../actions.js';
import { clock, duration, km, money, number } from '../core/format.js';
import { fleetSize } from '../core/naming.js';
import { penaltyOf, trueCost } from '../core/terms.js';
import { isToBeSent, sendChange } from '../dispatching.js';
import { isUndoable, undoLast } from '../hands.js';
import { html, useRef } from '../libraries.js';
import { tellEdits, untoldIn } from '../living.js';
import { plan, stop } from '../planning.js';
import { useStore } from '../store.js';
import { openPlans, share } from '../keeping/kept.js';
import { t } from '../texts.js';
import { openFile } from './files.js';
import { Icon, IconButton } from './icon.js';
import { Menu } from './menu.js';
import { ProblemName } from './problem-name.js';
import { WarningsChip } from './warnings-chip.js';

const OPENED = '.json,.csv,.tsv,.txt,.xlsx,.xlsm,.xlsb,.xls,.ods,.html,.htm,.xml,.kml,.kmz,.gpx,'
  + '.geojson';
const SHEET = new URL('../../examples/working-day.xlsx', import.meta.url).href;

/** The bar at the top. */
export function Header() {
  const ready = useStore((state) => state.request !== null);
  const isLive = useStore((state) => state.live !== null);
  return html`<header class="head">
    ${ready && html`<${ProblemName} /><${Opener} /><${Undo} />`}
    <${Result} />
    ${ready && html`<${WarningsChip} /><${Share} /><${SendChange} />`}
    ${isLive ? html`<${LiveState} />` : html`<${PlanButton} />`}
  </header>`;
}

/** Undoes the last change, by hand or of the problem. */
function Undo() {
  const isLeft = useStore(isUndoable);
  return html`<${IconButton} name="undo-2" label=${t('header.undo')} onClick=${undoLast}
    disabled=${!isLeft} id="undo" />`;
}

/** Makes a link that shows what is open. */
function Share() {
  const isPlanned = useStore((state) => shownPlan(state) !== null);
  return isPlanned && html`<${IconButton} name="share-2" label=${t('header.share')}
    onClick=${share} id="share" />`;
}

/** Sends the plan to drivers who have another. */
function SendChange() {
  const isOther = useStore(isToBeSent);
  const send = async () => {
    await sendChange();
    openTab('drivers');
  };
  return isOther && html`<button type="button" class="primary" id="send-change"
    aria-label=${t('drivers.sendChange')} onClick=${send}><${Icon} name="send" />
    <span class="word">${t('drivers.sendChange')}</span></button>`;
}

/** What time it is on a day that goes on, and what of it isn't told yet. */
function LiveState() {
  const { day } = useStore((state) => state.live);
  const count = useStore((state) => untoldIn(state).length);
  return html`<span class="live-clock" role="timer">${clock(day.now)}</span>
    ${day.is_planned ? null : html`<span class="stale" role="status">${t('live.planning')}</span>`}
    ${count > 0 && html`<button type="button" class="primary" id="tell-edits"
      onClick=${tellEdits}><${Icon} name="send" /> ${t('live.tell', { count })}</button>`}`;
}

/** Plans; while it does, stops. */
function PlanButton() {
  const ready = useStore((state) => state.request !== null);
  const state = useStore(({ run }) => run.state);
  const goesOn = useStore(({ request }) => Boolean(request?.replan));
  if (state !== 'idle') {
    return html`<button type="button" key="stop" class="primary stop" onClick=${stop}
      disabled=${state === 'stopping'}><${Icon} name="square" /> ${t('header.stop')}</button>`;
  }
  return html`<button type="button" key="plan" class="primary" disabled=${!ready} onClick=${plan}
    id="plan-button">${goesOn ? t('header.goOn') : t('header.plan')}</button>`;
}

/** Open the spreadsheet that shows what columns are understood. */
async function openSheet() {
  const content = await (await fetch(SHEET)).blob();
  await openFile(new File([content], SHEET.split('/').at(-1)));
}

function Opener() {
  const examples = useStore((state) => state.examples);
  const input = useRef(null);
  const open = (example) => {
    openRequest(example.request, { name: t(`example.${example.name}.name`), isSafe: true });
    return plan();
  };
  const entry = (id, onClick, children) => html`<button type="button" key=${id} id=${id}
    popovertarget="open-menu" popovertargetaction="hide" onClick=${onClick}>${children}</button>`;
  return html`<${Menu} id="open-menu" name=${t('header.open')} label=${html`<${Icon}
      name="folder-open" /><span class="word">${t('header.open')}</span>`}>
    ${entry('open-file', () => input.current.click(), t('header.file'))}
    ${entry('saved-plans', openPlans, t('header.saved'))}
    <h3>${t('header.examples')}</h3>
    ${examples.map((example) => entry(`example-${example.name}`, () => open(example),
      html`<strong>${t(`example.${example.name}.name`)}</strong> ${
        t(`example.${example.name}.is`)}`))}
    ${entry('example-sheet', openSheet, t('header.exampleSheet'))}
    </${Menu}>
    <input type="file" hidden ref=${input} id="file-input" aria-label=${t('header.fileInput')}
      accept=${OPENED}
      onChange=${(event) => {
        openFile(event.target.files[0]);
        event.target.value = '';
      }} />`;
}

/** Seconds that are planned without telling how long it takes. */
const MOST_UNTOLD = 5;

function Result() {
  const entry = useStore(shownPlan);
  const run = useStore((state) => state.run);
  const isLive = useStore((state) => state.live !== null);
  const stale = useStore((state) => shownPlan(state)?.request !== state.request);
  const goesOn = useStore((state) => Boolean(state.request?.replan));
  const waits = useStore(isWaiting) && run.state !== 'stopping';
  return html`<div class="result-line" aria-live="polite">
    ${entry && html`<${Totals} entry=${entry} />`}
    ${run.state !== 'idle' && html`<span>${
      run.waiting ?? t(`run.${waits ? 'decoding' : run.state}`)}</span>`}
    ${['decoding', 'improving'].includes(run.state) && run.limit?.isChosen
      && run.limit.seconds > MOST_UNTOLD && html`<span id="chosen-limit">${t('solve.upTo', {
        time: duration(run.limit.seconds), count: run.request.customers.length })}</span>`}
    ${waits && entry && html`<span class="stale">${t('run.meanwhile')}</span>`}
    ${run.state === 'improving' &&
      html`<span class="progress" role="progressbar" aria-label=${t('run.search')}
      aria-valuenow=${Math.round((run.share ?? 0) * 100)} aria-valuemin="0" aria-valuemax="100">
      <span style=${{ width: `${(run.share ?? 0) * 100}%` }}></span></span>`
    }
    ${entry && stale && !isLive && run.state === 'idle' && html`<span class="stale">
      <span class="long">${t('header.changedSince')}</span><span class="short">${
        t('header.changed')}</span> ${t(`header.${goesOn ? 'planOn' : 'planAgain'}`)}</span>`}
  </div>`;
}

/** What the plan comes to; each figure opens what it sums up. */
function Totals({ entry }) {
  const { request, plan: { routes, summary } } = entry;
  const out = summary.customers - summary.served;
  const penalty = penaltyOf(entry);
  const ends = routes.flatMap(({ trips }) => trips.at(-1)?.stops.at(-1)?.arrival ?? []);
  const chip = (tab, text, others) => html`<button type="button" class="chip" ...${others}
    onClick=${() => openTab(tab)}>${text}</button>`;
  return html`${chip('costs', html`<strong id="total-cost">${money(trueCost(entry))}</strong>`,
      { title: penalty > 0 ? t('header.penaltyHelp', { sum: money(penalty) }) : null,
        'aria-label': t('header.cost', { sum: money(trueCost(entry)) }) })}
    ${chip(out > 0 ? 'unassigned' : 'customers', html`<span class="served">${t('header.served', {
      served: number(summary.served), customers: number(summary.customers) })}</span>`)}
    ${out > 0 && chip('unassigned', html`<span class="out">${
      t('header.out', { count: out })}</span>`)}
    ${chip('routes', t('header.used', {
      count: fleetSize(request.fleet), used: String(summary.vehicles) }))}
    ${chip('routes', km(summary.distance + summary.drone_distance))}
    ${ends.length > 0 && chip('replan', t('header.until', { time: clock(Math.max(...ends)) }))}`;
}
