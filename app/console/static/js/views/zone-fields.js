/** What is stated of published zones: leave to fly in them, and what tells which of them block. */

import { edit } from '../actions.js';
import { setIn } from '../core/paths.js';
import { isAboveSea, titleOfZone } from '../core/zone-words.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { Field } from './form.js';
import { t } from '../texts.js';

/** Whether there is leave to fly in a zone. */
export function Leave({ request, zone }) {
  const { cleared = [] } = request.airspace;
  const others = cleared.filter((other) => other !== zone.identifier);
  const change = ({ target }) => edit(setIn(request, ['airspace', 'cleared'],
    target.checked ? [...others, zone.identifier] : others));
  return html`<label class="check"><input type="checkbox" onChange=${change}
    checked=${others.length < cleared.length} /> ${t('fleet.leave', {
      zone: titleOfZone(zone) })}</label>`;
}

/** Fields of the airspace, by their names. */
export function AirspaceFields({ request, names }) {
  const { properties } = useStore((state) => state.schemas).AirspaceInput;
  return names.map((name) => html`<${Field} key=${name} name=${name} schema=${properties[name]}
    keys=${['airspace', name]} request=${request} owner="AirspaceInput" onChange=${edit} />`);
}

/** What there is to state of one zone. */
export function ZoneFields({ request, zone }) {
  const names = [
    ...(zone.restriction === 'CONDITIONAL' ? ['conditional'] : []),
    ...(isAboveSea(zone) ? ['ground'] : [])];
  return html`<div class="fields">${zone.identifier && html`<${Leave} request=${request}
      zone=${zone} />`}<${AirspaceFields} request=${request} names=${names} /></div>`;
}
