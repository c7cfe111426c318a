/** Views that few open: their modules are loaded when they are first shown. */

import { showFailure } from '../actions.js';
import { html, useEffect, useState } from '../libraries.js';

/**
 * Return a view that shows another once its module is there.
 *
 * @param load returns a promise of the other view
 */
export function later(load) {
  let View = null;
  return function Later(props) {
    const [, setLoaded] = useState(View !== null);
    useEffect(() => {
      if (View) return;
      load().then((loaded) => {
        View = loaded;
        setLoaded(true);
      }, showFailure);
    }, []);
    return View && html`<${View} ...${props} />`;
  };
}
