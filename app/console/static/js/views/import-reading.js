/** How a file as a whole is read: sheet, letters, decimals, dates, rows alike. */

import { change } from '../importing.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';

const ENCODINGS = ['utf-8', 'cp1252', 'cp1250', 'iso8859_2', 'cp1251', 'cp1253', 'cp1254', 'cp850'];

/** The choices, folded away as they are seldom wrong. */
export function Reading({ importing: { reply, mapping } }) {
  const choose = (patch) => change({ mapping: { ...mapping, ...patch } });
  const dayFirst = mapping.day_first == null ? '' : String(mapping.day_first);
  const encodings = [...new Set([reply.encoding, ...ENCODINGS])].map((name) => [name, name]);
  return html`<details><summary>${t('import.reading')}</summary><div class="import-fields">
    ${reply.sheets.length > 1 && html`<${Choice} label=${t('import.sheet')} value=${reply.sheet}
        options=${reply.sheets.map(({ name }) => [name, name])}
        onChoose=${(sheet) => choose({ sheet, columns: [] })} />`}
    ${reply.encoding &&
      html`<${Choice} label=${t('import.letters')} value=${reply.encoding} options=${encodings}
        onChoose=${(encoding) => choose({ encoding })} />`
    }
    <${Choice} label=${t('import.decimals')} value=${mapping.decimals ?? ''}
      options=${[
        ['', t('import.found')], [',', t('import.comma')], ['.', t('import.point')],
      ]} onChoose=${(decimals) => choose({ decimals: decimals || null })} />
    <${Choice} label=${t('import.dates')} value=${dayFirst}
      options=${[
        ['', t('import.found')], ['true', t('import.dayFirst')], ['false', t('import.monthFirst')],
      ]}
      onChoose=${(first) => choose({ day_first: first === '' ? null : first === 'true' })} />
    <${Choice} label=${t('import.samePlace')} value=${mapping.same_place ?? 'together'}
      options=${[['together', t('import.together')], ['apart', t('import.apart')]]}
      onChoose=${(same) => choose({ same_place: same })} />
    </div></details>`;
}

function Choice({ label, value, options, onChoose }) {
  return html`<label>${label}<select value=${value}
    onChange=${(event) => onChoose(event.target.value)}>
    ${options.map(([name, title]) => html`<option key=${name} value=${name}>${title}</option>`)}
    </select></label>`;
}
