/** What the legs of a plan are made of, in words. */

import { t } from '../texts.js';
import { choiceOf } from './schema.js';

/** Return a line for each profile that trucks drive by, from the reply's `legs`. */
export function legsInWords(legs) {
  return (legs ?? []).filter(({ by }) => by !== 'flight').map(legInWords);
}

function legInWords({ profile, by, engine, estimated, detour, avoid }) {
  if (by === 'matrix') return t('legs.matrix', { profile });
  if (by === 'straight') return t('legs.straight', { profile });
  if (by !== 'roads') return t('legs.crow', { profile });
  const without = (avoid ?? []).map((each) => choiceOf(each)).join(', ');
  const roads = t('legs.roads', { profile, engine })
    + (without && ` ${t('legs.without', { without })}`);
  return estimated ? `${roads}, ${t('legs.estimated', { count: estimated, detour })}` : roads;
}
