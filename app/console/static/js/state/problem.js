/** The problem that is open, its edits, and where it is kept. */

export const PROBLEM = {
  request: null, // the problem as it is edited, all its times in seconds
  stated: null, // the problem as it was opened
  name: '', // of the problem, and what is noted with it
  note: '',
  epoch: 0, // counts the problems that were opened
  past: [], // requests before the last edits
  ahead: [], // those that were undone, the one undone last at the end
  home: null, // {where, id, version} of the kept plan that is open, see keeping/kept.js
  saved: null, // {request, plan} as they are kept, or were opened
  viewing: null, // token of the link by which a shared plan is looked at
  isDay: false, // whether that is a day, which goes on
  unkept: null, // why the browser doesn't keep what is done here
  keeping: null, // a dialog about kept plans, see keeping/kept.js
  importing: null, // a sheet that is looked over, see importing.js
  doubts: {}, // of where customers are, by key, see core/places.js
  warned: null, // {request, warnings} that were asked for before there is a plan
  dismissed: [], // keys of warnings that are not shown, see core/warned.js
};
