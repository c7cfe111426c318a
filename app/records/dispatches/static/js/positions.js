/** Where the vehicle is: told every half minute at most, while the driver allows it. */

const KEPT = 'tandem-drive-shares';
const EVERY_MS = 30_000;
const DIGITS = 5; // of degrees: about a metre

/** In place of a step: where the vehicle is. */
export const POSITION = 'position';

/** Tell whether the driver allows it; nobody did who wasn't asked. */
export function isAllowed(storage) {
  return storage.getItem(KEPT) === 'yes';
}

/** Remember whether the driver allows it. */
export function allow(storage, isShared) {
  storage.setItem(KEPT, isShared ? 'yes' : 'no');
}

/**
 * Watch where the phone is; return a function that ends it.
 *
 * @param onPlace is told longitude and latitude
 * @param onRefused is called where the phone doesn't tell
 */
export function watch(onPlace, onRefused) {
  let latest = null;
  let toldAt = -Infinity;
  const tell = () => {
    if (!latest || Date.now() - toldAt < EVERY_MS) return;
    toldAt = Date.now();
    onPlace(latest);
    latest = null;
  };
  const hear = ({ coords: { longitude, latitude } }) => {
    latest = [longitude, latitude].map((degrees) => Number(degrees.toFixed(DIGITS)));
    tell();
  };
  const fail = (error) => error.code === error.PERMISSION_DENIED && onRefused();
  const options = { enableHighAccuracy: true, maximumAge: EVERY_MS };
  const watching = navigator.geolocation.watchPosition(hear, fail, options);
  // What came too soon is told in its time, though the vehicle stands meanwhile.
  const timer = setInterval(tell, EVERY_MS);
  return () => {
    navigator.geolocation.clearWatch(watching);
    clearInterval(timer);
  };
}
