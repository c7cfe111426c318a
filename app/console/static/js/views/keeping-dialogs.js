/** Dialogs about kept plans: which there are, by which name to keep one, who may see it. */

import { count, money } from '../core/format.js';
import { html, useState } from '../libraries.js';
import * as kept from '../keeping/kept.js';
import { useStore } from '../store.js';
import { Dialog } from './parts.js';

const PLACES = { browser: 'This browser', service: 'The service' };

/** The open dialog, if any. */
export function KeepingDialogs() {
  const keeping = useStore((state) => state.keeping);
  if (!keeping) return null;
  const { View, title } = {
    plans: { View: Plans, title: 'Saved plans' },
    save: { View: Save, title: 'Save' },
    conflict: { View: Conflict, title: 'Changed elsewhere' },
    links: { View: Links, title: `Share ${keeping.kept?.name}` },
  }[keeping.view];
  return html`<${Dialog} key=${keeping.view} title=${title} name="keeping"
      wide=${keeping.view === 'plans'} onClose=${kept.closeKeeping}>
    <${View} ...${keeping} /></${Dialog}>`;
}

function Failure({ failure }) {
  if (!failure) return null;
  return html`<p class="error" role="alert">${failure.title && html`<strong>${failure.title}.
    </strong>${' '}`}${failure.message}</p>`;
}

function when(instant) {
  return new Date(instant).toLocaleString([], { dateStyle: 'medium', timeStyle: 'short' });
}

function Plans({ plans, drafts, failure }) {
  if (!plans) return html`<p role="status">Reading what is saved.</p>`;
  return html`<${Failure} failure=${failure} />
    ${!plans.length && html`<p>Nothing is saved by a name yet.</p>`}
    <ul class="kept-list" aria-label="Saved plans">${plans.map(
      (plan) => html`<${Kept} key=${plan.where + plan.id} plan=${plan} />`,
    )}</ul>
    ${
      drafts.length > 0 &&
      html`<h3>Worked on in this browser, not saved</h3>
      <ul class="kept-list" aria-label="Drafts">${drafts.map(
        (draft) => html`<${Draft} key=${draft.id} draft=${draft} />`,
      )}</ul>`
    }`;
}

function Kept({ plan }) {
  const entry = useStore((state) => state.home);
  const hasPlan = useStore((state) => state.shown !== null);
  const isOpen = entry?.id === plan.id && entry.where === plan.where;
  const { name, note, customers, cost, where, links } = plan;
  return html`<li><div class="kept-what"><strong>${name}</strong>
      ${isOpen && html`<span class="help">open</span>`}
      <span class="help">${count(customers, 'customer')}, ${
        cost === null ? 'not planned' : `cost ${money(cost)}`
      }. ${PLACES[where]}, ${when(plan.changed_at)}${links > 0 ? `, ${count(links, 'link')}` : ''}
      </span>${note && html`<span>${note}</span>`}</div>
    <div class="buttons"><button type="button" aria-label=${`Open ${name}`}
        onClick=${() => kept.openKept(plan)}>Open</button>
      <button type="button" disabled=${cost === null || !hasPlan}
        aria-label=${`Compare ${name} with what is open`}
        onClick=${() => kept.putBeside(plan)}>Compare</button>
      ${
        where === 'service' &&
        html`<button type="button" aria-label=${`Share ${name}`}
        onClick=${() => kept.openLinks(plan)}>Share</button>`
      }
      <${Deletion} name=${name} warning=${links > 0 ? 'Its links end, too.' : ''}
        onDelete=${() => kept.deleteKept(plan)} /></div></li>`;
}

/** A button that deletes at the second click. */
function Deletion({ name, warning = '', onDelete }) {
  const [asked, setAsked] = useState(false);
  if (!asked) {
    return html`<button type="button" aria-label=${`Delete ${name}`}
      onClick=${() => setAsked(true)}>Delete</button>`;
  }
  return html`<span role="alert">${`Delete ${name} for good? ${warning}`}</span>
    <button type="button" class="stop" onClick=${onDelete}>Delete for good</button>
    <button type="button" ref=${(element) => element?.focus()}
      onClick=${() => setAsked(false)}>Leave it</button>`;
}

function Draft({ draft }) {
  const { id, name, customers, cost, changedAt, isOpen } = draft;
  return html`<li><div class="kept-what"><strong>${name}</strong>
      <span class="help">${count(customers, 'customer')}, ${
        cost === null ? 'not planned' : `cost ${money(cost)}`
      }. ${when(changedAt)}</span></div>
    ${
      isOpen
        ? html`<span class="help">open in another tab</span>`
        : html`<div class="buttons"><button type="button" aria-label=${`Go on with ${name}`}
          onClick=${() => kept.openDraft(id)}>Go on</button>
        <${Deletion} name=${name} onDelete=${() => kept.deleteDraft(id)} /></div>`
    }</li>`;
}

function Save({ name, note, where, busy, failure }) {
  const home = useStore((state) => state.home);
  const stale = useStore(({ plans, shown, request }) =>
    plans.some((entry) => entry.number === shown && entry.request !== request));
  const submit = (event) => {
    event.preventDefault();
    if (name.trim()) kept.saveAsNew();
  };
  return html`<form onSubmit=${submit}><${Failure} failure=${failure} />
    <label>Name <input type="text" id="save-name" value=${name} maxlength="200"
      onInput=${(event) => kept.change({ name: event.target.value })} /></label>
    <label>Note <input type="text" id="save-note" value=${note} maxlength="10000"
      onInput=${(event) => kept.change({ note: event.target.value })} /></label>
    <fieldset class="group"><legend>Where</legend>${Object.entries(PLACES).map(
      ([place, title]) => html`<label key=${place} class="check"><input type="radio" name="where"
        checked=${where === place} onChange=${() => kept.change({ where: place })} /> ${title}
        ${' '}<span class="help">${HINTS[place]}</span></label>`,
    )}</fieldset>
    ${stale && html`<p class="help">The problem has changed since it was planned: it is saved
      without a plan. Plan it first to save both.</p>`}
    <div class="buttons"><button type="submit" class="primary" id="save-as"
        disabled=${busy || !name.trim()}>${home ? 'Save as another' : 'Save'}</button>
      <button type="button" disabled=${busy || !name.trim()}
        onClick=${kept.renameOpen}>Rename only</button></div>
  </form>`;
}

const HINTS = {
  browser: 'for you alone, here',
  service: 'for all who have the same key, and to share',
};

function Conflict({ failure }) {
  const home = useStore((state) => state.home);
  return html`<${Failure} failure=${failure} />
    <p>What you have is still here. Save it beside the other, or in its place.</p>
    <div class="buttons"><button type="button" class="primary"
        onClick=${kept.askName}>Save as another</button>
      <button type="button" onClick=${kept.saveAnyway}>Save in its place</button>
      <button type="button" onClick=${() => kept.openKept(home)}>Open the other</button></div>`;
}

function Links({ links, url, busy, failure }) {
  return html`<${Failure} failure=${failure} />
    <p>Whoever has the link sees this plan as it is then, without a key, and can change nothing.
      It ends when you end it or delete the plan.</p>
    ${
      url &&
      html`<label>Link, shown only now <input type="text" id="share-url" readonly value=${url}
        onFocus=${(event) => event.target.select()} /></label>
      <${Copy} text=${url} />`
    }
    <ul class="kept-list" aria-label="Links">${links.map(
      ({ id, created_at: made }) => html`<li key=${id}><span>Made ${when(made)}</span>
        <button type="button" onClick=${() => kept.endLink(id)}>End</button></li>`,
    )}</ul>
    <div class="buttons"><button type="button" class="primary" disabled=${busy}
      onClick=${kept.makeLink}>Make a link</button>
      <button type="button" onClick=${kept.openPlans}>Back</button></div>`;
}

/** A button that copies; browsers allow it over HTTPS and on this machine alone. */
function Copy({ text }) {
  const [done, setDone] = useState(false);
  if (!navigator.clipboard) return null;
  const copy = async () => {
    await navigator.clipboard.writeText(text);
    setDone(true);
  };
  return html`<button type="button" onClick=${copy}>Copy</button>
    <span role="status">${done && 'Copied.'}</span>`;
}
