/**
 * Short labels of vehicles, as badges have them: their own numbers, `3` for `van-3`.
 *
 * Where vehicles of several types have the same number, letters of the type stand before it, `V3`
 * and `T3`; of types that are one vehicle each, such as drivers by name, the letters alone.
 */

import { t } from '../texts.js';

const labels = new WeakMap();

let shownFleet = [];

/** Call vehicles as a fleet does, from now on. */
export function callBy(fleet) {
  shownFleet = fleet;
}

/**
 * Return what people call a vehicle, or a drone that is aboard of one, by the name in a plan.
 *
 * A type's only vehicle is called as its type is.
 */
export function nameOfVehicle(name) {
  const [vehicle, ...aboard] = name.split('/');
  const [, id, digits] = /^(.*)-(\d+)$/s.exec(vehicle) ?? [];
  const number = Number(digits);
  const type = shownFleet.find((each) => each.id === id);
  if (!type || number > type.count) return name;
  const called = type.names?.[number - 1] ?? (type.count === 1 ? id : vehicle);
  return [called, ...aboard].join('/');
}

/** Return what a vehicle of a plan's index is called: by its name, and that it flies if it does. */
export function titleOfVehicle({ name, flies }) {
  const vehicle = nameOfVehicle(name);
  return flies ? t('about.flying', { vehicle }) : vehicle;
}

/** Return the label of a vehicle by its name and type's id. */
export function labelOfVehicle(fleet, name, type) {
  if (!labels.has(fleet)) labels.set(fleet, new Map());
  const known = labels.get(fleet);
  if (!known.size) typeLabels(fleet).forEach((label, id) => known.set(id, label));
  const number = Number(name.slice(type.length + 1));
  return known.get(type)?.(number) ?? String(number);
}

/** Return, by type, a function from a vehicle's number to its label. */
function typeLabels(fleet) {
  const types = fleet.map(({ id, count = 1 }) => {
    const [, base, digits] = /^(.*?)[\s_-]*(\d*)$/s.exec(id);
    return { id, count, base: base || id, digits: base ? digits : '' };
  });
  const plain = types.map((type) => [type.id, (number) => numberOf(type, number)]);
  if (areUnlike(types)) return new Map(plain);
  const letters = lettersOf([...new Set(types.map(({ base }) => base))]);
  return new Map(types.map((type) => [type.id, (number) => {
    const isOne = type.count === 1 && !type.digits;
    return letters.get(type.base) + (isOne ? '' : numberOf(type, number));
  }]));
}

/** Return a vehicle's number with that of its type, if that ends in one. */
function numberOf({ count, digits }, number) {
  if (!digits) return String(number);
  return count === 1 ? digits : `${digits}-${number}`;
}

/** Tell whether numbers alone tell all vehicles of some types apart. */
function areUnlike(types) {
  const seen = new Set();
  return types.every((type) => {
    for (let number = 1; number <= type.count; number += 1) {
      const text = numberOf(type, number);
      if (seen.has(text)) return false;
      seen.add(text);
    }
    return true;
  });
}

/** Return letters by name: initials of its words, else as much of its beginning as tells it. */
function lettersOf(names) {
  const initials = names.map((name) =>
    name.split(/[\s_-]+/).map((word) => [...word][0] ?? '').join('').toUpperCase());
  const isAlone = (text, among) => among.filter((other) => other === text).length === 1;
  return new Map(names.map((name, index) => {
    if (isAlone(initials[index], initials)) return [name, initials[index]];
    for (let length = 2; length < name.length; length += 1) {
      const start = (text) => [...text].slice(0, length).join('').toUpperCase();
      if (isAlone(start(name), names.map(start))) return [name, start(name)];
    }
    return [name, name.toUpperCase()];
  }));
}
