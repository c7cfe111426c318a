/** The day of a plan: what its seconds are on the wall clock, and back, as the service reads. */

const SECOND = 1000;
const MINUTE = 60 * SECOND;
const DAY = 24 * 60 * MINUTE;
const QUARTER = 15 * MINUTE; // no offset changes within one

const WALL =
  /^(?:([+-]\d{1,3}) )?(\d{1,2}):([0-5]\d)(?::([0-5]\d(?:\.\d{1,6})?))?(Z|[+-]\d\d:?\d\d)?$/;
const DATE_TIME =
  /^(\d{4})-(\d\d)-(\d\d)[T ](\d\d):(\d\d)(?::(\d\d(?:\.\d{1,6})?))?(Z|[+-]\d\d:?\d\d)?$/;

/**
 * Return the day of a request, null if it states none that can be read.
 *
 * @param {{plan_start?: string, time_zone?: string}} [request]
 */
export function dayOf({ plan_start: start, time_zone: zone } = {}) {
  if (typeof start !== 'string') return null;
  try {
    return new Day(start, zone ?? null);
  } catch {
    return null;
  }
}

/** A day by the wall clock of a zone, or by a fixed offset. */
export class Day {
  constructor(start, zone) {
    const parts = DATE_TIME.exec(start);
    if (!parts) throw new RangeError('no date and time');
    this.stated = start;
    this.zone = zone;
    const offset = minutesOf(parts[7]);
    if (zone) this.clocks = clocksOf(zone);
    else if (offset === null) throw new RangeError('neither an offset nor a zone');
    else this.fixed = offset;
    this.start = this.instantOf(wallOf(parts), offset);
    this.midnight = Math.floor(this.wallAt(this.start) / DAY) * DAY;
    this.date = new Date(this.midnight).toISOString().slice(0, 10);
  }

  /** Return the seconds since plan start of a text, null if it is no instant. */
  secondsAt(text) {
    const trimmed = text.trim();
    const dated = DATE_TIME.exec(trimmed);
    if (dated) return this.since(this.instantOf(wallOf(dated), minutesOf(dated[7])));
    const parts = WALL.exec(trimmed);
    if (!parts || Number(parts[2]) > 24) return null;
    const [, days, hour, minute, second = 0, offset] = parts;
    const clock = (Number(hour) * 60 + Number(minute)) * MINUTE + Number(second) * SECOND;
    if (clock > DAY) return null;
    const wall = this.midnight + Number(days ?? 0) * DAY + clock;
    return this.since(this.instantOf(wall, minutesOf(offset)));
  }

  /** Return the days after the plan's, and milliseconds since midnight, of an instant. */
  clockAt(seconds) {
    const wall = this.wallAt(this.start + Math.round(seconds * SECOND)) - this.midnight;
    const days = Math.floor(wall / DAY);
    return { days, clock: wall - days * DAY };
  }

  /** Return an instant as text that is read as the same instant again. */
  textAt(seconds) {
    const { days, clock } = this.clockAt(seconds);
    const text = new Date(clock).toISOString().slice(11, clock % SECOND ? 23 : 19);
    const short = text.endsWith(':00') && text.length === 8 ? text.slice(0, 5) : text;
    return days ? `${days > 0 ? '+' : '-'}${Math.abs(days)} ${short}` : short;
  }

  since(instant) {
    return (instant - this.start) / SECOND;
  }

  /** Return an instant as its wall time would be in UTC. */
  wallAt(instant) {
    return instant + this.offsetAt(instant) * MINUTE;
  }

  /** Return the instant of a wall time: of two the first, of none by the offset before. */
  instantOf(wall, offset) {
    if (offset !== null) return wall - offset * MINUTE;
    const [before, after] = [-DAY, DAY].map((away) => this.offsetAt(wall + away));
    const [first, second] = [before, after].map((minutes) => wall - minutes * MINUTE);
    return this.offsetAt(first) !== before && this.offsetAt(second) === after ? second : first;
  }

  /** Return the minutes that the zone is ahead of UTC at an instant. */
  offsetAt(instant) {
    return this.zone ? this.clocks(instant) : this.fixed;
  }
}

const known = new Map();

/** Return what tells a zone's offset at instants. */
function clocksOf(zone) {
  if (!known.has(zone)) {
    const format = new Intl.DateTimeFormat('en-US', {
      timeZone: zone, hourCycle: 'h23', year: 'numeric', month: '2-digit', day: '2-digit',
      hour: '2-digit', minute: '2-digit', second: '2-digit',
    });
    const offsets = new Map();
    known.set(zone, (instant) => {
      const quarter = Math.floor(instant / QUARTER);
      if (!offsets.has(quarter)) offsets.set(quarter, offsetBy(format, quarter * QUARTER));
      return offsets.get(quarter);
    });
  }
  return known.get(zone);
}

function offsetBy(format, instant) {
  const part = Object.fromEntries(
    format.formatToParts(instant).map(({ type, value }) => [type, Number(value)]));
  const wall = Date.UTC(
    part.year, part.month - 1, part.day, part.hour, part.minute, part.second);
  return (wall - instant) / MINUTE;
}

/** @param {RegExpExecArray} parts what `DATE_TIME` found */
function wallOf([, year, month, day, hour, minute, second]) {
  const wall = Date.UTC(Number(year), Number(month) - 1, Number(day), Number(hour), Number(minute));
  return wall + Math.round(Number(second ?? 0) * SECOND);
}

function minutesOf(offset) {
  if (offset === undefined) return null;
  if (offset === 'Z') return 0;
  const minutes = Number(offset.slice(1, 3)) * 60 + Number(offset.slice(-2));
  return offset[0] === '-' ? -minutes : minutes;
}
