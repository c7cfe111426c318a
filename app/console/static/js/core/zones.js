/** Zones of the airspace as authorities publish them: in files, and as they are drawn. */

import { setIn } from './paths.js';

const AREAS = new Set(['Polygon', 'MultiPolygon', 'GeometryCollection']);

const MARK = /<(\w+:)?Placemark[\s>][\s\S]*?<\/\1?Placemark>/g;
const POLYGON = /<(\w+:)?Polygon[\s>]/;
const POINT = /<(\w+:)?Point[\s>]/;

/** From this on a limit stands for none. */
const UNLIMITED = 99999;

/** What files say in place of the service's words. */
const RESTRICTIONS = {
  REQ_AUTHORIZATION: 'REQ_AUTHORISATION',
  REQUIRES_AUTHORISATION: 'REQ_AUTHORISATION',
  REQUIRES_AUTHORIZATION: 'REQ_AUTHORISATION',
  USPACE: 'REQ_AUTHORISATION',
  'U-SPACE': 'REQ_AUTHORISATION',
  NO_RESTRICTIONS: 'NO_RESTRICTION',
};
const REFERENCES = { GND: 'AGL', SFC: 'AGL', MSL: 'AMSL', HAE: 'WGS84' };

/** Return the zones that a parsed file holds as a request states them; null if it holds none. */
export function zonesOf(content) {
  const features = content?.features;
  if (!Array.isArray(features) || !features.length) return null;
  if (features.every(({ geometry } = {}) => Array.isArray(geometry))) {
    return { format: 'ed269', data: content };
  }
  const known = features[0].properties ?? {};
  if (known.type && known.variant && known.zoneAuthority) return { format: 'ed318', data: content };
  return features.every(({ geometry }) => AREAS.has(geometry?.type))
    ? { format: 'geojson', data: content }
    : null;
}

/** Return the zones of a text of KML as a request states them; null if marks are mere points. */
export function zonesOfKml(text) {
  const marks = placeMarks(text);
  const isArea = (mark) => POLYGON.test(mark);
  const isPlace = (mark) => POINT.test(mark) && !isArea(mark);
  return marks.some(isArea) && !marks.some(isPlace) ? { format: 'kml', data: text } : null;
}

/** Metres that flights keep from areas and zones, unless somebody says otherwise. */
export const PROPOSED_BUFFER_M = 30;

/** Return a request in which flights keep the distance that is proposed. */
export function withBuffer(request) {
  return setIn(request, ['airspace', 'buffer'], PROPOSED_BUFFER_M);
}

/** Return a request with the proposed distance, unless it states one or lies on a plane. */
export function proposed(request) {
  const { coordinate_system: system, airspace } = request;
  const isOpen = system === 'geographic' && airspace?.buffer === undefined;
  return isOpen ? withBuffer(request) : request;
}

/** Return a request with more zones. */
export function addZones(request, stated) {
  const more = setIn(request, ['airspace', 'zones'], [...(request.airspace?.zones ?? []), stated]);
  return proposed(more);
}

const drawn = new WeakMap();

/**
 * Return the areas of a request's zones as a map draws them: `rings`, or `center` and `radius`,
 * `name`, `identifier`, `restriction`, `authority`, `lower` and `upper`, both null where no height
 * is stated.
 */
export function zoneAreas(request) {
  return (request.airspace?.zones ?? []).flatMap((stated) => {
    // A country's file is read once, however often the map is drawn.
    if (!drawn.has(stated)) drawn.set(stated, areasIn(stated));
    return drawn.get(stated);
  });
}

/** Return the zone that a key such as `z:3` names, null if it names none. */
export function zoneOf(request, key) {
  return key[0] === 'z' ? zoneAreas(request)[Number(key.slice(2))] ?? null : null;
}

/** Return how many zones a file holds. */
export function countZones({ format, data }) {
  return format === 'kml' ? placeMarks(data).filter((mark) => POLYGON.test(mark)).length
    : collection(data).length;
}

function areasIn({ format, data }) {
  if (format === 'kml') return kmlAreas(data);
  return collection(data).flatMap(format === 'ed269' ? ed269Areas : geojsonAreas);
}

function collection(data) {
  if (data?.features) return data.features;
  return [data?.type === 'Feature' ? data : { geometry: data, properties: {} }];
}

function ed269Areas(zone) {
  return (zone.geometry ?? []).map((volume) => ({
    ...named(zone, zone.restriction),
    ...areaOf(volume.horizontalProjection ?? {}),
    ...limitsOf(volume),
  }));
}

function geojsonAreas({ geometry, properties, id }) {
  const known = { identifier: id, ...properties };
  const name = named(known, known.variant ? known.type : known.restriction ?? 'PROHIBITED');
  return singleAreas(geometry).map((part) => ({
    ...name,
    ...areaOf(part),
    ...limitsOf(part.layer ?? geometry.layer ?? (known.variant ? {} : known)),
  }));
}

/** Return a geometry's areas one by one. */
function singleAreas(geometry) {
  if (geometry?.type === 'GeometryCollection') return geometry.geometries.flatMap(singleAreas);
  if (geometry?.type !== 'MultiPolygon') return geometry ? [geometry] : [];
  return geometry.coordinates.map((coordinates) => ({ ...geometry, type: 'Polygon', coordinates }));
}

function areaOf({ coordinates, center, radius, extent }) {
  if (extent) return { center: coordinates, radius: extent.radius };
  return center ? { center, radius } : { rings: coordinates ?? [] };
}

function named({ identifier, name, zoneAuthority }, restriction) {
  const [authority] = [zoneAuthority ?? []].flat();
  return {
    name: words(name),
    identifier: words(identifier),
    restriction: spelled(restriction ?? '', RESTRICTIONS),
    authority: words(authority?.name) ?? words(authority?.service) ?? '',
  };
}

/** Return a text that may stand in several languages, in English if it does. */
function words(text) {
  if (!Array.isArray(text)) return text?.text ?? text ?? null;
  const english = text.find(({ lang }) => lang?.startsWith('en'));
  return (english ?? text[0])?.text ?? null;
}

/** Return the heights of a volume of ED-269, a layer of ED-318, or properties like either. */
function limitsOf(stated) {
  const unit = String(stated.uomDimensions ?? stated.uom ?? 'M').toUpperCase();
  const limit = (value, reference) =>
    value === undefined || value === null || !reference || Math.abs(value) >= UNLIMITED
      ? null
      : { value: Number(value), unit, reference: spelled(reference, REFERENCES) };
  return {
    lower: limit(stated.lowerLimit ?? stated.lower,
      stated.lowerVerticalReference ?? stated.lowerReference),
    upper: limit(stated.upperLimit ?? stated.upper,
      stated.upperVerticalReference ?? stated.upperReference),
  };
}

/** Return a word as the service spells it. */
function spelled(word, meant) {
  const plain = String(word).trim().toUpperCase().replaceAll(' ', '_');
  return meant[plain] ?? plain;
}

function placeMarks(text) {
  return text.match(MARK) ?? [];
}

/** Return the areas of a text of KML, whose polygons have their coordinates ring by ring. */
function kmlAreas(text) {
  return placeMarks(text).flatMap((mark) => {
    const name = mark.match(/<name>([\s\S]*?)<\/name>/)?.[1].trim() ?? null;
    return [...mark.matchAll(/<Polygon[\s\S]*?<\/Polygon>/g)].map(([polygon]) => ({
      name,
      identifier: null,
      restriction: 'PROHIBITED',
      authority: '',
      rings: [...polygon.matchAll(/<coordinates>([\s\S]*?)<\/coordinates>/g)].map(([, corners]) =>
        corners.trim().split(/\s+/).map((corner) => corner.split(',').slice(0, 2).map(Number))),
      ...limitsOf({}),
    }));
  });
}
