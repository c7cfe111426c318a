/** Zones of the airspace, as files hold them and as the map draws them. */

import assert from 'node:assert/strict';
import test from 'node:test';

import {
  addZones, zoneAreas, zonesOf, zonesOfKml,
} from '../../../app/console/static/js/core/zones.js';

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

test('areas have names, limits and authorities', () => {
  const request = { airspace: { zones: [zonesOf(ED269), zonesOf(ED318)] } };
  assert.deepEqual(zoneAreas(request), [
    { title: 'Harbour (FIN1)', restriction: 'PROHIBITED', authority: 'Port', rings: [RING],
      reach: '0 m AGL – 120 m AGL' },
    { title: 'Harbour (FIN1)', restriction: 'PROHIBITED', authority: 'Port', center: [25, 60],
      radius: 9, reach: '? – ∞' },
    { title: 'Harbour (FIN2)', restriction: 'REQ_AUTHORIZATION', authority: 'Port',
      center: [25, 60], radius: 7, reach: '50 ft AMSL – 400 ft AGL' },
  ]);
});

test('areas of plain GeoJSON and KML are drawn', () => {
  const several = { type: 'MultiPolygon', coordinates: [[RING], [RING]] };
  const request = { airspace: { zones: [
    zonesOf(plain(several)), { format: 'geojson', data: POLYGON }, { format: 'kml', data: KML },
  ] } };
  assert.deepEqual(zoneAreas(request).map(({ title, rings }) => [title, rings]), [
    ['a', [RING]], ['a', [RING]], ['', [RING]], ['Old town', [RING]]]);
  assert.deepEqual(zoneAreas({}), []);
});
