import assert from 'node:assert/strict';
import test from 'node:test';
import { currencyOf } from '../../../app/console/static/js/core/currencies.js';

test('the clock says where one is, and the language where the clock says nothing', () => {
  const cases = [
    ['Europe/Berlin', 'en-US', 'EUR'],
    ['Europe/Zurich', 'de-DE', 'CHF'],
    ['Europe/London', 'pl', 'GBP'],
    ['Australia/Perth', 'en-GB', 'AUD'],
    ['America/Denver', 'en-US', 'USD'],
    ['America/Lima', 'es-PE', undefined],
    ['UTC', 'de-AT', 'EUR'],
    ['UTC', 'de', undefined],
    ['Europe/Belgrade', 'sr', undefined],
  ];
  for (const [zone, language, currency] of cases) {
    assert.equal(currencyOf(zone, language), currency, `${zone} ${language}`);
  }
});
