/** Scenarios: fleets side by side, and sweeps of one or two fields as a heat map. */

import { withoutDrones } from '../core/changes.js';
import { droneCount } from '../core/drones.js';
import { hours, money, number, percent } from '../core/format.js';
import {
  axesAround, heatTable, readValues, valuesAround, variableFields, writeAt,
} from '../core/grid.js';
import { fittingSeconds } from '../core/limits.js';
import { heatColour } from '../core/palette.js';
import { fromNothing } from '../core/replanning.js';
import { withinSentence } from '../core/schema.js';
import { costTerms, penaltyOf, statesPenalty, trueTerms } from '../core/terms.js';
import { html, useMemo, useState } from '../libraries.js';
import { showScenarioJob, showScenarioPlan, startScenario, stopScenario } from '../scenarios.js';
import { store, useStore } from '../store.js';
import { t } from '../texts.js';

/** The tab. */
export function ScenariosTab() {
  const scenario = useStore((state) => state.scenario);
  return html`<${SecondsEach} /><${Compare} /><${Sweep} />
    ${scenario && html`<${Running} scenario=${scenario} />`}
    ${scenario?.result &&
      (scenario.kind === 'compare'
        ? html`<${CompareResult} scenario=${scenario} />`
        : html`<${SweepResult} scenario=${scenario} />`)
    }`;
}

function SecondsEach() {
  const seconds = useStore(secondsEach);
  return html`<label>${t('scenario.seconds')} <input type="text" inputmode="decimal"
    size="5"
    value=${seconds} onChange=${(event) => {
      const value = Number(event.target.value);
      if (value >= 0) store.set({ scenarioSeconds: value });
      else event.target.value = seconds;
    }} /></label>`;
}

/** Return how long each scenario is searched: as stated, else as long as fits the problem. */
function secondsEach({ request, scenarioSeconds, config }) {
  return scenarioSeconds ?? fittingSeconds(request, config.max_job_seconds);
}

/** Return the problem as scenarios begin with it: they plan the whole day, from nothing. */
function baseOf(state) {
  const base = fromNothing(state.request);
  return { ...base, options: { ...base.options, time_limit: secondsEach(state) } };
}

/** Return fleets worth a comparison with a request's own. */
function suggestedFleets(request) {
  const fleets = { [t('scenario.asItIs')]: request.fleet };
  if (request.fleet.some((type) => droneCount(type)))
    fleets[t('scenario.withoutDrones')] = withoutDrones(request).fleet;
  if (request.fleet.length > 1) {
    const total = request.fleet.reduce((sum, { count }) => sum + count, 0);
    request.fleet.forEach((type) => {
      fleets[t('scenario.only', { id: type.id })] = [{ ...type, count: total }];
    });
  }
  return fleets;
}

function typeInWords(type) {
  const vehicles = `${type.count} ${type.id}`;
  const drones = droneCount(type);
  return drones ? t('scenario.withDrones', { vehicles, count: drones }) : vehicles;
}

function Compare() {
  const request = useStore((state) => state.request);
  const kept = useStore((state) => state.keptFleets);
  const [left, setLeft] = useState([]);
  const [name, setName] = useState('');
  const fleets = { ...suggestedFleets(request), ...kept };
  const chosen = Object.entries(fleets).filter(([fleet]) => !left.includes(fleet));
  const toggle = (fleet) =>
    setLeft(left.includes(fleet) ? left.filter((other) => other !== fleet) : [...left, fleet]);
  const keep = () => {
    store.set({ keptFleets: { ...kept, [name.trim()]: request.fleet } });
    setName('');
  };
  return html`<section class="section"><h3>${t('scenario.compare')}</h3>
    ${Object.entries(fleets).map(([fleet, types]) => html`<label key=${fleet}><input type="checkbox"
      checked=${!left.includes(fleet)}
        onChange=${() => toggle(fleet)} /> <strong>${fleet}:</strong>${' '}
      <span class="help">${types.map(typeInWords).join(', ')}</span></label>`)}
    <div class="buttons"><input type="text" value=${name} placeholder=${t('scenario.fleetName')}
        aria-label=${t('scenario.keepBy')} onInput=${(event) => setName(event.target.value)} />
      <button type="button" disabled=${!name.trim()}
        onClick=${keep}>${t('scenario.keep')}</button></div>
    <div class="buttons"><button type="button" class="primary" disabled=${chosen.length < 1}
      onClick=${() =>
        startScenario('compare', {
          base: baseOf(store.get()),
          fleets: Object.fromEntries(chosen),
        })}>${t('scenario.compareCount', { count: chosen.length })}</button></div>
  </section>`;
}

function Sweep() {
  const request = useStore((state) => state.request);
  const schemas = useStore((state) => state.schemas);
  const chosen = useStore((state) => state.sweepAxes);
  const axes = useMemo(() => chosen ?? axesAround(request.fleet), [chosen, request.fleet]);
  const fields = useMemo(() => variableFields(schemas, request.fleet), [schemas, request.fleet]);
  const set = (index, patch) =>
    store.set({
      sweepAxes: axes.map((axis, other) => (other === index ? { ...axis, ...patch } : axis)),
    });
  const choose = (index, path) => {
    const field = fields.find((one) => one.path === path);
    set(index, { path, text: field ? valuesAround(request.fleet, field) : '' });
  };
  const unit = (axis) => fields.find(({ path }) => path === axis.path)?.unit ?? '';
  const used = axes.filter(({ path }) => path);
  const values = used.map((axis) => readValues(axis.text, unit(axis)));
  const ready =
    used.length > 0 &&
    !values.includes(null) &&
    new Set(used.map(({ path }) => path)).size === used.length;
  const size = ready ? values.reduce((product, { length }) => product * length, 1) : 0;
  const start = () =>
    startScenario('sweep', {
      base: baseOf(store.get()),
      grid: Object.fromEntries(used.map(({ path }, index) => [path, values[index]])),
    });
  return html`<section class="section"><h3>${t('scenario.sweep')}</h3>
    ${axes.map((axis, index) => html`<div class="sweep-axis" key=${index}>
      <select aria-label=${t('scenario.axis', { number: index + 1 })} value=${axis.path}
          onChange=${(event) => choose(index, event.target.value)}>
        ${index > 0 && html`<option value="">${t('scenario.nothing')}</option>`}
        ${fields.map(({ path, label }) => html`<option key=${path}
          value=${path}>${label}</option>`)}</select>
      ${axis.path && html`<input type="text" value=${axis.text}
        aria-label=${t('scenario.values', { number: index + 1 })}
        aria-invalid=${readValues(axis.text, unit(axis)) === null}
        placeholder=${t('form.such', {
          example: unit(axis) === 's' ? '4:00, 5:30' : '100, 150' })}
        onInput=${(event) => set(index, { text: event.target.value })} />
        <span class="unit">${unit(axis) === 's' ? 'h:mm' : unit(axis)}</span>`}</div>`)}
    <p class="help">${t('scenario.alike')}</p>
    <div class="buttons"><button type="button" class="primary" disabled=${!ready} onClick=${start}>
      ${t('scenario.sweepCount', { count: size })}</button></div></section>`;
}

function Running({ scenario }) {
  const over = ['done', 'failed', 'cancelled'].includes(scenario.state);
  return html`<section class="section" aria-live="polite"><div class="buttons"><span
    id="scenario-state">
      ${t(`scenario.kind.${scenario.kind}`)}: ${t(`scenario.state.${scenario.state}`)}</span>
    ${!over && html`<span class="progress" role="progressbar" aria-label=${t('scenario.progress')}
      aria-valuemin="0" aria-valuemax="100" aria-valuenow=${Math.round(scenario.progress * 100)}>
      <span style=${{ width: `${scenario.progress * 100}%` }}></span></span>
      <button type="button" onClick=${stopScenario}>${t('scenario.stop')}</button>`}</div>
    ${scenario.error && html`<p class="error">${scenario.error}</p>`}</section>`;
}

/** Return what came of a fleet with its costs without the penalty, which stands apart. */
function withTrueCost({ base, fleets }, [fleet, found]) {
  if (!found.cost || !found.plan) return [fleet, { ...found, penalty: 0 }];
  const entry = { request: { ...base, fleet: fleets[fleet] }, plan: found.plan };
  return [fleet, { ...found, cost: trueTerms(entry), penalty: penaltyOf(entry) }];
}

function CompareResult({ scenario: { body, result } }) {
  const entries = Object.entries(result.fleets).map((entry) => withTrueCost(body, entry));
  const least = Math.min(...entries.flatMap(([, { cost }]) => (cost ? [cost.total] : [])));
  const line = (name, read) => html`<tr key=${name}><th scope="row">${name}</th>
    ${entries.map(([fleet, found]) => html`<td key=${fleet}
      class="number">${found.cost ? read(found) : ''}</td>`)}</tr>`;
  return html`<section class="section wide"><h3>${t('scenario.sideBySide')}</h3>
    <table id="compare-table">
    <thead><tr><th scope="col"></th>${entries.map(([fleet]) => html`<th scope="col" class="number"
      key=${fleet}>${fleet}</th>`)}</tr></thead>
    <tbody>
      <tr><th scope="row"><strong>${t('scenario.total')}</strong></th>${entries.map(
        ([fleet, { cost, error }]) => html`<td
        key=${fleet} class="number">${cost
            ? html`<strong class=${cost.total === least ? 'delta-good' : ''}>
        ${money(cost.total)}</strong>`
            : (error ?? t('scenario.noPlan'))
        }</td>`,
      )}</tr>
      ${costTerms(...entries.flatMap(([, { cost }]) => (cost ? [cost] : []))).map(([term, name]) =>
        line(name, ({ cost }) => money(cost[term] ?? 0)),
      )}
      ${entries.some(([, { penalty }]) => penalty > 0)
        && line(t('whatIf.penalty'), ({ penalty }) => money(penalty))}
      ${line(t('scenario.loadMean'), ({ load_rate: rate }) => percent(rate?.mean))}
      ${line(t('scenario.loadLeast'), ({ load_rate: rate }) => percent(rate?.min))}
      ${line(t('scenario.workMean'), ({ working_rate: rate }) => percent(rate?.mean))}
      ${line(t('measure.vehicles'), ({ vehicles }) => number(vehicles, 0))}
      ${line(t('measure.trips'), ({ trips }) => number(trips, 0))}
      ${line(t('scenario.unassigned'), ({ unassigned }) => number(unassigned, 0))}
      <tr><th scope="row"></th>${entries.map(
        ([fleet, { plan }]) => html`<td key=${fleet} class="number">
        ${plan && html`<button type="button" aria-label=${t('scenario.showOf', { fleet })}
          onClick=${() =>
            showScenarioPlan({ ...body.base, fleet: body.fleets[fleet] }, plan, fleet)}>
            ${t('scenario.show')}</button>`}
      </td>`,
      )}</tr>
    </tbody></table></section>`;
}

function SweepResult({ scenario: { body, result } }) {
  const schemas = useStore((state) => state.schemas);
  const fields = variableFields(schemas, body.base.fleet);
  const field = (axis) =>
    fields.find(({ path }) => path === axis?.path) ?? { label: axis?.path ?? '', unit: '' };
  const [down, across] = result.axes.map(field);
  const show = (found, value) =>
    value === null
      ? t('scenario.cost')
      : found?.unit === 's'
        ? `${hours(value)} h`
        : `${number(value)} ${found?.unit ?? ''}`;
  const table = heatTable(result);
  return html`<section class="section wide"><h3>${across
    ? t('scenario.costByBoth', {
      down: withinSentence(down.label),
      across: withinSentence(across.label),
    })
    : t('scenario.costBy', { down: withinSentence(down.label) })}</h3>
    <table class="heat" id="heat-map"><thead><tr><th
      scope="col">${down.label}${across && ` \\ ${across.label}`}</th>
      ${table.columns.map((value) => html`<th scope="col"
        key=${value}>${show(across, value)}</th>`)}</tr></thead>
    <tbody>${table.rows.map(
      (value, row) => html`<tr key=${value}><th scope="row">${show(down, value)}</th>
      ${table.cells[row].map(
        (cell, column) => html`<${HeatCell} key=${column} cell=${cell} table=${table}
        body=${body} axes=${result.axes} />`,
      )}</tr>`,
    )}</tbody></table>
    <p class="help">${t('scenario.legend')}${result.cells.some((cell) => cell?.unassigned > 0)
      && !statesPenalty(body.base) && ` ${t('scenario.penaltyWithin')}`}</p></section>`;
}

function HeatCell({ cell, table, body, axes }) {
  if (!cell || cell.cost === null)
    return html`<td title=${cell?.error}>${cell?.error ? t('scenario.failed') : ''}</td>`;
  const spread = table.most - table.least;
  const colour = heatColour(spread > 0 ? (cell.cost - table.least) / spread : 0);
  const open = () =>
    showScenarioJob(
      cell.job,
      axes.reduce(
        (request, { path }, index) => writeAt(request, path, cell.values[index]),
        body.base));
  const out = cell.unassigned > 0 ? html`<br /><small>${t('scenario.out', {
    count: cell.unassigned,
  })}</small>` : '';
  return html`<td class=${cell.cost === table.least ? 'least' : ''}
      style=${{ background: colour.background, color: colour.text }}>
    <button type="button" class="link" style=${{ color: colour.text }} onClick=${open}
      title=${[
        t('scenario.loadRate', { rate: percent(cell.load_rate?.mean) }),
        t('scenario.vehicles', { count: cell.vehicles }),
        t('routes.trips', { count: cell.trips }),
      ].join(', ')}>
      ${money(cell.cost)}</button>${out}</td>`;
}
