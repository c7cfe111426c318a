/** What is looked at, pointed to and drawn with. */

export const LOOKING = {
  selection: null, // key of what is selected, see core/plan.js
  hover: null,
  time: null, // instant of the playback, seconds
  playing: false,
  speed: 600, // seconds of the day per second
  tab: 'customers',
  frame: { // how the desk is laid out, see frame.js
    panel: 400, // pixels
    timeline: 220,
    folded: false, // the panel
    timelineFolded: false,
    sheet: 'half', // how high the panel is on a phone
    tabs: {}, // the last of each room
    tiles: false, // whether the map has streets of a public server, as was asked for
  },
  dialog: null, // name of the open dialog
  tool: null, // what is drawn on the map, see map/tools.js
  brush: {
    demand: [1], service_duration: 300, served_by: 'either', earliest: 28800, latest: 43200,
  },
};
