/** Starts the console: asks the service what it can do, opens an example and plans it. */

import { html, render } from './libraries.js';
import { openRequest, showFailure } from './actions.js';
import * as api from './api.js';
import { followKept } from './dispatching.js';
import { recallFrame } from './frame.js';
import { dayInAddress, openDay } from './living.js';
import { adopt, startKeeping } from './keeping/drafts.js';
import { goOn, listenToLinks, tokenInAddress, viewShared } from './keeping/kept.js';
import { plan } from './planning.js';
import { store } from './store.js';
import { App } from './views/app.js';
import { listenToDrops, listenToPastes } from './views/files.js';
import { listenToKeys } from './views/shortcuts.js';
import { t } from './texts.js';

const FIRST_EXAMPLE = 'berlin';
const IN_ADDRESS = '#example=';
const READY_CHECK_MS = 1000;

function follow() {
  const root = document.documentElement;
  const note = () => store.set({ dark: root.dataset.theme === 'dark' });
  new MutationObserver(note).observe(root, { attributes: true, attributeFilter: ['data-theme'] });
  note();
}

async function begin() {
  follow();
  api.onKeyNeeded(
    (wasWrong) =>
      new Promise((resolve) => {
        store.set({ dialog: { name: 'key', wasWrong, answer: resolve } });
      }));
  const root = document.getElementById('app');
  root.replaceChildren();
  render(html`<${App} />`, root);
  recallFrame();
  listenToKeys();
  listenToDrops();
  listenToPastes();
  listenToLinks();
  addEventListener('hashchange', () => {
    const day = dayInAddress();
    if (day) openDay(day.id, day.isWall).catch(showFailure);
  });
  try {
    // The page has asked for the first three already: each alone would take a round trip.
    const [description, config, readiness, restored] = await Promise.all([
      api.getDescription(),
      api.getConfig(),
      api.getReadiness(),
      startKeeping(tokenInAddress() !== null || dayInAddress() !== null)]);
    const { examples } = description.paths['/plan'].post.requestBody.content['application/json'];
    store.set({
      config,
      schemas: description.components.schemas,
      examples: Object.entries(examples).map(([name, { value }]) => ({
        name, request: value, isFirst: name === FIRST_EXAMPLE,
      })),
    });
    await open(restored, examples, readiness);
  } catch (error) {
    showFailure(error);
  }
}

/** Open what a link shares, else what was worked on before, else an example. */
async function open(restored, examples, readiness) {
  const token = tokenInAddress();
  if (token) {
    await viewShared(token);
    await untilReady(readiness);
    return;
  }
  const day = dayInAddress();
  if (day) {
    await untilReady(readiness);
    await openDay(day.id, day.isWall);
    return;
  }
  if (restored) {
    adopt(restored);
  } else {
    const name = exampleIn(examples);
    openRequest(examples[name].value, { name: t(`example.${name}.name`), isSafe: true });
  }
  await untilReady(readiness);
  await followKept();
  if (restored) await goOn(restored);
  else await plan();
}

/** Return the name of the example in the address, such as `#example=table1`, or of the first. */
function exampleIn(examples) {
  const { hash } = location;
  const name = hash.startsWith(IN_ADDRESS) ? hash.slice(IN_ADDRESS.length) : '';
  return Object.hasOwn(examples, name) ? name : FIRST_EXAMPLE;
}

async function untilReady(first) {
  for (let found = first; found.status !== 'ready'; found = await api.getReadiness()) {
    store.set({ starting: found });
    await new Promise((resolve) => setTimeout(resolve, READY_CHECK_MS));
  }
  store.set({ starting: null });
}

begin();
