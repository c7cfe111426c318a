/** What the plan's drones save: in sum, and which sorties save nothing. */

import { indexOf, shownPlan } from '../actions.js';
import { money } from '../core/format.js';
import { trueCost } from '../core/terms.js';
import { countWorth, drones, savesNothing } from '../core/why.js';
import { askDrones, toldOf } from '../explaining.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { SelectButton } from './parts.js';
import { t } from '../texts.js';

/** The section, for plans with sorties. */
export function DronesWorth() {
  const entry = useStore(shownPlan);
  const answer = toldOf(useStore((state) => state.why), entry, null);
  if (!entry || !entry.plan.summary.sorties) return null;
  const isAsking = answer?.state === 'asking';
  return html`<section class="section" id="drones-worth">
    <h3>${t('worth.title')}</h3>
    <div class="buttons"><button type="button" disabled=${isAsking}
      onClick=${() => askDrones(entry)}>${t('worth.compare')}</button>
      <span role="status">${isAsking ? t('worth.searching') : ''}</span></div>
    ${answer?.told && html`<${Told} told=${answer.told.drones} entry=${entry} />`}</section>`;
}

function Told({ told, entry }) {
  const { useless, needed, untried } = countWorth(told.sorties);
  const total = told.sorties.length;
  return html`${drones(told, trueCost(entry)).map(
      (sentence) => html`<p key=${sentence}>${sentence}</p>`,
    )}
    <p>${useless ? t('worth.useless', { count: useless, total }) : t('worth.none')}
      ${needed > 0 && ` ${t('worth.needed', { count: needed })}`}
      ${untried > 0 && ` ${t('worth.untried', { count: untried })}`}</p>
    <ul>${told.sorties.filter(savesNothing).map(
      (sortie) => html`<${Useless} key=${`${sortie.vehicle}/${sortie.trip}/${sortie.sortie}`}
        sortie=${sortie} index=${indexOf(entry)} />`,
    )}</ul>`;
}

function Useless({ sortie, index }) {
  const vehicle = index.vehicles.find(({ name }) => name === sortie.vehicle);
  const key = `s:${vehicle.index}/${sortie.trip}/${sortie.sortie}`;
  const gain = -sortie.saves;
  return html`<li><${SelectButton} of=${key}>${t('worth.to', {
    vehicle: sortie.vehicle,
    names: sortie.customers.join(', '),
  })}</${SelectButton}>: ${
    gain < 0.005 ? t('worth.same') : t('worth.less', { sum: money(gain) })}</li>`;
}

/** Return whether a sortie of the plan that is looked at was found to save nothing. */
export function useSavesNothing({ trip, key }) {
  const entry = useStore(shownPlan);
  const told = toldOf(useStore((state) => state.why), entry, null)?.told;
  return Boolean(told?.drones.sorties.some((each) => each.vehicle === trip.vehicle.name
    && key === `s:${trip.vehicle.index}/${each.trip}/${each.sortie}` && savesNothing(each)));
}
