/** Comparisons and sweeps of fleets. */

export const SCENARIOS = {
  scenario: null, // comparison or sweep and its job
  scenarioSeconds: null, // of each scenario; null: as long as fits the problem
  keptFleets: {}, // fleets by name, to compare
  sweepAxes: null, // `[{path, text}]` as chosen; null: around the fleet at hand
};
