/** Customers of the table who are picked, to be cancelled or bound together. */

import { edit } from '../actions.js';
import { relate } from '../core/relations.js';
import { html } from '../libraries.js';
import { cancelOrders } from '../ordering.js';
import { t } from '../texts.js';

/** Return the names in a text: one, or several as lines, cells or a list have them. */
export function namesIn(text) {
  return text.split(/[\n\t,;]+/).map((name) => name.trim().toLowerCase()).filter(Boolean);
}

/** Return a test for names that are sought: part of one name, or one of several. */
export function soughtBy(text) {
  const names = namesIn(text);
  if (names.length < 2) return ({ id }) => id.toLowerCase().includes(names[0] ?? '');
  const among = new Set(names);
  return ({ id }) => among.has(id.toLowerCase());
}

/** Keep the names apart that are pasted as lines, which a field of one line puts together. */
export function pasteNames(event, setText) {
  const text = event.clipboardData?.getData('text') ?? '';
  if (namesIn(text).length < 2) return;
  event.preventDefault();
  setText(text.trim().split(/[\n\t]+/).map((name) => name.trim()).join(', '));
}

/** The box that picks all who are found, or lets go of them. */
export function PickAll({ rows, picked, setPicked }) {
  const all = rows.length > 0 && rows.every(({ customer }) => picked.has(customer.id));
  const change = () => {
    const changed = new Set(picked);
    rows.forEach(({ customer: { id } }) => (all ? changed.delete(id) : changed.add(id)));
    setPicked(changed);
  };
  return html`<input type="checkbox" checked=${all} disabled=${!rows.length} onChange=${change}
    aria-label=${t('picked.all', { count: rows.length })} />`;
}

/** The box that picks one; the arrow keys left and right lead to it and back to the name. */
export function Pick({ id, picked, setPicked }) {
  const change = () => {
    const changed = new Set(picked);
    if (!changed.delete(id)) changed.add(id);
    setPicked(changed);
  };
  return html`<input type="checkbox" checked=${picked.has(id)} onChange=${change} tabindex="-1"
    aria-label=${t('picked.one', { id })} />`;
}

/** What can be done with those who are picked. */
export function PickedBar({ request, picked, setPicked }) {
  if (!picked.size) return null;
  const ids = request.customers.map(({ id }) => id).filter((id) => picked.has(id));
  if (!ids.length) return null;
  const cancel = () => {
    cancelOrders(ids);
    setPicked(new Set());
  };
  const bind = (kind) => {
    edit(relate(request, kind, ids));
    setPicked(new Set());
  };
  return html`<div class="buttons" role="group" aria-label=${t('picked.title')}>
    <span>${t('picked.count', { count: ids.length })}</span>
    <button type="button" class="primary" onClick=${cancel}>${
      t('picked.cancel', { count: ids.length })}</button>
    ${ids.length > 1 && ['together', 'apart'].map((kind) => html`<button type="button" key=${kind}
      onClick=${() => bind(kind)}>${t(`picked.${kind}`)}</button>`)}
    <button type="button" onClick=${() => setPicked(new Set())}>${t('picked.none')}</button>
  </div>`;
}
