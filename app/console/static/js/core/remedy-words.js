/** Remedies of the service in the page's language. */

import { language, t } from '../texts.js';
import { timesInWords } from './format.js';
import { endWindows, partsOf } from './remedy-parts.js';

const NUMBER = '(?<number>[\\d.,]+)';
const TIME = '(?<time>[\\d.,]+ minutes?)';
const NAME = '(?<name>.+)';

/** How the service says remedies, the first that fits; what they are called in the texts. */
const SAID = [
  ['truck', 'fits if a truck may serve it'],
  ['drone', 'fits if a drone may serve it'],
  ['mayServe', `fits if ${NAME} may serve it`],
  ['vehicle', 'fits with one more vehicle'],
  ['hubBattery', `fits with one more battery at ${NAME}`],
  ['hubCharger', `fits with one more charger at ${NAME}`],
  ['trip', `fits if ${NAME} could make another trip`],
  ['price', `served if unassigned_cost were above ${NUMBER}`],
  ['itsPrice', `served if its unassigned_cost were above ${NUMBER}`],
  ['had', `fits if ${NAME} had (?<what>.+)`],
  ['capacity', 'fits if capacity were at least (?<number>.+)'],
  ['droneCapacity', 'fits if the drone capacity(?: of .+?)? were at least (?<number>.+)'],
  ['pickups', `fits if ${NAME} may pick up at any time`],
  ['endurance', `fits if endurance(?: of .+)? were ${TIME} longer`],
  ['range', `fits if max_range(?: of .+)? were ${NUMBER} km longer`],
  ['wind', 'fits without max_wind_kmh(?: of .+)?'],
  ['buffer', `lies far enough away with airspace.buffer ${NUMBER}`],
  ['battery', `fits with a battery(?: of .+)? of ${NUMBER} Wh more`],
  ['km', `fits if trips could be ${NUMBER} km longer`],
  ['lastWindow', `fits if its last window closed ${TIME} later`],
  ['itsWindow', `fits if its window closed ${TIME} later`],
  ['window', `fits if its window ${NUMBER} closed ${TIME} later`],
  ['windowOf', `fits if its window ${NUMBER} at ${NAME} closed ${TIME} later`],
  ['aboard', `fits if it could be aboard ${TIME} longer`],
  ['shift', `fits if ${NAME}'s shift ended ${TIME} later`],
  ['windowAt', `fits if its (?:last )?window at ${NAME} closed ${TIME} later`],
  ['between', `fits if max_time_between were at least ${TIME}`],
  ['betweenAndDetour',
    `fits if max_time_between were at least ${TIME} and max_detour were at least ${NUMBER}`],
  ['lag', `fits if max_lag of its orders were at least ${TIME}`],
  ['vehicleOf', `fits with one more vehicle of ${NAME}`],
  ['travels', `fits if ${NAME} could travel ${TIME} longer`],
  ['drivesDay', `fits if ${NAME}'s drivers could drive ${TIME} a day`],
  ['detour', `fits if max_detour were at least ${NUMBER}`],
  ['breakLoad', `fits if break ${NAME} allowed (?<number>.+) aboard`],
  ['breakLater', `fits if break ${NAME} could begin ${TIME} later`],
  ['noBreak', `fits without break ${NAME}`],
  ['drives', `fits if ${NAME}'s drivers could drive ${TIME} without a rest`],
  ['driverWorks', `fits if ${NAME}'s drivers could work ${TIME} without a rest`],
  ['restsInFlight', `fits if ${NAME}'s drivers may rest while drones fly`],
  ['unrelated', 'fits without its relations'],
  ['closing', `fits if ${NAME} closed ${TIME} later`],
  ['overtime', `fits if ${NAME} could work ${TIME} more overtime`],
  ['stop', `fits if ${NAME} could make 1 stop`],
  ['stops', `fits if ${NAME} could make ${NUMBER} stops`],
  ['sortie', `fits if ${NAME} could launch 1 sortie`],
  ['launch', `fits if drones may take off at ${NAME}`],
  ['carried', `fits if ${NAME} carried 1 battery(?: of .+)?`],
  ['works', `fits if ${NAME} could work ${TIME} longer`],
].map(([name, pattern]) => ({ name, pattern: new RegExp(`^${pattern}$`) }));

/** What begins each remedy, which stands once where several belong together. */
const BEGIN = /^(?:fits|passt),? /;

/** Return a remedy in the page's language; in the service's if it is none that is known. */
export function remedyInWords(remedy) {
  const english = timesInWords(remedy);
  if (language() === 'en') return english;
  const windows = endWindows(remedy);
  if (windows) {
    return t('remedy.endWindows', { windows: windows.map(windowInWords).join(t('remedy.and')) });
  }
  const parts = partsOf(remedy);
  if (parts.length === 1) return oneInWords(remedy, english);
  const [first, ...others] = parts.map((part) => remedyInWords(part));
  return [first, ...others.map((part) => part.replace(BEGIN, ''))].join(t('remedy.and'));
}

function windowInWords({ end, name, minutes }) {
  const time = timesInWords(minutes.replaceAll(',', ''));
  if (end === 'delivery') return t('remedy.deliveryWindow', { time });
  return name ? t('remedy.pickupWindowOf', { name, time }) : t('remedy.pickupWindow', { time });
}

function oneInWords(remedy, english) {
  for (const { name, pattern } of SAID) {
    const found = pattern.exec(remedy)?.groups ?? (pattern.test(remedy) ? {} : null);
    if (found) {
      const time = found.time && timesInWords(found.time.replaceAll(',', ''));
      return t(`remedy.${name}`, { ...found, time });
    }
  }
  return english;
}
