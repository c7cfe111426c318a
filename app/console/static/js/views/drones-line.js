/** What the plan's drones do, in a sentence above the open tab. */

import { shownPlan } from '../actions.js';
import { flownIn, savedShare } from '../core/drones-worth.js';
import { askDrones, toldOf } from '../explaining.js';
import { html, useEffect } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';
import { IdleDrones } from './idle-drones.js';

/** The sentence, for plans with drones. */
export function DronesLine() {
  const entry = useStore(shownPlan);
  const answer = toldOf(useStore((state) => state.why), entry, null);
  const idle = useStore(({ run }) => run.state === 'idle');
  const isFirst = useStore(isFirstView);
  const flown = entry && flownIn(entry);
  // What drones of hubs save isn't known: the service compares with a plan that has them, too.
  const isAskable = Boolean(flown?.drones && !flown.ofHubs);
  const isToBeAsked = Boolean(isFirst && idle && isAskable && !answer);
  useEffect(() => {
    if (isToBeAsked) askDrones(entry, true);
  }, [isToBeAsked, entry]);
  if (!flown?.present) return null;
  const isAsking = answer?.state === 'asking';
  return html`<div class="drones-line">${flown.drones > 0 && html`<p role="status">${
    sentence(entry, flown, isAskable ? answer?.told?.drones : null)}${isAskable
      && !answer?.told && html` <button type="button"
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
