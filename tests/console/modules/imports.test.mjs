/** A page whose modules ask one another for what isn't there doesn't open at all. */

import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';

const APP = new URL('../../../app/', import.meta.url);
const ALL = [/export (?:async )?(?:function\*?|const|class|let) (\w+)/g, /export \{([^}]*)\}/g, /export (?:const|let) \{([^}]*)\}/g];

/** Where files of other pages lie that pages ask for, by how they are served. */
const SERVED = { console: 'console/static/', drive: 'records/dispatches/static/' };

/** Return where a module is that one in a folder asks for. */
function placeOf(path, from) {
  const [, page, rest] = /^(?:\.\.\/)+(console|drive)\/(.+)$/.exec(path) ?? [];
  return page ? new URL(SERVED[page] + rest, APP) : new URL(path, from);
}

function exported(source) {
  const names = ALL.flatMap((pattern) => [...source.matchAll(pattern)].flatMap(([, list]) => list.split(',')));
  return new Set(names.map((name) => name.trim().split(/ as |: /).pop()));
}

for (const page of ['console/static/js/', 'records/dispatches/static/js/', 'records/days/static/js/']) {
  test(`${page}: whatever is imported is exported`, () => {
    const folder = new URL(page, APP);
    const files = readdirSync(folder, { recursive: true }).filter((name) => name.endsWith('.js'));
    const missing = files.flatMap((file) => {
      const source = readFileSync(new URL(file, folder), 'utf8');
      const imports = [...source.matchAll(/import \{([^}]*)\} from '(\.[^']*\/[^']*|\.\/[^']*)'/g)];
      return imports
        .filter(([, , path]) => !path.includes('vendor/'))
        .flatMap(([, names, path]) => {
          const known = exported(readFileSync(placeOf(path, new URL(file, folder)), 'utf8'));
          const asked = names.split(',').map((name) => name.trim().split(' as ')[0]);
          return asked.filter((name) => name && !known.has(name)).map((name) => `${file}: ${name}`);
        });
    });
    assert.deepEqual(missing, []);
  });
}
