/** How to plan, and how the cost fell. */

import { edit, showFailure, shownPlan } from '../actions.js';
import { duration, money, number } from '../core/format.js';
import { fittingSeconds } from '../core/limits.js';
import { labelOf, withinSentence } from '../core/schema.js';
import { penaltyOf, trueCost } from '../core/terms.js';
import { html, uPlot, useEffect, useRef, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';
import { Fields } from './form.js';
import { Facts, useOpening } from './parts.js';

/** If the first cost is so many times the last, as where customers were left out, it is cut off. */
const STEEP = 3;
const SEEN = 1.25; // of the least cost is seen then

const PLAIN = ['time_limit'];
const OF_SAMPLES = ['num_samples', 'temperature'];
const OWN = ['geometry', 'times']; // the console states them itself

/** The tab. */
export function SolveTab() {
  const request = useStore((state) => state.request);
  const schemas = useStore((state) => state.schemas);
  const policies = useStore((state) => state.config.policies);
  const errors = useStore((state) => state.errors);
  const sampled = request.options?.decoding === 'sample';
  const rest = Object.keys(schemas.OptionsInput.properties).filter((name) => !PLAIN.includes(name));
  const wrong = errors.some(({ keys }) => keys[0] === 'options' && rest.includes(keys[1]));
  const card = useOpening(wrong);
  const most = useStore((state) => state.config.max_job_seconds);
  const schema = withFittingLimit(schemas.OptionsInput, request, most);
  const shared = { schema, keys: ['options'], request, onChange: edit };
  return html`<section class="section"><h3>${t('solve.how')}</h3>
      <${Fields} ...${shared} skip=${rest} />
      <details class="card" ref=${card}><summary>${t('solve.advanced')}
          <span class="right">${statedIn(request.options, rest)}</span></summary>
        <div class="inside"><${Fields} ...${shared} choices=${{ policy: policies }}
          skip=${[...PLAIN, ...OWN, ...(sampled ? [] : OF_SAMPLES)]} /></div></details>
    </section>
    <${Curve} /><${Solver} />`;
}

/** Return the schema of the options, which says how long is planned where nothing is stated. */
function withFittingLimit(schema, request, most) {
  const seconds = fittingSeconds(request, most);
  const help = t('solve.limit', { seconds, count: request.customers.length });
  const limit = { ...schema.properties.time_limit, default: seconds, help };
  return { ...schema, properties: { ...schema.properties, time_limit: limit } };
}

/** Return which of some options a problem states. */
function statedIn(options, names) {
  return names
    .filter((name) => !OWN.includes(name) && options?.[name] !== undefined)
    .map((name) => withinSentence(labelOf(name)))
    .join(', ');
}

function Curve() {
  const points = useStore((state) => state.run.points);
  const dark = useStore((state) => state.dark);
  const element = useRef(null);
  const [chart, setChart] = useState(null);
  const last = points[points.length - 1];
  const hasPenalty = useStore((state) => {
    const entry = shownPlan(state);
    return Boolean(entry) && penaltyOf(entry) > 0;
  });
  useEffect(() => {
    let end = () => {};
    let isLeft = false;
    uPlot().then((Chart) => {
      if (!isLeft) end = draw(Chart, element.current, setChart);
    }, showFailure);
    return () => {
      isLeft = true;
      setChart(null);
      end();
    };
  }, [dark]);
  useEffect(() => {
    chart?.setData([points.map(({ seconds }) => seconds), points.map(({ cost }) => cost)]);
  }, [points, chart]);
  return html`<section class="section"><h3>${t('solve.curve')}</h3>
    <p>${last ? fallen(points[0], last) : t('solve.noCurve')
    }${hasPenalty && ` ${t('curve.penaltyWithin')}`}</p>
    <div class="curve" ref=${element} role="img" aria-label=${t('solve.curveLabel')}></div>
  </section>`;
}

/** Draw an empty curve, which follows the size of its element; return what takes it away. */
function draw(Chart, element, onChart) {
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  const axis = {
    stroke: colour('text-2'),
    grid: { stroke: colour('line'), width: 1 },
    ticks: { stroke: colour('line'), width: 1 },
    font: '11px Inter, system-ui',
  };
  const seconds = t('solve.seconds');
  const sizeOf = () => ({ width: element.clientWidth, height: 190 });
  const options = {
    ...sizeOf(),
    cursor: { drag: { setScale: false } },
    scales: { x: { time: false }, y: { range: (_, low, high) => roomy(low, high) } },
    axes: [
      { ...axis, label: seconds, labelSize: 18, labelFont: '11px Inter, system-ui', size: 28 },
      { ...axis, size: 56 }],
    series: [
      { label: seconds, value: (_, value) => (value === null ? '' : number(value, 2)) },
      {
        label: t('solve.cost'),
        stroke: colour('accent'),
        width: 2,
        paths: Chart.paths.stepped({ align: 1 }),
        points: { show: true, size: 5, fill: colour('surface-1') },
        value: (_, value) => (value === null ? '' : money(value)),
      }],
  };
  const chart = new Chart(options, [[], []], element);
  const resizes = new ResizeObserver(() => chart.setSize(sizeOf()));
  resizes.observe(element);
  onChart(chart);
  return () => {
    resizes.disconnect();
    chart.destroy();
  };
}

/** Return in words how far the cost fell. */
function fallen(first, last) {
  const [from, to] = [first, last].map(({ cost }) => money(cost));
  const told = t('solve.fallen', { from, to, seconds: number(last.seconds, 1) });
  return first.cost > STEEP * last.cost ? `${told} ${t('solve.cutOff')}` : told;
}

/** Return a range of costs with room above and below, also where the cost never fell. */
function roomy(low, high) {
  if (low === null) return [0, 1];
  if (low > 0 && high > STEEP * low) return [low * (2 - SEEN), low * SEEN];
  const room = Math.max((high - low) * 0.08, high * 0.002, 0.01);
  return [low - room, high + room];
}

function Solver() {
  const entry = useStore(shownPlan);
  const iterations = useStore((state) => state.run.iterations);
  if (!entry) return null;
  const { solver } = entry.plan;
  const penalty = penaltyOf(entry);
  const facts = {
    policy: `${solver.policy}, ${solver.decoding}`,
    start: t(`solve.starts.${solver.start}`),
    first: money(solver.decoded_cost),
    cost: money(trueCost(entry)),
    ...(penalty && { penalty: money(penalty) }),
    iterations: number(Math.max(solver.search_iterations, iterations ?? 0), 0),
    took: duration(solver.elapsed.search),
    repeatable: solver.deterministic ? t('solve.isRepeatable') : t('solve.isNot'),
  };
  return html`<section class="section developers"><h3>${t('solve.plan')}</h3><${Facts}
    facts=${Object.entries(facts).map(([name, fact]) => [t(`solve.fact.${name}`), fact])}
    /></section>`;
}
