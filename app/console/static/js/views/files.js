/** Opens files: problems as JSON, sheets of customers in any format that the service reads. */

import { edit, openRequest, openTab, showFailure } from '../actions.js';
import { ApiError } from '../api.js';
import { dayOf } from '../core/day.js';
import { withoutEnding } from '../core/format.js';
import { labelOf } from '../core/schema.js';
import { pastedSheet } from '../core/pasted.js';
import { forecastOf, withWind } from '../core/wind.js';
import { addZones, zonesOf, zonesOfKml } from '../core/zones.js';
import { plan } from '../planning.js';
import { store } from '../store.js';
import { t } from '../texts.js';

/** Open a file that the user chose or dropped. */
export async function openFile(file) {
  try {
    const ending = file.name.slice(file.name.lastIndexOf('.') + 1).toLowerCase();
    if (ending === 'kml') await openKml(file);
    else if (ending === 'json' || ending === 'geojson') await openJson(file);
    else await openSheet(file);
  } catch (error) {
    showFailure(error);
  }
}

/** Open files that are dropped onto the page. */
export function listenToDrops() {
  const mark = (isOver) => document.body.classList.toggle('drop', isOver);
  document.addEventListener('dragover', (event) => {
    event.preventDefault();
    mark(true);
  });
  document.addEventListener('dragleave', () => mark(false));
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    mark(false);
    const [file] = event.dataTransfer.files;
    if (file) openFile(file);
  });
}

function inField(target) {
  return target instanceof Element && target.closest('input, textarea, select') !== null;
}

/** Import what is pasted outside of fields, if it comes from a sheet. */
export function listenToPastes() {
  document.addEventListener('paste', (event) => {
    const { dialog, importing, keeping } = store.get();
    if (dialog || importing || keeping || inField(event.target)) return;
    const text = pastedSheet(event.clipboardData.getData('text/plain'));
    if (text === null) return;
    event.preventDefault();
    openFile(new File([text], t('files.pasted')));
  });
}

/** Add the zones of a file to the problem that is open. */
function openZones(file, zones) {
  if (store.get().request.coordinate_system !== 'geographic') {
    const title = t('files.zonesOnPlane', { file: file.name });
    throw new ApiError(0, title, t('files.zonesOnPlaneHelp'));
  }
  edit((request) => addZones(request, zones));
}

/** Take the wind of the problem that is open from a forecast. */
function openForecast(file, wind) {
  if (!dayOf(store.get().request)) {
    throw new ApiError(0, t('files.noDay', { file: file.name }), t('files.noDayHelp'));
  }
  edit((request) => withWind(request, wind));
  openTab('fleet');
}

// Few import: what does it is loaded for who does.
async function openSheet(file) {
  const { beginImport } = await import('../importing.js');
  await beginImport(file);
}

async function openKml(file) {
  const zones = zonesOfKml(await file.text());
  if (zones) openZones(file, zones);
  else await openSheet(file);
}

async function openJson(file) {
  let content;
  try {
    content = JSON.parse((await file.text()).replace(/^\uFEFF/, ''));
  } catch (error) {
    throw new ApiError(0, t('files.noJson', { file: file.name }), `${error.message}.`);
  }
  const zones = zonesOf(content);
  if (zones) {
    openZones(file, zones);
    return;
  }
  const forecast = forecastOf(content);
  if (forecast) {
    openForecast(file, forecast);
    return;
  }
  if (content?.type === 'FeatureCollection') {
    await openSheet(file);
    return;
  }
  const request = content?.problem ?? content;
  const lacking = ['depots', 'customers', 'fleet'].filter(
    (name) => !Array.isArray(request?.[name]));
  if (lacking.length) {
    const names = lacking.map(labelOf).join(', ');
    throw new ApiError(0, t('files.noProblem', { file: file.name }), t('files.lacks', { names }));
  }
  openRequest(request, { name: withoutEnding(file.name), isSafe: true });
  await plan();
}
