/** What is set once: language, light or dark, keys, and the developer's view. */

import { html } from '../libraries.js';
import { store, useStore } from '../store.js';
import { t } from '../texts.js';
import { Icon } from './icon.js';
import { LanguageChoice } from './language-choice.js';
import { Menu } from './menu.js';

/** The menu of settings. */
export function Settings() {
  const dark = useStore((state) => state.dark);
  return html`<${Menu} id="settings" label=${html`<${Icon} name="settings" size=${20} />
      <span>${t('room.settings')}</span>`}>
    <label>${t('header.language')} <${LanguageChoice} /></label>
    <button type="button" onClick=${switchTheme}><${Icon} name=${dark ? 'sun' : 'moon'} />
      ${dark ? t('header.light') : t('header.dark')}</button>
    <button type="button" popovertarget="settings" popovertargetaction="hide"
      onClick=${() => store.set({ dialog: { name: 'keys' } })}><${Icon} name="keyboard" />
      ${t('header.keys')}</button>
    <label class="check"><input type="checkbox" checked=${isDeveloper()}
      onChange=${(event) => showPaths(event.target.checked)} /> ${t('header.developer')}</label>
    <a href="docs">API</a>
  </${Menu}>`;
}

/** Change between light and dark, and remember it. */
export function switchTheme() {
  const theme = store.get().dark ? 'light' : 'dark';
  localStorage.setItem('tandem-theme', theme);
  document.documentElement.dataset.theme = theme;
}

const isDeveloper = () => 'developer' in document.documentElement.dataset;

/** Show where fields are in the API, or not, and remember it (see `theme.js`). */
function showPaths(isShown) {
  document.documentElement.toggleAttribute('data-developer', isShown);
  localStorage.setItem('tandem-developer', isShown ? 'on' : 'off');
}
