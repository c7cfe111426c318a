/** Customers that no vehicle serves, by what would help: its price, and one click to apply it. */

import { edit, indexOf, shownPlan } from '../actions.js';
import { money, signed } from '../core/format.js';
import { remedyInWords } from '../core/remedy-words.js';
import { applied, groupUnassigned } from '../core/remedies.js';
import { saidOf } from '../core/said.js';
import { leftOutOf } from '../core/visits.js';
import { html, useEffect, useMemo } from '../libraries.js';
import { plan } from '../planning.js';
import { priceGroup, priceLargest, priceOf } from '../pricing.js';
import { useStore } from '../store.js';
import { linked, SelectButton } from './parts.js';
import { StopMoves } from './stop-moves.js';
import { WhyHere } from './why-here.js';
import { t } from '../texts.js';

/** Customers of a group who are shown one by one from the start. */
const FEW = 3;

/** The tab. */
export function UnassignedTab() {
  const entry = useStore(shownPlan);
  const idle = useStore((state) => state.run.state === 'idle');
  const groups = useMemo(
    () => (entry ? groupUnassigned(entry.request, entry.plan.unassigned) : []),
    [entry]);
  useEffect(() => {
    if (entry && idle) priceLargest(entry, groups);
  }, [entry, idle]);
  if (!entry) return html`<p class="empty">${t('timeline.nothing')}</p>`;
  const { unassigned, summary } = entry.plan;
  if (!unassigned.length) return html`<p class="empty">${t('unassigned.none')}</p>`;
  return html`<section class="section"><h3>${t('unassigned.count', {
    count: unassigned.length,
  })}</h3>
    ${summary.must_unserved > 0 && html`<p>${t('unassigned.must', {
      count: summary.must_unserved,
    })}</p>`}
    ${groups.map((group) => html`<${Group} key=${group.key} group=${group}
      entry=${entry} />`)}</section>`;
}

function Group({ group, entry }) {
  const request = useStore((state) => state.request);
  const { members } = group;
  const customers = members.map(
    ({ customer }) => html`<${Unassigned} key=${customer.id} customer=${customer}
      entry=${entry} request=${request} />`);
  const ways = [group, ...group.others];
  const price = (way) => way.changed && html`<${Price} group=${way} entry=${entry} />`;
  const priced = ways.map((way) => html`<${Way} key=${way.key} way=${way}
    told=${entry.request} />${price(way)}`);
  if (members.length === 1) {
    return html`<section>${customers}${ways.length > 1 ? priced : price(group)}</section>`;
  }
  return html`<section class="group" data-group=${group.key}>
    <h4>${t('unassigned.like', { count: members.length, name: members[0].customer.id })}:
      ${' '}${members[0].reason ? saidOf(members[0].reason) : t('unassigned.noReason')}</h4>
    ${priced}
    <details open=${members.length <= FEW}><summary>${members
      .map(({ customer }) => customer.id)
      .slice(0, 2 * FEW)
      .join(', ')}${members.length > 2 * FEW ? ' \u2026' : ''}</summary>${customers}</details>
  </section>`;
}

/** What would help all of a group. */
function Way({ way: { remedy, isForEach }, told }) {
  if (!remedy) return null;
  return html`<p>${isForEach ? `${t('unassigned.each')} ` : ''}${sentenceOf(remedy, told)}.</p>`;
}

/** What a remedy for a whole group serves and costs, and the button that applies it. */
function Price({ group, entry }) {
  const prices = useStore((state) => state.prices);
  const request = useStore((state) => state.request);
  const price = priceOf(prices, entry, group);
  const apply = () => {
    edit(group.changed);
    plan();
  };
  return html`<div class="buttons"><span class="price" aria-live="polite">${priceInWords(
    price,
    group,
  )}</span>
    ${!price && html`<button type="button" onClick=${() => priceGroup(entry, group)}>
        ${t('unassigned.whatCosts')}</button>`}
    ${group.members.length > 1 &&
      html`<button type="button" class="primary" disabled=${request !== entry.request}
      aria-label=${[t('unassigned.applyAllOf', {
        count: group.members.length,
        remedy: remedyInWords(group.remedy, entry.request),
      }), group.type].join(', ')} onClick=${apply}>${t('unassigned.applyAll')}</button>`
    }</div>`;
}

function priceInWords(price, { members }) {
  if (!price) return '';
  if (price.state === 'asking') return t('unassigned.asking');
  if (price.state === 'failed') return price.reason;
  if (price.served <= 0) return t('unassigned.nobody');
  const cost = signed(price.cost, money);
  return members.length === 1
    ? t('unassigned.servesIt', { cost })
    : t('unassigned.serves', { count: price.served, cost });
}

function Unassigned({ customer, entry, request }) {
  const selection = useStore((state) => state.selection);
  const hovered = useStore((state) => state.hover);
  const key = `c:${customer.id}`;
  const [{ id: name }] = leftOutOf({ unassigned: [customer] });
  return html`<article class="card" ...${linked(
    indexOf(entry), key, selection, hovered)}>
    <header><${SelectButton} of=${key}><strong>${customer.id}</strong></${SelectButton}></header>
    <div class="inside">${customer.reasons.map((reason) => html`<div key=${reason.vehicle_type}>
      <p><strong>${reason.vehicle_type}</strong>: ${saidOf(reason)}</p>
      ${reason.remedies?.map((remedy) => html`<${Remedy} key=${remedy.text} remedy=${remedy}
        of=${[reason.vehicle_type, customer.id]} told=${entry.request} request=${request} />`)}
    </div>`)}<${StopMoves} id=${name} /><${WhyHere} id=${name} /></div></article>`;
}

/** Return a remedy as a sentence without its full stop. */
function sentenceOf(remedy, told) {
  const words = remedyInWords(remedy, told);
  return words.charAt(0).toUpperCase() + words.slice(1);
}

function Remedy({ remedy, of, told, request }) {
  const changed = applied(request, remedy.changes, told);
  const apply = () => {
    edit(changed);
    plan();
  };
  return html`<div class="buttons"><span>${sentenceOf(remedy, told)}.</span>
    ${changed && html`<button type="button" onClick=${apply}
      aria-label=${[t('unassigned.applyOf', { remedy: remedyInWords(remedy, told) }), ...of]
        .join(', ')}>
      ${t('unassigned.apply')}</button>`}</div>`;
}
