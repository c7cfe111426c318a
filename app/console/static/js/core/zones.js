/** Zones of the airspace as authorities publish them: in files, and as they are drawn. */

import { setIn } from './paths.js';

const AREAS = new Set(['Polygon', 'MultiPolygon', 'GeometryCollection']);

const MARK = /<(\w+:)?Placemark[\s>][\s\S]*?<\/\1?Placemark>/g;
const POLYGON = /<(\w+:)?Polygon[\s>]/;
const POINT = /<(\w+:)?Point[\s>]/;

/** From this on a limit stands for none. */
const UNLIMITED = 99999;

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

/** Return a request with more zones. */
export function addZones(request, stated) {
  return setIn(request, ['airspace', 'zones'], [...(request.airspace?.zones ?? []), stated]);
}

/**
 * Return the areas of a request's zones as a map draws them: `rings`, or `center` and `radius`,
 * what they are called and where they reach.
 */
export function zoneAreas(request) {
  return (request.airspace?.zones ?? []).flatMap(({ format, data }) => {
    if (format === 'kml') return kmlAreas(data);
    return collection(data).flatMap((feature) =>
      format === 'ed269' ? ed269Areas(feature) : geojsonAreas(feature),
    );
  });
}

function collection(data) {
  if (data?.features) return data.features;
  return [data?.type === 'Feature' ? data : { geometry: data, properties: {} }];
}

function ed269Areas(zone) {
  return (zone.geometry ?? []).map((volume) => ({
    ...named(zone, zone.restriction),
    ...areaOf(volume.horizontalProjection ?? {}),
    reach: reachOf({
      lower: volume.lowerLimit,
      lowerReference: volume.lowerVerticalReference,
      upper: volume.upperLimit,
      upperReference: volume.upperVerticalReference,
      uom: volume.uomDimensions,
    }),
  }));
}

function geojsonAreas({ geometry, properties, id }) {
  const known = { identifier: id, ...properties };
  const usual = known.variant ? undefined : {
    lower: known.lowerLimit,
    lowerReference: known.lowerVerticalReference,
    upper: known.upperLimit,
    upperReference: known.upperVerticalReference,
    uom: known.uomDimensions,
  };
  const name = named(known, known.variant ? known.type : known.restriction ?? 'PROHIBITED');
  return singleAreas(geometry).map((part) => ({
    ...name,
    ...areaOf(part),
    reach: reachOf(part.layer ?? geometry.layer ?? usual ?? {}),
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
  const title = words(name) ?? words(identifier) ?? '';
  const [authority] = [zoneAuthority ?? []].flat();
  return {
    title: words(identifier) && title !== words(identifier) ? `${title} (${identifier})` : title,
    restriction: restriction ?? '',
    authority: words(authority?.name) ?? words(authority?.service) ?? '',
  };
}

/** Return a text that may stand in several languages, in English if it does. */
function words(text) {
  if (!Array.isArray(text)) return text?.text ?? text ?? null;
  const english = text.find(({ lang }) => lang?.startsWith('en'));
  return (english ?? text[0])?.text ?? null;
}

/**
 * Return from where to where a volume reaches, as `0 m AGL – 120 m AGL`.
 *
 * @param {Record<string, any>} volume
 */
function reachOf({ lower, lowerReference, upper, upperReference, uom = 'm' }) {
  const limit = (value, reference) =>
    value === undefined || value === null || !reference || Math.abs(value) >= UNLIMITED
      ? '?'
      : `${value} ${uom.toLowerCase()} ${reference}`;
  const to = upper === null || upper === undefined || upper >= UNLIMITED
    ? '∞' : limit(upper, upperReference);
  return `${limit(lower, lowerReference)} – ${to}`;
}

function placeMarks(text) {
  return text.match(MARK) ?? [];
}

/** Return the areas of a text of KML, whose polygons have their coordinates ring by ring. */
function kmlAreas(text) {
  return placeMarks(text).flatMap((mark) => {
    const title = mark.match(/<name>([\s\S]*?)<\/name>/)?.[1].trim() ?? '';
    return [...mark.matchAll(/<Polygon[\s\S]*?<\/Polygon>/g)].map(([polygon]) => ({
      title,
      restriction: 'PROHIBITED',
      authority: '',
      rings: [...polygon.matchAll(/<coordinates>([\s\S]*?)<\/coordinates>/g)].map(([, corners]) =>
        corners.trim().split(/\s+/).map((corner) => corner.split(',').slice(0, 2).map(Number)),
      ),
      reach: reachOf({}),
    }));
  });
}
