/** Why steps of drivers fail, as dispatchers and drivers read it. */

export default {
  nobody: 'Nobody there',
  refused: 'Refused',
  address: 'Wrong address',
  damaged: 'Damaged',
  time: 'No time left',
  wind: 'Too much wind',
  broken: 'Drone is broken',
  battery: 'Battery is empty',
  parcel: 'Came back with the parcel',
  lost: 'Did not come back',
  breakdown: 'Broken down',
};
