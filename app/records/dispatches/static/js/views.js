/** What drivers see. */

import { html, useEffect, useRef, useState } from '../../console/vendor/htm-3.1.1/standalone.module.js';
import { clock, windowText } from './clocks.js';
import { chooseFormat, chosenFormat, FORMATS } from './flights.js';
import { LanguageChoice } from './language-choice.js';
import {
  chooseNavigator,
  chosenNavigator,
  navigation,
  navigatorName,
  NAVIGATORS,
  pointText,
} from './navigators.js';
import { drawOn, signatureOf, smallPhoto } from './proofs.js';
import { draftOf, keepDraft, REASONS, reasonText, toldReason } from './reasons.js';
import {
  amounts,
  countOver,
  isBroken,
  isOther,
  isSome,
  mayFail,
  newsOf,
  nextStep,
  standings,
  telephone,
  titleOf,
  VEHICLE,
} from './steps.js';
import { choose, language, t } from './texts.js';

/** A page that has nothing but something to say. */
export function Message({ text }) {
  return html`<h1>${t('page.title')}</h1><p class="note" role="alert">${text}</p>`;
}

/** Return what people call the vehicle; days that were kept before may not tell. */
export function calledIn({ name, vehicle }) {
  return name ?? vehicle;
}

/** The whole day. */
export function Day({ day, waiting, isReached, failure, sharing, link, onTell, onProve, onSeen,
  onShare, onLanguage, onFlights }) {
  const [navigator_, setNavigator] = useState(
    chosenNavigator(localStorage, window.navigator.userAgent),
  );
  const found = standings(day.standing, waiting);
  const next = nextStep(day.steps, found);
  const lead = (event) => {
    chooseNavigator(localStorage, event.target.value);
    setNavigator(event.target.value);
  };
  return html`<header>
      <h1>${day.flies ? t('day.flies', { vehicle: calledIn(day) }) : calledIn(day)}</h1>
      <p>${t('day.over', { count: countOver(day.steps, found), of: day.steps.length })}</p>
      <p role="status" class=${waiting.length ? 'unsent' : ''}>${sendingText(
        waiting.length,
        isReached,
      )}</p>
      ${failure && html`<p role="alert" class="unsent">${failure}</p>`}
      ${isOther(day.seen ?? day.steps, day.steps) && html`<${News} day=${day}
        onSeen=${onSeen} />`}
    </header>
    ${!day.steps.length && html`<p class="note">${t('day.nothing')}</p>`}
    <ol class="steps">${day.steps.map(
      (step) => html`<${Step} key=${step.id} day=${day} step=${step} isNext=${step === next}
        standing=${found.get(step.id)} navigator=${navigator_} link=${link} onTell=${onTell}
        onProve=${onProve} />`,
    )}</ol>
    <footer><${Breakdown} broken=${isBroken(found)}
      onTell=${(kind, reason) => onTell(VEHICLE, kind, reason)} />
    ${day.flights > 0 && html`<${Flights} onFlights=${onFlights} />`}
    <label>${t('page.navigate')} <select value=${navigator_} onChange=${lead}>
      ${Object.keys(NAVIGATORS).map(
        (name) => html`<option key=${name} value=${name}
          selected=${name === navigator_}>${navigatorName(name)}</option>`,
      )}</select></label>
    ${day.asks_position && html`<${Sharing} sharing=${sharing} onShare=${onShare} />`}
    <${LanguageChoice} label=${t('page.language')} language=${language()}
      onChoose=${async (name) => {
        await choose(name);
        onLanguage();
      }} /></footer>`;
}

/** What is new since the driver looked, and what was taken away. */
function News({ day, onSeen }) {
  const { added, gone } = newsOf(day);
  const listed = (name, steps) => steps.length > 0 && html`<dl><div><dt>${t(`day.${name}`)}</dt>
    <dd>${steps.map((step) => `${titleOf(step)}, ${clock(day, step.arrival)}`).join('\n')}</dd>
    </div></dl>`;
  return html`<div role="alert" class="unsent">${t('day.changed')}
    ${listed('added', added)}${listed('gone', gone)}
    <button type="button" class="button" onClick=${onSeen}>${t('day.seen')}</button></div>`;
}

/** Flights of the vehicle's drones, to be loaded into what flies them. */
function Flights({ onFlights }) {
  const [format, setFormat] = useState(chosenFormat(localStorage));
  const [failure, setFailure] = useState('');
  const choose_ = (event) => {
    chooseFormat(localStorage, event.target.value);
    setFormat(event.target.value);
    setFailure('');
  };
  return html`<label>${t('flights.format')} <select value=${format} onChange=${choose_}>
    ${Object.entries(FORMATS).map(
      ([name, label]) => html`<option key=${name} value=${name}
        selected=${name === format}>${label}</option>`,
    )}</select></label>
    <button type="button" class="button" onClick=${async () =>
      setFailure(await onFlights(format))}>${t('flights.save')}</button>
    <p class="hint">${t('flights.facts')}</p>
    ${failure && html`<p role="alert" class="unsent">${failure}</p>`}`;
}

/** Whether the vehicle's place is told, and to whom. */
function Sharing({ sharing, onShare }) {
  return html`<label class="switch"><input type="checkbox" role="switch"
      checked=${sharing === 'on'} onChange=${(event) => onShare(event.target.checked)} />
    ${t('share.switch')}</label>
    <p class="hint">${t('share.who')}</p>
    ${sharing === 'refused' && html`<p role="alert" class="unsent">${t('share.refused')}</p>`}`;
}

/** What a driver says whose vehicle can't go on, asked once more before it is told. */
function Breakdown({ broken, onTell }) {
  const [isAsking, setAsking] = useState(false);
  const say = (kind, reason) => {
    setAsking(false);
    onTell(kind, reason);
  };
  if (broken) {
    return html`<p role="alert" class="unsent">${t('breakdown.told')}</p>
      <button type="button" class="button"
        onClick=${() => say('undone')}>${t('breakdown.over')}</button>`;
  }
  if (!isAsking) {
    return html`<button type="button" class="button" onClick=${() => setAsking(true)}>
      ${t('breakdown.begin')}</button>`;
  }
  return html`<fieldset><legend>${t('breakdown.sure')}</legend>
    <div class="actions">
      <button type="button" class="button bad"
        onClick=${() => say('failed', toldReason('breakdown'))}>${t('breakdown.yes')}</button>
      <button type="button" class="button" onClick=${() => setAsking(false)}>
        ${t('breakdown.back')}</button>
    </div></fieldset>`;
}

function sendingText(count, isReached) {
  if (count) return t('day.unsent', { count });
  return isReached ? t('day.sent') : t('day.offline');
}

function Step({ day, step, isNext, standing, navigator, link, onTell, onProve }) {
  const state = standing?.state ?? 'open';
  const [isOpen, setOpen] = useState(null);
  const shown = isOpen ?? isNext;
  const told = state === 'open' ? '' : t(`state.${state}`);
  const isUnsent = standing && !standing.isSent;
  return html`<li class=${`step ${state} ${step.kind}`} aria-current=${isNext ? 'step' : null}>
    <button type="button" class="head" aria-expanded=${shown} onClick=${() => setOpen(!shown)}>
      <span class="time">${clock(day, step.kind === 'stop' ? step.arrival : step.time)}</span>
      <span class="title">${titleOf(step)}</span>
      <span class="state">${told} ${told &&
        html`<span class=${isUnsent ? '' : 'sent'}>${t('state.unsent')}</span>`}</span>
    </button>
    ${shown && html`<div class="body">
      <${Facts} day=${day} step=${step} />
      ${!day.flies && html`<${Ways} step=${step} navigator=${navigator} />`}
      <${Actions} link=${link} step=${step} state=${state} reason=${standing?.reason}
        onTell=${(kind, reason) => {
          setOpen(null);
          onTell(step.id, kind, reason);
        }} />
      ${step.kind === 'stop' && html`<${Proof} isKept=${day.proven?.includes(step.id)}
        onProve=${(proof) => onProve(step.id, proof)} />`}
    </div>`}
  </li>`;
}

function Facts({ day, step }) {
  const rows = [
    [t('fact.planned'), t('time.span', {
      from: clock(day, step.arrival),
      until: clock(day, step.departure),
    })],
    ...step.windows.map((window) => [t('fact.window'), windowText(day, window)]),
    ...(step.kind === 'stop' || !step.location ? []
      : [[t('fact.at'), step.place]]),
    ...(isSome(step.load) ? [[t('fact.load'), amounts(step.load, step.load_units)]] : []),
  ];
  return html`<dl>${rows.map(
    ([name, text]) => html`<div key=${name + text}><dt>${name}</dt><dd>${text}</dd></div>`,
  )}</dl>${step.kind !== 'recover' && step.customers.map(
    (customer) => html`<${Customer} key=${customer.id} customer=${customer}
      units=${step.load_units} isNamed=${step.kind === 'launch'} />`,
  )}`;
}

/** What dispatchers often note of customers; all else is called as they call it. */
const NOTED = ['address', 'notes', 'order', 'name', 'phone'];

function factName(name) {
  return NOTED.includes(name) ? t(`fact.${name}`) : name;
}

function Customer({ customer, units, isNamed }) {
  const { phone, ...info } = customer.info;
  const rows = [
    ...(isNamed ? [[t('fact.for'), customer.id]] : []),
    ...(isSome(customer.hand_over) ? [[t('fact.handOver'), amounts(customer.hand_over, units)]]
      : []),
    ...(isSome(customer.take_in) ? [[t('fact.takeIn'), amounts(customer.take_in, units)]] : []),
    ...Object.entries(info).map(([name, text]) => [factName(name), text]),
  ];
  return html`<dl>${rows.map(
    ([name, text]) => html`<div key=${name}><dt>${name}</dt><dd>${text}</dd></div>`,
  )}</dl>
  ${phone && html`<a class="button" href=${telephone(phone)}>${t('action.call', {
    number: phone,
  })}</a>`}`;
}

function Ways({ step, navigator }) {
  if (!step.location) return null;
  return html`<a class="button" rel="noopener noreferrer" target="_blank"
    href=${navigation(navigator, step)}>${t('action.navigate')}
    ${' '}<small>${pointText(step.location)}</small></a>`;
}

function Actions({ link, step, state, reason, onTell }) {
  const [draft, setDraft] = useState(draftOf(localStorage, link, step.id));
  const write = (text) => {
    keepDraft(localStorage, link, step.id, text);
    setDraft(text);
  };
  const tell = (kind, told) => {
    write(null);
    onTell(kind, told);
  };
  if (state !== 'open') {
    return html`${reason && html`<p class="reason">${reasonText(reason)}</p>`}
      <button type="button" class="button" onClick=${() => tell('undone')}>
        ${t('action.undo')}</button>`;
  }
  if (draft === null) {
    return html`<div class="actions">
      <button type="button" class="button good" onClick=${() => tell('done')}>
        ${t(`done.${step.kind}`)}</button>
      ${mayFail(step) && html`<button type="button" class="button bad"
        onClick=${() => write('')}>${t('action.failed')}</button>`}</div>`;
  }
  return html`<${Failing} kind=${step.kind} text=${draft} onWrite=${write}
    onFail=${(told) => tell('failed', told)} />`;
}

/** Who took it, a photo and a signature: each may lack. */
function Proof({ isKept, onProve }) {
  const [isOpen, setOpen] = useState(false);
  const form = useRef(null);
  const canvas = useRef(null);
  const [isSigned, setSigned] = useState(false);
  useEffect(() => {
    if (isOpen) drawOn(canvas.current, () => setSigned(true));
  }, [isOpen]);
  if (!isOpen) {
    return html`${isKept && html`<p class="hint" role="note">${t('proof.kept')}</p>`}
      <button type="button" class="button" onClick=${() => setOpen(true)}>
        ${t('proof.begin')}</button>`;
  }
  const keep = async () => {
    const [name, photo] = form.current.querySelectorAll('input');
    const proof = {
      name: name.value.trim(),
      ...(photo.files[0] && { photo: await smallPhoto(photo.files[0]) }),
      ...(isSigned && { signature: await signatureOf(canvas.current) }),
    };
    setOpen(false);
    setSigned(false);
    onProve(proof);
  };
  return html`<fieldset ref=${form}><legend>${t('proof.begin')}</legend>
    <label>${t('proof.name')} <input type="text" maxlength="100" autocomplete="off" /></label>
    <label>${t('proof.photo')}
      <input type="file" accept="image/*" capture="environment" /></label>
    <label>${t('proof.signature')} <canvas class="signature" ref=${canvas}></canvas></label>
    <div class="actions">
      <button type="button" class="button good" onClick=${keep}>${t('proof.keep')}</button>
      <button type="button" class="button" onClick=${() => setOpen(false)}>
        ${t('action.back')}</button>
    </div></fieldset>`;
}

/** Why a step failed: one more tap tells a known reason, any other is written. */
function Failing({ kind, text, onWrite, onFail }) {
  return html`<fieldset><legend>${t('action.why')}</legend>
    <p class="hint">${t('action.tap')}</p>
    <div class="actions">${REASONS[kind].map(
      (name) => html`<button type="button" key=${name} class="button bad"
        onClick=${() => onFail(toldReason(name))}>${t(`reason.${name}`)}</button>`,
    )}</div>
    <label>${t('action.words')} <input type="text" maxlength="500" value=${text}
      onInput=${(event) => onWrite(event.target.value)} /></label>
    <div class="actions">
      <button type="button" class="button bad" disabled=${!text.trim()}
        onClick=${() => onFail(text.trim())}>${t('action.tell')}</button>
      <button type="button" class="button" onClick=${() => onWrite(null)}>
        ${t('action.back')}</button>
    </div></fieldset>`;
}
