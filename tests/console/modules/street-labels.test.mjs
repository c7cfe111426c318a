import assert from 'node:assert/strict';
import { test } from 'node:test';

import { placeNames } from '../../../app/console/static/js/core/street-labels.js';

const FRAME = [0, 0, 1000, 1000];

function way(text, line, width = 80) {
  return { text, kind: 'street', line, width };
}

test('a name stands in the middle of its street, upright', () => {
  const [name, ...others] = placeNames([way('Main', [[300, 500], [100, 500]])], FRAME);
  assert.deepEqual([name.x, name.y, name.width, others.length], [200, 500, 80, 0]);
  assert.ok(Math.abs(name.angle) < 1e-9);
  const [steep] = placeNames([way('Hill', [[100, 400], [300, 100]])], FRAME);
  assert.ok(Math.abs(steep.angle) < Math.PI / 2);
});

test('a street that is shorter than its name, bends, or is out of sight has none', () => {
  assert.deepEqual(placeNames([way('Nook', [[100, 100], [150, 100]])], FRAME), []);
  const bent = [[100, 100], [140, 100], [140, 140], [180, 140], [180, 180]];
  assert.deepEqual(placeNames([way('Stairs', bent)], FRAME), []);
  assert.deepEqual(placeNames([way('Far', [[2000, 100], [2300, 100]])], FRAME), []);
});

test('a bent street is named along its straight part', () => {
  const [name] = placeNames([way('Corner', [[100, 100], [400, 100], [400, 200]])], FRAME);
  assert.equal(name.y, 100);
});

test('names do not touch each other, and long streets are named again', () => {
  const crossing = [
    way('Long', [[0, 500], [1000, 500]]),
    way('Across', [[250, 380], [250, 620]]),
  ];
  const names = placeNames(crossing, FRAME);
  assert.deepEqual(names.map(({ text }) => text), ['Long', 'Long', 'Across']);
  const across = names[2];
  assert.ok(Math.abs(across.y - 500) > 40);
  const twins = [way('Twin', [[100, 300], [400, 300]]), way('Twin', [[100, 320], [400, 320]])];
  assert.equal(placeNames(twins, FRAME).length, 1);
});

test('where the plan is on a street its name stands beside', () => {
  const line = [[100, 500], [400, 500]];
  const route = Array.from({ length: 39 }, (_, index) => [100 + 8 * index, 500]);
  const [name] = placeNames([way('Busy', line)], FRAME, route);
  assert.equal(Math.abs(name.y - 500), 15);
  const both = route.flatMap(([x]) => [[x, 488], [x, 500], [x, 512]]);
  assert.deepEqual(placeNames([way('Full', line)], FRAME, both), []);
});
