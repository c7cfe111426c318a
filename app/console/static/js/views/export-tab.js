/** Take the plan away: files, sheets for drivers, pictures. */

import { indexOf, settledOf, showFailure, shownPlan } from '../actions.js';
import { postPicture } from '../api.js';
import { linksByVehicle } from '../core/dispatches.js';
import { geoJson, gpx, stopsCsv } from '../core/exports.js';
import { asStated } from '../core/times.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { FlightFiles } from './flight-files.js';
import { Badge } from './parts.js';
import { printSheets } from './driver-sheets.js';
import { save } from './saving.js';
import { t } from '../texts.js';

const PNG_SCALE = 2;

/** The tab. */
export function ExportTab() {
  const request = useStore((state) => state.request);
  const schemas = useStore((state) => state.schemas);
  const stated = useStore((state) => state.stated);
  const entry = useStore(shownPlan);
  const links = linksByVehicle(useStore((state) => state.dispatch));
  const index = indexOf(entry);
  const problem = html`<section class="section"><h3>${t('take.problem')}</h3><div class="buttons">
    <button type="button" onClick=${() =>
      saveJson('problem.json', asStated(schemas, request, stated))}>
      ${t('take.problemJson')}</button></div></section>`;
  if (!index) return html`${problem}<p class="empty">${t('timeline.nothing')}</p>`;
  const parts = settledOf(entry, request);
  const isGeographic = entry.request.coordinate_system === 'geographic';
  const print = (vehicles) => printSheets(vehicles, parts, isGeographic, links);
  return html`${problem}
    <section class="section"><h3>${t('take.plan')}</h3><div class="buttons">
      <button type="button" onClick=${() => saveJson('plan.json', entry.plan)}>
        ${t('take.planJson')}</button>
      <button type="button" onClick=${() => save('stops.csv', 'text/csv', stopsCsv(index))}>
        ${t('take.stops')}</button>
      <button type="button" onClick=${() =>
        save(
          'plan.geojson',
          'application/geo+json',
          JSON.stringify(geoJson(index)),
        )}>GeoJSON</button></div></section>
    <section class="section"><h3>${t('take.picture')}</h3><div class="buttons">
      <button type="button" onClick=${() => savePicture(entry, false)}>
        SVG</button>
      <button type="button" onClick=${() => savePicture(entry, true)}>PNG
        </button></div></section>
    <${FlightFiles} entry=${entry} />
    <section class="section"><h3>${t('take.drivers')}</h3>
      <div class="buttons">
        <button type="button" onClick=${() => print(index.vehicles)}>
          ${t('take.printAll')}</button></div>
      ${!isGeographic && html`<p class="help">${t('take.planar')}</p>`}
      <table><tbody>${index.vehicles.map((vehicle) => html`<tr key=${vehicle.key}>
        <th scope="row"><${Badge} vehicle=${vehicle} /> ${nameOfVehicle(vehicle.name)}</th>
        <td><div class="buttons">
          <button type="button" onClick=${() => print([vehicle])}
            aria-label=${t('take.printOf', { vehicle: nameOfVehicle(vehicle.name) })}>${
              t('take.print')}</button>
          <button type="button" disabled=${!isGeographic} 
            aria-label=${t('take.gpxOf', { vehicle: nameOfVehicle(vehicle.name) })}
            onClick=${() =>
              save(`${vehicle.name}.gpx`, 'application/gpx+xml', gpx(vehicle))}>GPX</button>
        </div></td></tr>`)}</tbody></table></section>`;
}

function saveJson(name, value) {
  save(name, 'application/json', `${JSON.stringify(value, null, 2)}\n`);
}

/** Save a picture that the service draws, as PNG or as it is: SVG. */
async function savePicture({ request: problem, plan }, isPng) {
  try {
    const drawn = await postPicture({ problem, plan });
    save(isPng ? 'plan.png' : 'plan.svg', ...(isPng ? await pngOf(drawn) : [drawn.type, drawn]));
  } catch (error) {
    showFailure(error);
  }
}

/** Return the type and content of a picture as PNG. */
async function pngOf(drawn) {
  const image = new Image();
  image.src = URL.createObjectURL(drawn);
  await image.decode();
  URL.revokeObjectURL(image.src);
  const { naturalWidth: width, naturalHeight: height } = image;
  const canvas = Object.assign(document.createElement('canvas'), {
    width: width * PNG_SCALE, height: height * PNG_SCALE,
  });
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return ['image/png', await new Promise((resolve) => canvas.toBlob(resolve))];
}
