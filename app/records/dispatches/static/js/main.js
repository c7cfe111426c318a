/** A driver's day: opens it, keeps it on the phone, sends what is told when there is network. */

import { html, render } from '../../console/vendor/htm-3.1.1/standalone.module.js';
import * as days from './days.js';
import { saveFlights } from './flights.js';
import { forgetToken, linkOf, tokenOf } from './link.js';
import { allow, isAllowed, POSITION, watch } from './positions.js';
import { ask, eventOf, LinkOver, PROOF, Refused, send } from './queue.js';
import { forgetDraft } from './reasons.js';
import { CHANGES } from './steps.js';
import { t } from './texts.js';
import { calledIn, Day, Message } from './views.js';

const RETRY_MS = 15000;
const REFRESH_MS = 60000;

const root = document.getElementById('day');
const token = tokenOf(location.hash, localStorage);
const link = token && linkOf(token);
const state = { day: null, waiting: [], isReached: true, failure: '', sharing: 'off' };
let asking = Promise.resolve();
let asked = 0;
let endSharing = () => {};

/** Show the day, or why there is none. */
function draw() {
  if (state.day) {
    document.title = calledIn(state.day);
    const doing = {
      onTell: tell,
      onProve: prove,
      onSeen: seeChange,
      onShare: share,
      onLanguage: draw,
      onFlights: (format) => saveFlights(token, format),
    };
    render(html`<${Day} ...${state} link=${link} ...${doing} />`, root);
  } else {
    document.title = t('page.title');
    render(html`<${Message} text=${state.failure || t('failure.unreached')} />`, root);
  }
}

/** Keep what the driver tells, show it, and send it. */
async function tell(step, kind, reason) {
  await keepTold(step, kind, reason && { reason });
}

/** Keep who took it, a photo and a signature, and send them when there is network. */
async function prove(step, proof) {
  const proven = [...(state.day.proven ?? []), step];
  await keep({ ...state.day, proven });
  await keepTold(step, PROOF, { proof });
}

/** Tell where the vehicle is from now on, or no more, and remember it. */
function share(isShared) {
  allow(localStorage, isShared);
  endSharing();
  endSharing = isShared ? watch(tellPosition, refuseSharing) : () => {};
  state.sharing = isShared ? 'on' : 'off';
  draw();
}

/** Tell where the vehicle is; where it was before nobody needs to know any more. */
async function tellPosition(location) {
  const waiting = await days.waitingEvents(link);
  await days.dropEvents(waiting.filter(({ step }) => step === POSITION));
  await keepTold(POSITION, 'done', { location });
}

function refuseSharing() {
  share(false);
  state.sharing = 'refused';
  draw();
}

async function look() {
  const waiting = await days.waitingEvents(link);
  state.waiting = waiting.filter(({ step }) => step !== POSITION);
}

async function keepTold(step, kind, more) {
  await days.keepEvent(eventOf(link, step, kind, more));
  await look();
  draw();
  catchUp();
}

/** Send what waits and ask for the day, one after another; nobody asks twice at once. */
function catchUp({ isDue = false } = {}) {
  asking = asking.then(() => exchange(isDue));
  return asking;
}

async function exchange(isDue) {
  try {
    const waited = (await days.waitingEvents(link)).length > 0;
    const standing = await send(token, link);
    if (standing) await keep({ ...state.day, standing });
    if (isDue || !state.day || Date.now() - asked > REFRESH_MS) {
      const day = await ask(token, 'day');
      if (day) await keep(day);
      state.isReached = Boolean(day);
      asked = Date.now();
    } else if (waited) {
      state.isReached = Boolean(standing);
    }
  } catch (error) {
    await give(error);
  }
  await look();
  draw();
}

/** Tell that what is new was seen; from now on, what comes then is new. */
async function seeChange() {
  await keep({ ...state.day, seen: state.day.steps });
  await tell(CHANGES, 'done');
}

/** Keep the day, with what only the phone knows of it. */
async function keep(day) {
  const { seen = day.steps, proven } = state.day ?? {};
  state.day = { seen, proven, ...day };
  await days.keepDay(state.day);
}

/** Give up what can't go on: a link that is over, or something told that is refused. */
async function give(error) {
  if (!(error instanceof Refused || error instanceof LinkOver)) throw error;
  state.failure = error.message;
  await days.dropEvents(await days.waitingEvents(link));
  if (error instanceof Refused) return;
  endSharing();
  // Nothing of customers stays behind on a phone.
  await days.forgetDay(link);
  forgetToken(token, localStorage);
  forgetDraft(localStorage);
  state.day = null;
}

async function begin() {
  root.replaceChildren();
  render(html`<p class="note">${t('page.opening')}</p>`, root);
  addEventListener('hashchange', () => location.reload());
  if (!token) {
    state.failure = t('failure.noLink');
    draw();
    return;
  }
  navigator.serviceWorker?.register('sw.js');
  navigator.storage?.persist?.();
  state.day = (await days.keptDay(link)) ?? null;
  await look();
  if (state.day) draw();
  addEventListener('online', () => catchUp({ isDue: true }));
  document.addEventListener('visibilitychange', () => {
    if (!document.hidden) catchUp();
  });
  setInterval(() => {
    if (!document.hidden) catchUp();
  }, RETRY_MS);
  await catchUp({ isDue: true });
  if (state.day?.asks_position && isAllowed(localStorage)) share(true);
}

begin();
