/** The libraries kept in vendor/; the heavier ones are loaded when they are first needed. */

export {
  html,
  render,
  useState,
  useEffect,
  useLayoutEffect,
  useRef,
  useMemo,
} from '../vendor/htm-3.1.1/standalone.module.js';

const VENDOR = new URL('../vendor/', import.meta.url);
const loading = new Map();

/** Add a script or style sheet to the page, once. */
function load(path) {
  if (!loading.has(path)) loading.set(path, added(path));
  return loading.get(path);
}

function added(path) {
  const url = new URL(path, VENDOR).href;
  const element = path.endsWith('.css')
    ? Object.assign(document.createElement('link'), { rel: 'stylesheet', href: url })
    : Object.assign(document.createElement('script'), { src: url });
  // Ahead of the console's own style sheets, which may say otherwise.
  document.head.prepend(element);
  return new Promise((resolve, reject) => {
    element.onload = resolve;
    element.onerror = () => reject(new Error(`${path} could not be loaded.`));
  });
}

/** Return Leaflet, which index.html loads. */
export function leaflet() {
  return window.L;
}

/** Return uPlot, the curves. */
export async function uPlot() {
  await Promise.all(
    ['uplot-1.6.32/uPlot.min.css', 'uplot-1.6.32/uPlot.iife.min.js'].map(load));
  return window.uPlot;
}

/** Add drawing to Leaflet; maps made before take part after `L.PM.reInitLayer`. */
export async function drawing() {
  const folder = 'leaflet-geoman-2.20.2';
  await Promise.all([`${folder}/leaflet-geoman.css`, `${folder}/leaflet-geoman.min.js`].map(load));
  return window.L.PM;
}
