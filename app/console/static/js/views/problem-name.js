/** What the open problem is called, and whether it is saved. */

import { isUnsaved } from '../core/drafts.js';
import { askName, save } from '../keeping/kept.js';
import { html, useEffect } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';

/** The name, which can be changed, and the button that saves. */
export function ProblemName() {
  const name = useStore((state) => state.name);
  const unsaved = useStore((state) => !state.live && isUnsaved(state));
  const isKept = useStore((state) => state.home !== null);
  const mark = unsaved ? '\u2022 ' : '';
  useEffect(() => {
    document.title = name ? `${mark}${name} \u2013 Tandem` : 'Tandem';
  }, [name, mark]);
  return html`<div class="problem-name">
    <button type="button" class="quiet" id="problem-name" title=${t('header.rename', { name })}
      onClick=${askName}><span class="name">${name}</span>${unsaved &&
        html`<span class="unsaved" role="img" aria-label=${t('header.notSaved')}
          title=${t('header.notSaved')}>\u2022</span>`
      }</button>
    <button type="button" id="save" onClick=${save} disabled=${isKept && !unsaved}>
      ${t('kept.save')}</button>
  </div>`;
}
