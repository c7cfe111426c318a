/** The rooms of the desk, and the tabs in each of them. */

export const ROOMS = {
  orders: { icon: 'package', tabs: ['customers', 'unassigned'] },
  fleet: { icon: 'truck', tabs: ['fleet'] },
  routes: { icon: 'route', tabs: ['routes', 'costs', 'solve'] },
  day: { icon: 'calendar-clock', tabs: ['replan'] },
  compare: { icon: 'scale', tabs: ['changes', 'scenarios'] },
  drivers: { icon: 'users-round', tabs: ['drivers'] },
  export: { icon: 'download', tabs: ['export'] },
};

/** Return the room that a tab is in. */
export function roomOf(tab) {
  return Object.keys(ROOMS).find((room) => ROOMS[room].tabs.includes(tab));
}

/** Parts of a problem that the customers' tab has. */
const OF_CUSTOMERS = new Set(['customers', 'shipments', 'depots', 'launch_sites', 'relations',
  'incompatible_goods', 'coordinate_system', 'planar_unit', 'planar_rounding']);

/** Return the tab where a place of the request is edited. */
export function tabOf(keys) {
  if (OF_CUSTOMERS.has(keys[0])) return 'customers';
  if (keys[0] === 'replan') return 'replan';
  return keys[0] === 'options' ? 'solve' : 'fleet';
}
