/** Starts the console: asks the service what it can do, opens an example and plans it. */

import { html, render } from './libraries.js';
import { openRequest, showFailure } from './actions.js';
import * as api from './api.js';
import { plan } from './planning.js';
import { store } from './store.js';
import { App } from './views/app.js';
import { listenToDrops } from './views/files.js';
import { listenToKeys } from './views/shortcuts.js';

const FIRST_EXAMPLE = 'table1';
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
      }),
  );
  const root = document.getElementById('app');
  root.replaceChildren();
  render(html`<${App} />`, root);
  listenToKeys();
  listenToDrops();
  try {
    const [description, config] = await Promise.all([api.getDescription(), api.getConfig()]);
    const { examples } = description.paths['/plan'].post.requestBody.content['application/json'];
    store.set({
      config,
      schemas: description.components.schemas,
      examples: Object.entries(examples).map(([name, { summary, value }]) => ({
        name,
        summary,
        request: value,
      })),
    });
    openRequest(examples[FIRST_EXAMPLE].value);
    await untilReady();
    await plan();
  } catch (error) {
    showFailure(error);
  }
}

async function untilReady() {
  let readiness = await api.getReadiness();
  while (readiness.status !== 'ready') {
    store.set({ starting: readiness });
    await new Promise((resolve) => {
      setTimeout(resolve, READY_CHECK_MS);
    });
    readiness = await api.getReadiness();
  }
  store.set({ starting: null });
}

begin();
