/** Customers and depots: a long table, and a form for the one that is selected. */

import { edit, hover, indexOf, select, shownPlan } from '../actions.js';
import { amounts, clock, duration } from '../core/format.js';
import { freeName } from '../core/changes.js';
import { vehicleColour } from '../core/palette.js';
import { doubtedPlaces, placeOf } from '../core/places.js';
import { saidOf } from '../core/said.js';
import { windowsInCell, windowsOf } from '../core/windows.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { html, useMemo, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { AddressSearch, DoubtedPlaces } from './address-search.js';
import { DayFields } from './day-fields.js';
import { LongTable } from './long-table.js';
import { NewOrder } from './new-order.js';
import { Name } from './parts.js';
import { Places, Relations, Shipments } from './places.js';
import { pasteNames, Pick, PickAll, PickedBar, soughtBy } from './picked-customers.js';
import { t } from '../texts.js';

/** The tab. */
export function CustomersTab() {
  const request = useStore((state) => state.request);
  const epoch = useStore((state) => state.epoch);
  return html`<${NewOrder} /><${CustomerTable} key=${epoch} request=${request} />
    <${AddressSearch} request=${request} />
    <${DoubtedPlaces} request=${request} />
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
    [request.customers, doubts]);
  const columns = useMemo(
    () => columnsOf(request.customers, broken), [request.customers, broken]);
  const head = html`<tr><th scope="col"><${PickAll} rows=${rows} picked=${picked}
      setPicked=${setPicked} /> ${t('field.name')}</th>
    ${columns.amount && html`<th scope="col" class="number">${t('about.demand')}</th>`}
    ${columns.window && html`<th scope="col">${t('about.window')}</th>`}
    ${columns.by && html`<th scope="col" class="roomy">${t('about.for')}</th>`}
    ${index && html`<th scope="col" class="number">${t('about.arrival')}</th>`}</tr>`;
  return html`<section class="section">
    <div class="buttons find"><h3>${t('customers.count', { count: request.customers.length })}</h3>
      <input type="text" value=${filter} placeholder=${t('customers.find')}
        aria-label=${t('customers.findLabel')}
        onPaste=${(event) => pasteNames(event, setFilter)}
        onInput=${(event) => setFilter(event.target.value)} />
      <button type="button" onClick=${() => addCustomer(request)}>
        ${t('customers.add')}</button></div>
    <${PickedBar} request=${request} picked=${picked} setPicked=${setPicked} />
    <${LongTable} label=${t('tab.customers')} height=${roomFor()} head=${head} rows=${rows}
      revealed=${rows.findIndex(({ customer }) => selection === `c:${customer.id}`)}
      renderRow=${({
        customer,
        position,
      }, place) => html`<${CustomerRow} key=${position} place=${place} customer=${customer}
        halt=${index?.halts.get(`c:${customer.id}`)} index=${index} errors=${broken.get(position)}
        columns=${columns} doubted=${doubted.has(customer.id)}
          selected=${selection === `c:${customer.id}`}
          marked=${hovered === `c:${customer.id}`} pick=${html`<${Pick} id=${customer.id}
            picked=${picked} setPicked=${setPicked} />`} />`} />
    ${!request.customers.length && html`<p class="help">${t('customers.none')}</p>
      <div class="buttons"><button type="button" class="primary" popovertarget="open-menu">
        ${t('header.open')}</button></div>`}
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

const LEAST_ROOM = 220;
const AROUND = 380; // pixels that the page has above and below the table

/** Return how high the table may be: most of what is below its head. */
function roomFor() {
  return Math.max(window.innerHeight - AROUND, LEAST_ROOM);
}

/** Return which columns say something of some customers: the others fold away. */
function columnsOf(customers, broken) {
  const wrong = new Set([...broken.values()].flatMap((fields) => [...fields.keys()]));
  const some = (fields, says) => fields.some((field) => wrong.has(field)) || customers.some(says);
  return {
    amount: some(['demand'], ({ demand = [] }) => demand.some(Boolean)),
    window: some(['time_window', 'time_windows'], (customer) => windowsOf(customer).length),
    by: some(['served_by'], ({ served_by: by = 'either' }) => by !== 'either'),
  };
}

function CustomerRow({
  customer, place, halt, index, columns, selected, marked, errors, doubted, pick,
}) {
  const dark = useStore((state) => state.dark);
  const key = `c:${customer.id}`;
  const cell = (field) =>
    errors?.has(field) ? { class: 'invalid', title: errors.get(field) } : {};
  const vehicle = halt?.vehicle;
  const said = useStore(({ live }) => live?.news.get(key));
  const late = halt?.lateness > 0 && `+${duration(halt.lateness)}`;
  return html`<tr ...${place} data-selected=${selected} data-marked=${marked}
      onMouseEnter=${() => hover(key)}
      onMouseLeave=${() => hover(null)}>
    <th scope="row" ...${cell('id')}>${pick}<span class="hue"
        title=${vehicle && nameOfVehicle(vehicle.name)}
        style=${{ background: vehicle && vehicleColour(vehicle.number, dark) }}></span>
      <button type="button" class="link" aria-pressed=${selected}
      title=${customer.id}
      onClick=${() => select(selected ? null : key)}><${Name}>${customer.id}</${Name}>
      </button>${doubted && html` <span class="late-text" role="img" 
      aria-label=${t('customers.doubtful')} title=${t('customers.doubtful')}>?</span>`}${
        halt?.alternative && html`<small>${halt.alternative}</small>`}</th>
    ${columns.amount && html`<td ...${cell('demand')}
      class=${`number ${errors?.has('demand') ? 'invalid' : ''}`}>
      ${amounts(customer.demand ?? [])}</td>`}
    ${columns.window && html`<td
      ...${cell(customer.time_windows ? 'time_windows' : 'time_window')}>
      ${windowsInCell(
        halt?.alternative ? [halt.window].filter(Boolean) : windowsOf(customer))}</td>`}
    ${columns.by && html`<td ...${cell('served_by')}
      class=${`roomy ${errors?.has('served_by') ? 'invalid' : ''}`}>
      ${t(`customers.by.${customer.served_by ?? 'either'}`)}</td>`}
    ${index && html`<td class=${`number ${late || !halt ? 'late-text' : ''}`}>${
      halt ? clock(halt.arrival) : t('customers.notServed')}${said && html`<small
        class=${`news ${said.kind}`}>${said.text}</small>`}${late && html`<small
        >${late}</small>`}</td>`}
    </tr>`;
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
