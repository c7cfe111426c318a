/** The buttons of the drawing tools, and what the chosen one draws with. */

import { shownPlan } from '../actions.js';
import { clock, parseClock, parseNumber } from '../core/format.js';
import { html, useState } from '../libraries.js';
import { store, useStore } from '../store.js';
import { Icon } from '../views/icon.js';
import { TOOLS } from './tools.js';
import { t } from '../texts.js';

/** Take up a tool, or put it down. */
export function takeTool(tool) {
  store.set((state) => ({ tool: state.tool === tool ? null : tool }));
}

/** Buttons over the map. */
export function DrawBar() {
  const tool = useStore((state) => state.tool);
  const replans = useStore((state) => Boolean(state.request.replan));
  const [wanted, setWanted] = useState(false);
  const open = wanted || tool !== null;
  const toggle = () => {
    if (open) store.set({ tool: null });
    setWanted(!open);
  };
  const isPlanned = useStore((state) => shownPlan(state) !== null);
  const isChosen = useStore(({ selection }) => Boolean(selection?.startsWith('c:')));
  const isOrdering = useStore((state) => ['customers', 'replan'].includes(state.tab));
  const hidden = { pin: !replans, fit: !isPlanned, place: !isChosen, order: !isOrdering };
  const tools = TOOLS.filter((key) => !hidden[key]);
  return html`<div class="draw-bar">
    <button type="button" aria-expanded=${open} onClick=${toggle} title=${t('draw.title')}
      aria-label=${t('draw.title')}><${Icon} name="pencil" /></button>
    ${open && html`<div class="draw-tools" role="group" aria-label=${t('draw.tools')}>
      ${tools.map((key) => html`<button type="button" key=${key}
        aria-pressed=${tool === key} onClick=${() => takeTool(key)}>
          ${t(`tool.name.${key}`)}</button>`)}
      ${tool && html`<div class="draw-options"><p>${t(`tool.hint.${tool}`)}</p>
        <${Brush} tool=${tool} /></div>`}
    </div>`}
  </div>`;
}

function Brush({ tool }) {
  if (tool === 'customer' || tool === 'fit') {
    return html`<${BrushField} name="demand" label=${t('about.demand')}
        show=${(values) => values.join(', ')} read=${readAmounts} />
      <${BrushField} name="service_duration" label=${t('draw.service')} show=${String}
        read=${parseNumber} />
      <${ServedBy} />`;
  }
  if (tool !== 'window' && tool !== 'windowArea') return null;
  return html`<${BrushField} name="earliest" label=${t('draw.opens')} show=${clock}
      read=${parseClock} />
    <${BrushField} name="latest" label=${t('draw.closes')} show=${clock}
      read=${parseClock} />`;
}

function readAmounts(text) {
  const values = text.split(/[,;]/).map(parseNumber);
  return values.includes(null) ? null : values;
}

function BrushField({ name, label, show, read }) {
  const brush = useStore((state) => state.brush);
  const change = (event) => {
    const value = read(event.target.value);
    if (value === null) event.target.value = show(brush[name]);
    else store.set({ brush: { ...brush, [name]: value } });
  };
  return html`<label>${label} <input type="text" size="7" value=${show(brush[name])}
    onChange=${change} /></label>`;
}

function ServedBy() {
  const brush = useStore((state) => state.brush);
  return html`<label>${t('draw.servedBy')} <select value=${brush.served_by} onChange=${(event) =>
    store.set({ brush: { ...brush, served_by: event.target.value } })}>
    ${['either', 'truck', 'drone'].map((value) => html`<option key=${value}
      value=${value}>${t(`servedBy.${value}`)}</option>`)}
  </select></label>`;
}
