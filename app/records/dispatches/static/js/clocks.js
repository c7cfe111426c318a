/** Times of day as drivers read them: in the plan's zone, whatever the phone's. */

import { t } from './texts.js';

/** Return an instant such as `8:05`, given in seconds since the plan's start. */
export function clock(day, seconds) {
  const instant = new Date(Date.parse(day.plan_start) + seconds * 1000);
  if (day.time_zone) {
    const options = { hour: 'numeric', minute: '2-digit', hourCycle: 'h23' };
    const format = new Intl.DateTimeFormat('en-GB', { ...options, timeZone: day.time_zone });
    return format.format(instant).replace(/^0(?=\d)/, '');
  }
  const there = new Date(instant.getTime() + offsetOf(day.plan_start) * 60000);
  return `${there.getUTCHours()}:${String(there.getUTCMinutes()).padStart(2, '0')}`;
}

/** Return by how many minutes an ISO 8601 instant is told ahead of UTC. */
function offsetOf(text) {
  const [, sign, hours, minutes] = /([+-])(\d\d):?(\d\d)$/.exec(text) ?? [];
  const size = Number(hours ?? 0) * 60 + Number(minutes ?? 0);
  return sign === '-' ? -size : size;
}

/** Return a window such as `8:00 to 10:30`, `from 8:00` or `until 10:30`. */
export function windowText(day, { earliest, latest }) {
  if (latest === null) return t('time.from', { from: clock(day, earliest) });
  const until = clock(day, latest);
  return earliest > 0
    ? t('time.span', { from: clock(day, earliest), until })
    : t('time.until', { until });
}
