/** That a shared plan is looked at, or that the browser doesn't keep what is done. */

import { html } from '../libraries.js';
import { askName } from '../keeping/kept.js';
import { store, useStore } from '../store.js';
import { t } from '../texts.js';

/** Tell whether there is something to be told. */
export const isToBeTold = ({ unkept, viewing }) => Boolean(unkept || viewing);

/** The notice, if there is something to be told. */
export function KeepingNotice() {
  const unkept = useStore((state) => state.unkept);
  const viewing = useStore((state) => state.viewing);
  const isDay = useStore((state) => state.isDay);
  if (viewing) {
    return html`<div class="notice calm" role="status"><div><strong>${
      isDay ? t('kept.sharedDay') : t('kept.shared')}</strong> ${t('kept.sharedHelp')}</div>
      <button type="button" onClick=${askName}>${t('kept.saveAs')}</button></div>`;
  }
  if (!unkept) return null;
  return html`<div class="notice" role="alert"><div>${unkept}</div>
    <button type="button" onClick=${askName}>${t('kept.save')}</button>
    <button type="button" class="quiet"
      onClick=${() => store.set({ unkept: null })}>${t('app.close')}</button></div>`;
}
