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

function loadScript(path) {
  if (!loading.has(path)) {
    loading.set(
      path,
      new Promise((resolve, reject) => {
        const script = document.createElement('script');
        script.src = new URL(path, VENDOR);
        script.onload = resolve;
        script.onerror = () => reject(new Error(`${path} could not be loaded.`));
        document.head.append(script);
      }),
    );
  }
  return loading.get(path);
}

/** Return Leaflet, which index.html loads. */
export function leaflet() {
  return window.L;
}

/** Return uPlot, which index.html loads. */
export function uPlot() {
  return window.uPlot;
}

/** Add drawing to Leaflet; maps made before take part after `L.PM.reInitLayer`. */
export async function drawing() {
  await loadScript('leaflet-geoman-2.20.2/leaflet-geoman.min.js');
  return window.L.PM;
}
