/** Opens files: problems as JSON, sheets of customers as CSV or Excel. */

import { openRequest, openTab, showFailure } from '../actions.js';
import { ApiError } from '../api.js';
import { csvReader, excelReader } from '../libraries.js';
import { plan } from '../planning.js';
import { store } from '../store.js';

/** Open a file that the user chose or dropped. */
export async function openFile(file) {
  try {
    const ending = file.name.slice(file.name.lastIndexOf('.') + 1).toLowerCase();
    if (ending === 'json') await openJson(file);
    else openSheet(file.name, await rowsOf(file, ending));
  } catch (error) {
    showFailure(error);
  }
}

/** Open files that are dropped onto the page. */
export function listenToDrops() {
  const mark = (isOver) => document.body.classList.toggle('drop', isOver);
  document.addEventListener('dragover', (event) => {
    event.preventDefault();
    mark(true);
  });
  document.addEventListener('dragleave', () => mark(false));
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    mark(false);
    const [file] = event.dataTransfer.files;
    if (file) openFile(file);
  });
}

async function openJson(file) {
  let content;
  try {
    content = JSON.parse(await file.text());
  } catch (error) {
    throw new ApiError(0, `${file.name} is not JSON`, `${error.message}.`);
  }
  const request = content?.problem ?? content;
  const lacking = ['depots', 'customers', 'fleet'].filter(
    (name) => !Array.isArray(request?.[name]),
  );
  if (lacking.length) {
    throw new ApiError(
      0,
      `${file.name} is no problem`,
      `It lacks ${lacking.join(', ')}: open a request as the API takes it, or an exported problem.`,
    );
  }
  openRequest(request);
  await plan();
}

async function rowsOf(file, ending) {
  if (ending === 'xlsx') {
    const read = await excelReader();
    const [first] = await read(file);
    return first.data;
  }
  const reader = await csvReader();
  return reader.parse((await file.text()).replace(/^\ufeff/, ''), { skipEmptyLines: 'greedy' })
    .data;
}

function openSheet(name, rows) {
  if (rows.length < 2) {
    throw new ApiError(
      0,
      `${name} has no customers`,
      'It needs a line of names and a line per customer.',
    );
  }
  store.set({ sheet: { name, rows }, failure: null });
  openTab('customers');
}
