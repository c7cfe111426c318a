/** The map in the page, a second one beside it when plans are compared. */

import { besidePlan, hover, indexOf, select, settledOf, shownPlan } from '../actions.js';
import { describe } from '../core/describe.js';
import { sightingsOf } from '../core/living.js';
import { placeOf } from '../core/places.js';
import { playback } from '../core/playback.js';
import { visitsOf } from '../core/visits.js';
import { layOut } from '../frame.js';
import { Facts } from '../views/parts.js';
import { html, render, useEffect, useLayoutEffect, useRef, useState } from '../libraries.js';
import { store, useStore } from '../store.js';
import { Icon } from '../views/icon.js';
import { Menu } from '../views/menu.js';
import { DrawBar } from './draw-bar.js';
import { attachHandle } from './handle.js';
import { followFit } from './plan-drag.js';
import { MapLegend } from './legend.js';
import { attachTools } from './tools.js';
import { MapView, synchronise } from './view.js';
import { t } from '../texts.js';

/** The map and, if chosen, the plan that stands beside. */
export function MapPane() {
  const request = useStore((state) => state.request);
  const shown = useStore(shownPlan);
  const beside = useStore(besidePlan);
  const [split, setSplit] = useState(false);
  const [first, setFirst] = useState(null);
  const [second, setSecond] = useState(null);
  useEffect(
    () => (first && second ? synchronise(first.map, second.map) : undefined),
    [first, second]);
  useEffect(() => first?.fit(), [split, Boolean(second)]);
  return html`<section class=${`maps ${split && beside ? 'split' : ''}`}
    aria-label=${t('map.title')}>
    <div class="map-frame">
      <${Map} key=${groundOf(request)} request=${request} entry=${shown}
        onView=${setFirst} isMain />
      <${DrawBar} />
      <div class="map-tools">
        <button type="button" title=${t('map.fit')} aria-label=${t('map.fit')}
          onClick=${() => first?.fit()}><${Icon} name="maximize" /></button>
        <${Ground} request=${request} />
        ${beside &&
          html`<button type="button" aria-pressed=${split} onClick=${() => setSplit(!split)}>
          ${split ? t('map.one') : t('map.beside')}</button>`
        }
      </div>
      ${hasLocations(request) && html`<${MapLegend} request=${request} index=${indexOf(shown)}
        parts=${settledOf(shown, request)} />`}
      ${!hasLocations(request)
        && html`<p class="map-note">${request.matrices ? t('map.none') : t('map.empty')}</p>`}
    </div>
    ${split &&
      beside && html`<div class="map-frame">
      <p class="map-title">${t('map.before', { name: beside.name })}</p>
      <${Map} key=${groundOf(beside.request)} request=${beside.request} entry=${beside}
        onView=${setSecond} /></div>`}
  </section>`;
}

/** Asks for streets of a server, which then learns where one looks: never by itself. */
function Ground({ request }) {
  const { tiles } = useStore((state) => state.frame);
  const config = useStore((state) => state.config);
  if (request.coordinate_system !== 'geographic' || config.tile_url || !config.public_tiles) {
    return null;
  }
  return html`<${Menu} id="ground" name=${t('map.ground')} label=${html`<${Icon}
      name="layers" />${!tiles && !config.streets.length && t('map.streets')}`}>
      <section><h2>${t('map.ground')}</h2><p>${t('map.groundHelp')}</p>
      <button type="button" popovertarget="ground" popovertargetaction="hide"
        onClick=${() => layOut({ tiles: !tiles })}>${
        tiles ? t('map.own') : t('map.fromServer')}</button></section></${Menu}>`;
}

/** Return what a map can't change once it is made. */
function groundOf({ coordinate_system: system = 'planar', planar_unit: unit = 1 }) {
  return `${system}/${unit}`;
}

function hasLocations(request) {
  return [...request.depots, ...visitsOf(request)].some(placeOf);
}

function Map({ request, entry, onView, isMain = false }) {
  const element = useRef(null);
  const [view, setView] = useState(null);
  const dark = useStore((state) => state.dark);
  const config = useStore((state) => state.config);
  const tiles = useStore((state) => state.frame.tiles);
  const geographic = request.coordinate_system === 'geographic';
  const planarUnit = request.planar_unit ?? 1;
  const index = indexOf(entry);
  const parts = settledOf(
    entry,
    useStore((state) => state.request));
  useLayoutEffect(() => {
    const made = new MapView(element.current, {
      geographic, config, planarUnit, onHover: hover, onSelect: select,
    });
    setView(made);
    onView(made);
    const endHandle = isMain ? attachHandle(made) : () => {};
    const endTools = isMain ? attachTools(made) : () => {};
    const endFit = isMain ? followFit(made) : () => {};
    return () => {
      endHandle();
      endTools();
      endFit();
      made.destroy();
      onView(null);
    };
  }, []);
  const doubts = useStore((state) => state.doubts);
  const news = useStore(({ live }) => live?.news);
  // Before anything is drawn, or all would be drawn twice.
  useEffect(() => view?.fit(request), [view, firstPlace(request)]);
  useEffect(() => view?.setGround(tiles), [view, tiles]);
  useEffect(() => view?.shade(dark), [view, dark]);
  useEffect(
    () => view?.draw(request, index, parts, dark, doubts, news),
    [view, request, index, parts, dark, doubts, news]);
  useEffect(
    () => (view ? followMarks(view, request, index) : undefined),
    [view, request, index, parts, dark, doubts, news]);
  useEffect(() => (view && index ? followClock(view, index) : undefined), [view, index, dark]);
  return html`<div class="map" ref=${element} data-geographic=${geographic}></div>`;
}

/** Return what tells one problem's region from another's. */
function firstPlace(request) {
  return JSON.stringify([request.depots[0]?.location, request.depots.length]);
}

/** Mark what is selected and hovered; returns a function that ends it. */
function followMarks(view, request, index) {
  const tip = document.createElement('div');
  tip.className = 'tip';
  let last = '';
  const follow = ({ selection, hover: hovered }) => {
    view.mark(selection, hovered);
    // What is selected has its details beside; a click takes the tip away.
    const key = hovered === selection ? null : hovered;
    const now = `${key} ${selection}`;
    if (now !== last) {
      last = now;
      const about = describe(request, index, key);
      render(about && html`<strong>${about.title}</strong><${Facts} facts=${about.facts} />`, tip);
      view.tip(key, about && tip);
      // Details lie over the map once they are drawn.
      if (!hovered && selection) requestAnimationFrame(() => view.reveal(selection));
    }
  };
  follow(store.get());
  return store.subscribe(follow);
}

/** Move trucks and drones with the clock; returns a function that ends it. */
function followClock(view, index) {
  const placesAt = playback(index);
  let last;
  const follow = ({ time, live }) => {
    if (time === last?.time && live?.day === last.day) return;
    last = { time, day: live?.day };
    view.sight(live && time === live.day.now ? sightingsOf(live.day) : []);
    view.move(time === null ? null : whereTold(placesAt(time), live?.day, time));
  };
  follow(store.get());
  const end = store.subscribe(follow);
  return () => {
    end();
    view.sight([]);
    view.move(null);
  };
}

const LASTS = 600; // seconds for which a vehicle is where it was told to be

/** Return places with vehicles where they were told to be just now. */
function whereTold(places, day, time) {
  const told = day?.vehicles.filter(({ position, position_at: at }) =>
    position && time === day.now && time - at < LASTS);
  return told?.length ? { ...places, trucks: places.trucks.map((truck) => ({
    ...truck,
    location: told.find(({ vehicle }) => vehicle === truck.vehicle.name)?.position
      ?? truck.location,
  })) } : places;
}
