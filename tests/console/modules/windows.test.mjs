import assert from 'node:assert/strict';
import test from 'node:test';
import { changeWindows, giveWindows } from '../../../app/console/static/js/core/changes.js';
import {
  windowAt,
  windowsInWords,
  windowsOf,
} from '../../../app/console/static/js/core/windows.js';

const several = {
  id: 'A',
  time_windows: [
    { latest: 3600, early_cost_per_hour: 2 },
    { earliest: 7200, latest: 9000, early_cost_per_hour: 2, late_cost_per_hour: 5 },
  ],
};
const request = { customers: [several, { id: 'B', time_window: { latest: 600 } }], fleet: [] };

test('several windows are told one after another', () => {
  assert.equal(windowsInWords(windowsOf(several)), 'until 1:00, 2:00 to 2:30');
  assert.equal(windowsInWords(windowsOf({ id: 'C' })), 'any time');
  assert.equal(windowAt(several, 7199), several.time_windows[0]);
  assert.equal(windowAt(several, 7200), several.time_windows[1]);
});

test('windows that change keep what they cost', () => {
  const times = [{ earliest: 0, latest: 60 }];
  const one = giveWindows(request, ['A'], times).customers[0];
  assert.deepEqual(one, {
    id: 'A',
    time_window: { earliest: 0, latest: 60, early_cost_per_hour: 2, late_cost_per_hour: 5 },
  });
  const two = giveWindows(request, ['B'], [...times, { earliest: 90, latest: null }]).customers[1];
  assert.deepEqual(two.time_windows, [
    { earliest: 0, latest: 60 },
    { earliest: 90, latest: null },
  ]);
});

test('only the last window becomes soft', () => {
  const [soft] = changeWindows(request, 30).customers;
  assert.deepEqual(
    soft.time_windows.map((window) => window.late_cost_per_hour),
    [undefined, 30],
  );
  assert.deepEqual(changeWindows(request, null).customers, [{ id: 'A' }, { id: 'B' }]);
});
