/** Customers and depots: a long table, and a form for the one that is selected. */

import { edit, hover, indexOf, select, shownPlan } from '../actions.js';
import { amounts, clock } from '../core/format.js';
import { freeName } from '../core/changes.js';
import { doubtedPlaces, placeOf } from '../core/places.js';
import { renamed } from '../core/relations.js';
import { saidOf } from '../core/said.js';
import { windowsInWords, windowsOf } from '../core/windows.js';
import { html, useMemo, useState } from '../libraries.js';
import { cancelOrders } from '../ordering.js';
import { useStore } from '../store.js';
import { AddressSearch, DoubtedPlaces, PlaceOf } from './address-search.js';
import { DayFields } from './day-fields.js';
import { Fields } from './form.js';
import { LongTable } from './long-table.js';
import { NewOrder } from './new-order.js';
import { Name } from './parts.js';
import { Places, Relations, Shipments } from './places.js';
import { pasteNames, Pick, PickAll, PickedBar, soughtBy } from './picked-customers.js';
import { WhyHere } from './why-here.js';
import { t } from '../texts.js';

/** The tab. */
export function CustomersTab() {
  const request = useStore((state) => state.request);
  const epoch = useStore((state) => state.epoch);
  return html`<${NewOrder} /><${CustomerTable} key=${epoch} request=${request} />
    <${AddressSearch} request=${request} />
    <${DoubtedPlaces} request=${request} /><${SelectedCustomer} request=${request} />
    <${Shipments} request=${request} /><${Relations} request=${request} />
    <${Places} request=${request} />
    <${DayFields} request=${request} />`;
}

function CustomerTable({ request }) {
  const index = indexOf(useStore(shownPlan));
  const selection = useStore((state) => state.selection);
  const hovered = useStore((state) => state.hover);
  const errors = useStore((state) => state.errors);
  const [filter, setFilter] = useState('');
  const [picked, setPicked] = useState(new Set());
  const rows = useMemo(() => {
    const isSought = soughtBy(filter);
    return request.customers
      .map((customer, position) => ({ customer, position }))
      .filter(({ customer }) => isSought(customer));
  }, [request.customers, filter]);
  const broken = useMemo(() => brokenCells(errors), [errors]);
  const doubts = useStore((state) => state.doubts);
  const doubted = useMemo(
    () => new Set(doubtedPlaces(request, doubts).map(({ id }) => id)),
    [request.customers, doubts],
  );
  const head = html`<tr><th scope="col"><${PickAll} rows=${rows} picked=${picked}
      setPicked=${setPicked} /> ${t('field.name')}</th>
    <th scope="col" class="number">${t('about.demand')}</th>
    <th scope="col">${t('about.window')}</th><th scope="col" class="roomy">${t('about.for')}</th>
    <th scope="col">${t('about.arrival')}</th></tr>`;
  return html`<section class="section">
    <div class="buttons"><h3>${t('customers.count', { count: request.customers.length })}</h3>
      <input type="text" value=${filter} placeholder=${t('customers.find')}
        aria-label=${t('customers.findLabel')}
        onPaste=${(event) => pasteNames(event, setFilter)}
        onInput=${(event) => setFilter(event.target.value)} />
      <button type="button" onClick=${() => addCustomer(request)}>
        ${t('customers.add')}</button></div>
    <${PickedBar} request=${request} picked=${picked} setPicked=${setPicked} />
    <${LongTable} label=${t('tab.customers')} height=${330} head=${head} rows=${rows}
      revealed=${rows.findIndex(({ customer }) => selection === `c:${customer.id}`)}
      renderRow=${({
        customer,
        position,
      }, place) => html`<${CustomerRow} key=${position} place=${place} customer=${customer}
        halt=${index?.halts.get(`c:${customer.id}`)} index=${index} errors=${broken.get(position)}
        doubted=${doubted.has(customer.id)} selected=${selection === `c:${customer.id}`}
          marked=${hovered === `c:${customer.id}`} pick=${html`<${Pick} id=${customer.id}
            picked=${picked} setPicked=${setPicked} />`} />`} />
    ${!request.customers.length && html`<p class="help">${t('customers.none')}</p>`}
  </section>`;
}

/** Return the fields of each customer that have errors: position to field to message. */
function brokenCells(errors) {
  const cells = new Map();
  for (const {
    keys: [section, position, field],
    ...error
  } of errors) {
    if (section === 'customers' && typeof position === 'number') {
      if (!cells.has(position)) cells.set(position, new Map());
      cells.get(position).set(field ?? 'id', saidOf(error));
    }
  }
  return cells;
}

function CustomerRow({ customer, place, halt, index, selected, marked, errors, doubted, pick }) {
  const key = `c:${customer.id}`;
  const cell = (field) =>
    errors?.has(field) ? { class: 'invalid', title: errors.get(field) } : {};
  const arrival = halt ? clock(halt.arrival) : index ? t('customers.notServed') : '';
  return html`<tr ...${place} data-selected=${selected} data-marked=${marked}
      onMouseEnter=${() => hover(key)}
      onMouseLeave=${() => hover(null)}>
    <th scope="row" ...${cell('id')}>${pick}
      <button type="button" class="link" aria-pressed=${selected}
      title=${customer.id}
      onClick=${() => select(selected ? null : key)}><${Name}>${customer.id}</${Name}>
      </button>${doubted && html` <span class="late-text" role="img" 
      aria-label=${t('customers.doubtful')} title=${t('customers.doubtful')}>?</span>`}</th>
    <td ...${cell('demand')} class=${`number ${errors?.has('demand') ? 'invalid' : ''}`}>
      ${amounts(customer.demand ?? [])}</td>
    <td ...${cell(customer.time_windows ? 'time_windows' : 'time_window')}>
      ${windowsInWords(windowsOf(customer))}</td>
    <td ...${cell('served_by')} class=${`roomy ${errors?.has('served_by') ? 'invalid' : ''}`}>
      ${t(`customers.by.${customer.served_by ?? 'either'}`)}</td>
    <td class=${halt?.lateness > 0 || (index && !halt) ? 'late-text' : ''}>${arrival}</td></tr>`;
}

function addCustomer(request) {
  const dimensions = request.fleet[0]?.capacity.length ?? 1;
  const customer = {
    id: freeName(request.customers, 'customer'),
    location: placeOf(request.depots[0]) ?? [0, 0],
    demand: Array(dimensions).fill(1),
  };
  edit({ ...request, customers: [...request.customers, customer] });
  select(`c:${customer.id}`);
}

function SelectedCustomer({ request }) {
  const schemas = useStore((state) => state.schemas);
  const selection = useStore((state) => state.selection);
  const errors = useStore((state) => state.errors);
  const id = selection?.startsWith('c:') ? selection.slice(2) : null;
  const atError = errors.find(({ keys }) => keys[0] === 'customers' && typeof keys[1] === 'number');
  const selected = request.customers.findIndex((customer) => customer.id === id);
  const position = selected >= 0 ? selected : (atError?.keys[1] ?? -1);
  if (position < 0 || position >= request.customers.length) {
    return html`<p class="help">${t('customers.select')}</p>`;
  }
  const change = (changed) => {
    const name = changed.customers[position]?.id;
    const former = request.customers[position].id;
    edit(name && name !== former ? renamed(changed, former, name) : changed);
    if (name && name !== id) select(`c:${name}`);
  };
  return html`<details class="card" open><summary>${t('where.customer', {
    id: request.customers[position].id,
  })}
      <span class="right"></span></summary>
    <div class="inside"><${PlaceOf} request=${request} id=${request.customers[position].id} />
      <${WhyHere} id=${request.customers[position].id} />
      <${Fields} schema=${schemas.CustomerInput} keys=${['customers', position]} request=${request}
        onChange=${change} skip=${request.matrices ? [] : ['location_index']} />
      <div class="buttons"><button type="button" onClick=${() =>
        cancelOrders([request.customers[position].id])}>${t('customers.remove')}</button></div>
    </div></details>`;
}
