/** Zones of the airspace, as files hold them and as the map draws them. */

import assert from 'node:assert/strict';
import test from 'node:test';

import { setArea } from '../../../app/console/static/js/core/changes.js';
import {
  addZones, countZones, zoneAreas, zonesOf, zonesOfKml,
} from '../../../app/console/static/js/core/zones.js';
import {
  closureInWords, reachOf, titleOfZone, zoneInWords,
} from '../../../app/console/static/js/core/zone-words.js';

const RING = [[24.9, 60.2], [24.92, 60.2], [24.92, 60.21]];
const POLYGON = { type: 'Polygon', coordinates: [RING] };
const ED269 = {
  features: [{
    identifier: 'FIN1',
    name: 'Harbour',
    restriction: 'PROHIBITED',
    zoneAuthority: [{ name: 'Port' }],
    geometry: [
      {
        uomDimensions: 'M', lowerLimit: 0, lowerVerticalReference: 'AGL', upperLimit: 120,
        upperVerticalReference: 'AGL', horizontalProjection: POLYGON,
      },
      { upperLimit: 99999, horizontalProjection: { type: 'Circle', center: [25, 60], radius: 9 } },
    ],
  }],
};
const ED318 = {
  type: 'FeatureCollection',
  features: [{
    type: 'Feature',
    geometry: {
      type: 'GeometryCollection',
      geometries: [
        {
          type: 'Point', coordinates: [25, 60], extent: { subType: 'Circle', radius: 7 },
          layer: { lower: 50, lowerReference: 'AMSL', upper: 400, upperReference: 'AGL', uom: 'ft' },
        },
      ],
    },
    properties: {
      identifier: 'FIN2', type: 'REQ_AUTHORIZATION', variant: 'COMMON',
      name: [{ text: 'Satama', lang: 'fi-FI' }, { text: 'Harbour', lang: 'en-GB' }],
      zoneAuthority: [{ name: [{ text: 'Port', lang: 'en-GB' }] }],
    },
  }],
};
const plain = (geometry) => ({
  type: 'FeatureCollection', features: [{ type: 'Feature', id: 'a', properties: {}, geometry }],
});
const KML = `<kml><Placemark><name>Old town</name><Polygon><outerBoundaryIs><LinearRing>
  <coordinates>24.9,60.2,0 24.92,60.2,0 24.92,60.21,0</coordinates></LinearRing></outerBoundaryIs>
  </Polygon></Placemark></kml>`;

test('files of zones are told by what they hold', () => {
  const formats = [ED269, ED318, plain(POLYGON), plain({ type: 'Point', coordinates: [1, 2] }),
    { features: [] }, { depots: [] }, null, []].map((content) => zonesOf(content)?.format ?? null);
  assert.deepEqual(formats, ['ed269', 'ed318', 'geojson', null, null, null, null, null]);
});

test('KML has zones if its marks are areas, and places if some are points', () => {
  const point = '<Placemark><Point><coordinates>24.9,60.2</coordinates></Point></Placemark>';
  const labelled = KML.replace('<Polygon>', '<Point></Point><Polygon>');
  const prefixed = KML.replaceAll(/(<\/?)(?=[A-Z])/g, '$1k:');
  const bordered = KML.replace('</kml>', '<Placemark><LineString/></Placemark></kml>');
  for (const text of [KML, labelled, prefixed, bordered]) {
    assert.deepEqual(zonesOfKml(text), { format: 'kml', data: text });
  }
  for (const text of [`<kml>${point}</kml>`, KML.replace('</kml>', `${point}</kml>`), '<kml/>']) {
    assert.equal(zonesOfKml(text), null);
  }
});

test('zones are added beside others', () => {
  const one = addZones({ airspace: { wind: {} } }, zonesOf(ED269));
  const two = addZones(one, zonesOf(ED318));
  assert.deepEqual(two.airspace.zones.map(({ format }) => format), ['ed269', 'ed318']);
  assert.deepEqual(two.airspace.wind, {});
});

test('flights keep 30 m from the first area or zone on the globe, unless it is stated', () => {
  const globe = { coordinate_system: 'geographic' };
  assert.equal(addZones(globe, zonesOf(ED269)).airspace.buffer, 30);
  assert.equal(addZones({ ...globe, airspace: { buffer: 0 } }, zonesOf(ED269)).airspace.buffer, 0);
  const ring = [[24, 60], [25, 60], [25, 61]];
  assert.equal(setArea(globe, ring).airspace.buffer, 30);
  assert.equal(setArea({ airspace: {} }, ring).airspace.buffer, undefined);
  const stated = { ...globe, airspace: { no_fly: [ring] } };
  assert.equal(setArea(stated, ring, 0).airspace.buffer, undefined);
});

const AGL = (value) => ({ value, unit: 'M', reference: 'AGL' });

test('areas have names, limits and authorities', () => {
  const request = { airspace: { zones: [zonesOf(ED269), zonesOf(ED318)] } };
  const harbour = { name: 'Harbour', identifier: 'FIN1', restriction: 'PROHIBITED' };
  assert.deepEqual(zoneAreas(request), [
    { ...harbour, authority: 'Port', rings: [RING], lower: AGL(0), upper: AGL(120) },
    { ...harbour, authority: 'Port', center: [25, 60], radius: 9, lower: null, upper: null },
    {
      name: 'Harbour', identifier: 'FIN2', restriction: 'REQ_AUTHORISATION', authority: 'Port',
      center: [25, 60], radius: 7,
      lower: { value: 50, unit: 'FT', reference: 'AMSL' },
      upper: { value: 400, unit: 'FT', reference: 'AGL' },
    },
  ]);
  assert.deepEqual(request.airspace.zones.map(countZones), [1, 1]);
});

test('zones are told with what they ask for, where they reach and whose they are', () => {
  const [low, unlimited, aloft] = zoneAreas({ airspace: { zones: [
    zonesOf(ED269), zonesOf(ED318)] } });
  assert.equal(zoneInWords(low), 'the zone Harbour (FIN1), where flying is prohibited from the '
    + 'ground to 120 m above the ground. Its authority: Port.');
  assert.equal(reachOf(unlimited), 'from an unstated height up');
  assert.equal(reachOf(aloft), 'from 50 ft above the sea to 400 ft above the ground');
  assert.equal(closureInWords({ ...unlimited, authority: null, name: null, holds: 'way' }),
    'No flight leads there from the depot around the zone FIN1, where flying is prohibited '
    + 'from an unstated height up.');
  const near = { ...unlimited, authority: 'Port', name: null, holds: 'customer' };
  assert.equal(closureInWords({ ...near, metres: 12, buffer: 30 }),
    'It lies 12 m from the zone FIN1, where flying is prohibited from an unstated height up. '
    + 'Its authority: Port. Flights keep 30 m from it.');
  assert.match(zoneInWords({ ...near, times: [{ begin: 3600, end: 7200 }] }),
    /It is closed from .*1:00.* to .*2:00.*\.$/);
});

test('areas of plain GeoJSON and KML are drawn', () => {
  const several = { type: 'MultiPolygon', coordinates: [[RING], [RING]] };
  const request = { airspace: { zones: [
    zonesOf(plain(several)), { format: 'geojson', data: POLYGON }, { format: 'kml', data: KML },
  ] } };
  assert.deepEqual(zoneAreas(request).map((area) => [titleOfZone(area), area.rings]), [
    ['a', [RING]], ['a', [RING]], ['without a name', [RING]], ['Old town', [RING]]]);
  assert.deepEqual(request.airspace.zones.map(countZones), [1, 1, 1]);
  assert.deepEqual(zoneAreas({}), []);
});
