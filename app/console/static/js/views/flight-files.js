/** A plan's flights as files for flight controllers. */

import { postFlights } from '../api.js';
import { showFailure } from '../actions.js';
import { flightCount } from '../core/drones.js';
import { saidOf } from '../core/said.js';
import { html, useEffect, useState } from '../libraries.js';
import { save } from './saving.js';
import { t } from '../texts.js';

/** Formats by what they are called. */
const FORMATS = {
  'qgc-plan': 'QGroundControl (.plan)', 'qgc-wpl': 'MAVLink (QGC WPL 110)', kml: 'KML',
  'dji-wpml': 'DJI WPML (.kmz)', geojson: 'GeoJSON',
};

/** What DJI's aircraft do where the remote control is lost, as `wpml` of a request says it. */
const LOST = {
  goContinue: {},
  ...Object.fromEntries(['hover', 'landing', 'goBack'].map((action) => [
    action,
    { exit_on_rc_lost: 'executeLostAction', rc_lost_action: action }])),
};

/** The choice of a format, and the button that saves; nothing where no drone flies. */
export function FlightFiles({ entry }) {
  const [format, setFormat] = useState('qgc-plan');
  const [per, setPer] = useState('sortie');
  const [lost, setLost] = useState('goContinue');
  const [refused, setRefused] = useState([]);
  const [isAsking, setAsking] = useState(false);
  useEffect(() => setRefused([]), [entry.plan, format]);
  if (!flightCount(entry)) return null;
  const isGeographic = entry.request.coordinate_system === 'geographic';
  const write = async () => {
    setAsking(true);
    setRefused([]);
    try {
      const { name, content } = await postFlights({
        problem: entry.request,
        plan: entry.plan,
        format,
        per,
        ...(format === 'dji-wpml' && { wpml: LOST[lost] }),
      });
      save(name, content.type, content);
    } catch (error) {
      if (error.errors?.length) setRefused(error.errors.map(saidOf));
      else showFailure(error);
    }
    setAsking(false);
  };
  return html`<section class="section" id="flight-files"><h3>${t('take.flights')}</h3>
    <p class="help">${isGeographic ? t('take.facts') : t('take.flightsPlanar')}</p>
    <div class="buttons">
      <label>${t('take.format')} <select value=${format} disabled=${!isGeographic}
        onChange=${(event) => setFormat(event.target.value)}>${Object.entries(FORMATS).map(
          ([value, label]) => html`<option key=${value} value=${value}
            selected=${value === format}>${label}</option>`,
        )}</select></label>
      <label>${t('take.files')} <select value=${per} disabled=${!isGeographic}
        onChange=${(event) => setPer(event.target.value)}>${['sortie', 'vehicle'].map(
          (value) => html`<option key=${value} value=${value} selected=${value === per}>${
            t(`take.per.${value}`)}</option>`,
        )}</select></label>
      ${format === 'dji-wpml' && html`<label>${t('take.lost.label')} <select value=${lost}
        onChange=${(event) => setLost(event.target.value)}>${Object.keys(LOST).map(
          (value) => html`<option key=${value} value=${value} selected=${value === lost}>${
            t(`take.lost.${value}`)}</option>`,
        )}</select></label>`}
      <button type="button" disabled=${!isGeographic || isAsking} onClick=${write}>
        ${t('take.saveFlights')}</button></div>
    ${refused.length > 0 && html`<div role="alert">${refused.map(
      (text) => html`<p class="late-text">${text}</p>`,
    )}</div>`}
  </section>`;
}
