/** What drivers see. */

import { html, useState } from '../../console/vendor/htm-3.1.1/standalone.module.js';
import { clock, windowText } from './clocks.js';
import {
  chooseNavigator,
  chosenNavigator,
  navigation,
  NAVIGATORS,
  pointText,
} from './navigators.js';
import {
  amounts,
  countOver,
  DONE,
  isBroken,
  isSome,
  mayFail,
  nextStep,
  REASONS,
  standings,
  telephone,
  titleOf,
  VEHICLE,
} from './steps.js';

/** A page that has nothing but something to say. */
export function Message({ text }) {
  return html`<h1>Today's stops</h1><p class="note" role="alert">${text}</p>`;
}

/** The whole day. */
export function Day({ day, waiting, isReached, isChanged, failure, onTell, onSeen }) {
  const [navigator_, setNavigator] = useState(
    chosenNavigator(localStorage, window.navigator.userAgent),
  );
  const found = standings(day.standing, waiting);
  const next = nextStep(day.steps, found);
  const choose = (event) => {
    chooseNavigator(localStorage, event.target.value);
    setNavigator(event.target.value);
  };
  return html`<header>
      <h1>${day.vehicle}</h1>
      <p>${countOver(day.steps, found)} of ${day.steps.length} over</p>
      <p role="status" class=${waiting.length ? 'unsent' : ''}>${sendingText(
        waiting.length,
        isReached,
      )}</p>
      ${failure && html`<p role="alert" class="unsent">${failure}</p>`}
      ${isChanged && html`<p role="alert" class="unsent">Your day was changed: look at what is next.
        <button type="button" class="button" onClick=${onSeen}>I have seen it</button></p>`}
    </header>
    ${!day.steps.length && html`<p class="note">Nothing is planned for you any more.</p>`}
    <ol class="steps">${day.steps.map(
      (step) => html`<${Step} key=${step.id} day=${day} step=${step} isNext=${step === next}
        standing=${found.get(step.id)} navigator=${navigator_} onTell=${onTell} />`,
    )}</ol>
    <footer><${Breakdown} broken=${isBroken(found)}
      onTell=${(kind, reason) => onTell(VEHICLE, kind, reason)} />
    <label>Navigate with <select value=${navigator_} onChange=${choose}>
      ${Object.entries(NAVIGATORS).map(
        ([name, { name: label }]) => html`<option key=${name} value=${name}
          selected=${name === navigator_}>${label}</option>`,
      )}</select></label></footer>`;
}

/** What a driver says whose vehicle can't go on, asked once more before it is told. */
function Breakdown({ broken, onTell }) {
  const [isAsking, setAsking] = useState(false);
  const say = (kind, reason) => {
    setAsking(false);
    onTell(kind, reason);
  };
  if (broken) {
    return html`<p role="alert" class="unsent">You told that your vehicle has broken down: others
      are planned for your stops.</p>
      <button type="button" class="button"
        onClick=${() => say('undone')}>It goes on again</button>`;
  }
  if (!isAsking) {
    return html`<button type="button" class="button" onClick=${() => setAsking(true)}>
      My vehicle has broken down</button>`;
  }
  return html`<fieldset><legend>Can your vehicle serve nobody any more today?</legend>
    <div class="actions">
      <button type="button" class="button bad"
        onClick=${() => say('failed', 'Broken down')}>It has broken down</button>
      <button type="button" class="button" onClick=${() => setAsking(false)}>Back</button>
    </div></fieldset>`;
}

function sendingText(count, isReached) {
  if (count) return `${count} not sent yet: sent as soon as there is network.`;
  return isReached ? 'All is sent.' : 'No network: what you mark is kept on this phone.';
}

function Step({ day, step, isNext, standing, navigator, onTell }) {
  const state = standing?.state ?? 'open';
  const [isOpen, setOpen] = useState(null);
  const shown = isOpen ?? isNext;
  const told = { open: '', done: 'done', failed: 'failed' }[state];
  return html`<li class=${`step ${state} ${step.kind}`} aria-current=${isNext ? 'step' : null}>
    <button type="button" class="head" aria-expanded=${shown} onClick=${() => setOpen(!shown)}>
      <span class="time">${clock(day, step.kind === 'stop' ? step.arrival : step.time)}</span>
      <span class="title">${titleOf(step)}</span>
      <span class="state">${told}${standing && !standing.isSent ? ' (not sent)' : ''}</span>
    </button>
    ${shown && html`<div class="body">
      <${Facts} day=${day} step=${step} />
      <${Ways} step=${step} navigator=${navigator} />
      <${Actions} step=${step} state=${state} reason=${standing?.reason}
        onTell=${(kind, reason) => {
          setOpen(null);
          onTell(step.id, kind, reason);
        }} />
    </div>`}
  </li>`;
}

function Facts({ day, step }) {
  const rows = [
    ['Planned', `${clock(day, step.arrival)} to ${clock(day, step.departure)}`],
    ...step.windows.map((window) => ['Window', windowText(day, window)]),
    ...(step.kind === 'stop' || !step.location ? []
      : [['At', step.place]]),
    ...(isSome(step.load) ? [['Load', amounts(step.load)]] : []),
  ];
  return html`<dl>${rows.map(
    ([name, text]) => html`<div key=${name + text}><dt>${name}</dt><dd>${text}</dd></div>`,
  )}</dl>${step.kind !== 'recover' && step.customers.map(
    (customer) => html`<${Customer} key=${customer.id} customer=${customer}
      isNamed=${step.kind === 'launch'} />`,
  )}`;
}

function Customer({ customer, isNamed }) {
  const { phone, ...info } = customer.info;
  const rows = [
    ...(isNamed ? [['For', customer.id]] : []),
    ...(isSome(customer.hand_over) ? [['Hand over', amounts(customer.hand_over)]] : []),
    ...(isSome(customer.take_in) ? [['Take in', amounts(customer.take_in)]] : []),
    ...Object.entries(info),
  ];
  return html`<dl>${rows.map(
    ([name, text]) => html`<div key=${name}><dt>${name}</dt><dd>${text}</dd></div>`,
  )}</dl>
  ${phone && html`<a class="button" href=${telephone(phone)}>Call ${phone}</a>`}`;
}

function Ways({ step: { location }, navigator }) {
  if (!location) return null;
  return html`<a class="button" rel="noopener noreferrer" target="_blank"
    href=${navigation(navigator, location)}>Navigate
    ${' '}<small>${pointText(location)}</small></a>`;
}

function Actions({ step, state, reason, onTell }) {
  const [isFailing, setFailing] = useState(false);
  const [text, setText] = useState('');
  if (state !== 'open') {
    return html`${reason && html`<p class="reason">${reason}</p>`}
      <button type="button" class="button" onClick=${() => onTell('undone')}>Undo</button>`;
  }
  if (!isFailing) {
    return html`<div class="actions">
      <button type="button" class="button good" onClick=${() => onTell('done')}>
        ${DONE[step.kind]}</button>
      ${mayFail(step) && html`<button type="button" class="button bad"
        onClick=${() => setFailing(true)}>Failed</button>`}</div>`;
  }
  return html`<fieldset><legend>Why?</legend>
    <div class="actions">${REASONS[step.kind].map(
      (known) => html`<button type="button" key=${known} class="button"
        aria-pressed=${text === known} onClick=${() => setText(known)}>${known}</button>`,
    )}</div>
    <label>In your words <input type="text" maxlength="500" value=${text}
      onInput=${(event) => setText(event.target.value)} /></label>
    <div class="actions">
      <button type="button" class="button bad" disabled=${!text.trim()}
        onClick=${() => onTell('failed', text.trim())}>It failed</button>
      <button type="button" class="button" onClick=${() => setFailing(false)}>Back</button>
    </div></fieldset>`;
}
