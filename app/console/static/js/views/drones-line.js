/** What the plan's drones do, in a sentence above the open tab. */

import { shownPlan } from '../actions.js';
import { flownIn, savedShare } from '../core/drones-worth.js';
import { askDrones, toldOf } from '../explaining.js';
import { html, useEffect } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';
import { IdleDrones } from './idle-drones.js';

/** The sentence, for plans whose vehicles carry drones. */
export function DronesLine() {
  const entry = useStore(shownPlan);
  const answer = toldOf(useStore((state) => state.why), entry, null);
  const idle = useStore(({ run }) => run.state === 'idle');
  const isFirst = useStore(isFirstView);
  const flown = entry && flownIn(entry);
  const isToBeAsked = Boolean(isFirst && idle && flown?.drones && !answer);
  useEffect(() => {
    if (isToBeAsked) askDrones(entry, true);
  }, [isToBeAsked, entry]);
  if (!flown?.carried) return null;
  const isAsking = answer?.state === 'asking';
  return html`<div class="drones-line">${flown.drones > 0 && html`<p role="status">${
    sentence(entry, flown, answer?.told?.drones)}${!answer?.told && html` <button type="button"
      class="link" disabled=${!idle || isAsking} onClick=${() => askDrones(entry)}>${
      isAsking ? t('dronesLine.searching') : t('dronesLine.ask')}</button>`}</p>`}
    <${IdleDrones} /></div>`;
}

/** Tell whether what is looked at is what a console shows first, as it came. */
function isFirstView(state) {
  const { examples, stated, request, saved } = state;
  const first = examples.find(({ isFirst }) => isFirst)?.request;
  return first === stated && request === saved?.request && shownPlan(state)?.request === request;
}

function sentence({ plan }, { drones, customers }, told) {
  const share = savedShare(told);
  const values = { count: drones, customers, all: plan.summary.customers };
  if (told && share !== null && share < 0.005) return t('dronesLine.saveNothing', values);
  if (share === null) return t('dronesLine.serve', values);
  return t('dronesLine.save', { ...values, share: Math.round(100 * share) });
}
