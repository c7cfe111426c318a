/** Going to where something of the problem is edited. */

import { openTab, select } from '../actions.js';
import { tabOf } from '../core/rooms.js';
import { store } from '../store.js';

/** Return the field at a place, or the nearest that holds it. */
function nearestField(keys) {
  if (!keys.length) return null;
  return (
    document.getElementById(`field-${keys.join('-')}`) ?? nearestField(keys.slice(0, -1)));
}

/** Open the tab with the field at a place, and go there; a customer is selected, too. */
export function goTo(keys) {
  const customer = keys[0] === 'customers' && store.get().request.customers[keys[1]];
  if (customer) select(`c:${customer.id}`);
  openTab(tabOf(keys));
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      const rule = /** @type {HTMLButtonElement} */ (
        document.querySelector(`[data-rule="${keys.slice(0, 3).join('-')}"]`));
      if (rule?.getAttribute('aria-pressed') === 'false') rule.click();
      const field = nearestField(keys);
      field?.closest('details')?.setAttribute('open', '');
      field?.scrollIntoView({ block: 'center' });
      field?.focus();
    }));
}
