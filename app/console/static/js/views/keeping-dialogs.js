/** Dialogs about kept plans: which there are, by which name to keep one, who may see it. */

import { money } from '../core/format.js';
import { html, useState } from '../libraries.js';
import * as kept from '../keeping/kept.js';
import { useStore } from '../store.js';
import { Dialog } from './parts.js';
import { language, t } from '../texts.js';

const PLACES = ['browser', 'service'];

/** The open dialog, if any. */
export function KeepingDialogs() {
  const keeping = useStore((state) => state.keeping);
  if (!keeping) return null;
  const { View, title } = {
    plans: { View: Plans, title: t('kept.plans') },
    save: { View: Save, title: t('kept.save') },
    conflict: { View: Conflict, title: t('kept.elsewhere') },
    links: { View: Links, title: t('kept.share', { name: keeping.kept?.name }) },
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
  return new Date(instant).toLocaleString(language(), { dateStyle: 'medium', timeStyle: 'short' });
}

/** Return how many customers a plan has and what it costs, in words. */
function contentOf({ customers, cost, day }) {
  if (day) return t('kept.day');
  return cost === null
    ? t('kept.unplanned', { count: customers })
    : t('kept.planned', { count: customers, cost: money(cost) });
}

function Plans({ plans, drafts, failure }) {
  if (!plans) return html`<p role="status">${t('kept.reading')}</p>`;
  return html`<${Failure} failure=${failure} />
    ${!plans.length && html`<p>${t('kept.none')}</p>`}
    <ul class="kept-list" aria-label=${t('kept.plans')}>${plans.map(
      (plan) => html`<${Kept} key=${plan.where + plan.id} plan=${plan} />`,
    )}</ul>
    ${drafts.length > 0 && html`<h3>${t('kept.drafts')}</h3>
      <ul class="kept-list" aria-label=${t('kept.draftsLabel')}>${drafts.map(
        (draft) => html`<${Draft} key=${draft.id} draft=${draft} />`,
      )}</ul>`}`;
}

function Kept({ plan }) {
  const entry = useStore((state) => state.home);
  const hasPlan = useStore((state) => state.shown !== null);
  const isOpen = entry?.id === plan.id && entry.where === plan.where;
  const { name, note, cost, where, links } = plan;
  return html`<li><div class="kept-what"><strong>${name}</strong>
      ${isOpen && html`<span class="help">${t('kept.isOpen')}</span>`}
      <span class="help">${contentOf(plan)} ${t(`kept.where.${where}`)}, ${when(plan.changed_at)}${
        links > 0 ? `, ${t('kept.linkCount', { count: links })}` : ''}
      </span>${note && html`<span>${note}</span>`}</div>
    <div class="buttons"><button type="button" aria-label=${t('kept.openOf', { name })}
        onClick=${() => kept.openKept(plan)}>${t('kept.open')}</button>
      <button type="button" disabled=${cost === null || !hasPlan}
        aria-label=${t('kept.compareOf', { name })}
        onClick=${() => kept.putBeside(plan)}>${t('kept.compare')}</button>
      ${where === 'service' && html`<button type="button" aria-label=${t('kept.share', { name })}
        onClick=${() => kept.openLinks(plan)}>${t('kept.shareIt')}</button>`}
      <${Deletion} name=${name} warning=${links > 0 ? t('kept.linksEnd') : ''}
        onDelete=${() => kept.deleteKept(plan)} /></div></li>`;
}

/** A button that deletes at the second click. */
function Deletion({ name, warning = '', onDelete }) {
  const [asked, setAsked] = useState(false);
  if (!asked) {
    return html`<button type="button" aria-label=${t('kept.deleteOf', { name })}
      onClick=${() => setAsked(true)}>${t('kept.delete')}</button>`;
  }
  return html`<span role="alert">${`${t('kept.deleteAsk', { name })} ${warning}`}</span>
    <button type="button" class="stop" onClick=${onDelete}>${t('kept.deleteYes')}</button>
    <button type="button" ref=${(element) => element?.focus()}
      onClick=${() => setAsked(false)}>${t('kept.deleteNo')}</button>`;
}

function Draft({ draft }) {
  const { id, name, changedAt, isOpen } = draft;
  return html`<li><div class="kept-what"><strong>${name}</strong>
      <span class="help">${contentOf(draft)} ${when(changedAt)}</span></div>
    ${isOpen
        ? html`<span class="help">${t('kept.openElsewhere')}</span>`
        : html`<div class="buttons"><button type="button" aria-label=${t('kept.goOnOf', { name })}
          onClick=${() => kept.openDraft(id)}>${t('kept.goOn')}</button>
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
    <label>${t('kept.name')} <input type="text" id="save-name" value=${name} maxlength="200"
      onInput=${(event) => kept.change({ name: event.target.value })} /></label>
    <label>${t('kept.note')} <input type="text" id="save-note" value=${note} maxlength="10000"
      onInput=${(event) => kept.change({ note: event.target.value })} /></label>
    <fieldset class="group"><legend>${t('kept.whereAsk')}</legend>${PLACES.map(
      (place) => html`<label key=${place} class="check"><input type="radio" name="where"
        checked=${where === place} onChange=${() => kept.change({ where: place })} />
        ${' '}${t(`kept.where.${place}`)}
        ${' '}<span class="help">${t(`kept.hint.${place}`)}</span></label>`,
    )}</fieldset>
    ${stale && html`<p class="help">${t('kept.stale')}</p>`}
    <div class="buttons"><button type="submit" class="primary" id="save-as"
        disabled=${busy || !name.trim()}>${home ? t('kept.another') : t('kept.save')}</button>
      <button type="button" disabled=${busy || !name.trim()}
        onClick=${kept.renameOpen}>${t('kept.rename')}</button></div>
  </form>`;
}

function Conflict({ failure }) {
  const home = useStore((state) => state.home);
  return html`<${Failure} failure=${failure} />
    <p>${t('kept.conflict')}</p>
    <div class="buttons"><button type="button" class="primary"
        onClick=${kept.askName}>${t('kept.another')}</button>
      <button type="button" onClick=${kept.saveAnyway}>${t('kept.inPlace')}</button>
      <button type="button" onClick=${() => kept.openKept(home)}>
        ${t('kept.openOther')}</button></div>`;
}

function Links({ links, url, busy, failure }) {
  return html`<${Failure} failure=${failure} />
    <p>${t('kept.linkHelp')}</p>
    ${url &&
      html`<label>${t('kept.linkOnce')} <input type="text" id="share-url" readonly value=${url}
        onFocus=${(event) => event.target.select()} /></label>
      <${Copy} text=${url} />`
    }
    <ul class="kept-list" aria-label=${t('kept.links')}>${links.map(
      ({ id, created_at: made }) => html`<li key=${id}><span>${t('kept.made', {
        when: when(made),
      })}</span>
        <button type="button" onClick=${() => kept.endLink(id)}>${t('kept.end')}</button></li>`,
    )}</ul>
    <div class="buttons"><button type="button" class="primary" disabled=${busy}
      onClick=${kept.makeLink}>${t('kept.makeLink')}</button>
      <button type="button" onClick=${kept.openPlans}>${t('kept.back')}</button></div>`;
}

/** A button that copies; browsers allow it over HTTPS and on this machine alone. */
function Copy({ text }) {
  const [done, setDone] = useState(false);
  if (!navigator.clipboard) return null;
  const copy = async () => {
    await navigator.clipboard.writeText(text);
    setDone(true);
  };
  return html`<button type="button" onClick=${copy}>${t('kept.copy')}</button>
    <span role="status">${done && t('kept.copied')}</span>`;
}
