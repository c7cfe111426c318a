"""The bundle does what its modules do one by one."""

import re
import subprocess
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

from app.console.bundle import BUNDLE, ENTRY, LATER, bundled
from app.console.routes import STATIC_DIR

FROM = re.compile(r"^(?:import|export|\}) .*from '([^']+)';$", re.MULTILINE)

LIBRARY = """const counted = { calls: 0 };
export { counted, next as another };
function next() { return counted.calls += 1; }
"""

MODULES = {
    "js/core/kinds.js": """import {
  counted,
  another as count,
} from '../../vendor/library.js';

count();
export const PLAIN = 'plain';
export function called() { return counted.calls; }
export function* drawn() { yield 'drawn'; }
export async function waited() { return 'waited'; }
export class Kind { name = 'kind'; }
export const { left, right } = { left: 'left', right: (await waited()).toUpperCase() };
""",
    "js/again.js": "export { called, PLAIN, Kind } from './core/kinds.js';\n",
    "js/late.js": """import { Kind } from './again.js';
import { note } from './notes.js';

note('late begins');
export const late = (other) => other === Kind;
""",
    "js/notes.js": """/** Told to who reads it. */
const notes = [];
// And this.

export const note = (text) => notes.push(text);
export const noted = () => notes.join();
""",
    "js/main.js": """import * as kinds from './core/kinds.js';
import { PLAIN, called, Kind as Again } from './again.js';
import { note, noted } from './notes.js';

const url = import.meta.url.split('/').slice(-2).join('/');
note('main begins');
async function begin() {
  const name = 'late';
  const loaded = await Promise.all([import('./late.js'), import(`./${name}.js`)]);
  const text = (await import(`../texts/${name}.js`)).default;
  console.log([
    PLAIN, kinds.PLAIN, Again === kinds.Kind, new Again().name, called(), ...kinds.drawn(),
    await kinds.waited(), kinds.left, kinds.right, loaded.map(({ late }) => late(Again)),
    noted(), text, Object.keys(kinds).sort(),
  ].join(' '));
}
if (url !== 'js/main.js') throw new Error(url);
begin();
""",
    "texts/late.js": "export default 'a text';\n",
    "vendor/library.js": LIBRARY,
}


def printed(folder: Path, name: str) -> str:
    """Return what a module prints."""
    done = subprocess.run(["node", folder / name], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    assert done.returncode == 0, done.stdout
    return done.stdout


def test_the_bundle_does_what_its_modules_do(tmp_path: Path) -> None:
    files = MODULES | {"package.json": '{"type": "module"}', **bundled(MODULES)}
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    told = printed(tmp_path, ENTRY)
    assert told.startswith("plain plain true kind 1 drawn waited left WAITED true,true main begins")
    assert printed(tmp_path, BUNDLE) == told
    assert "late begins" in files[LATER]
    assert "late begins" not in files[BUNDLE]
    assert "Told" not in files[BUNDLE]


def test_what_could_not_be_fetched_is_asked_for_again(tmp_path: Path) -> None:
    files = {"package.json": '{"type": "module"}', "run.js": """
import { renameSync } from 'node:fs';
globalThis.mend = () => renameSync(new URL('gone.js', import.meta.url),
  new URL('LATER', import.meta.url));
await import('./BUNDLE');
""".replace("LATER", LATER).replace("BUNDLE", BUNDLE), **bundled({
        "js/late.js": "export const late = 'is there';\n", "js/main.js": """
async function ask() {
  console.log(await import('./late.js').then(({ late }) => late, () => 'fails'));
}
ask().then(globalThis.mend).then(ask);
"""})}
    files["gone.js"] = files.pop(LATER)
    for path, text in files.items():
        (tmp_path / path).write_text(text)
    assert printed(tmp_path, "run.js").split("\n") == ["fails", "is there", ""]


@pytest.mark.parametrize("line", [
    "export let changed = 1;", "export default 1;", "import name from './notes.js';",
    "import './notes.js';", "export * from './notes.js';", "export { note };",
    "export const [one] = [1];", "export const { a: b } = {};",
])
def test_what_is_not_known_is_an_error(line: str) -> None:
    with pytest.raises(ValueError, match=r"js/some\.js: export|js/some\.js: import"):
        bundled(MODULES | {"js/some.js": f"{line}\n"})


def test_no_module_imports_itself_in_a_circle() -> None:
    """A module of the bundle would wait for itself for ever."""
    files = {path.resolve(): path.read_text("utf-8") for path in (STATIC_DIR / "js").rglob("*.js")}
    asked = {path: {found for named in FROM.findall(text)
                    if (found := (path.parent / named).resolve()) in files}
             for path, text in files.items()}
    assert sum(map(len, asked.values())) > 2 * len(asked)
    # Raises what names a circle.
    assert len(list(TopologicalSorter(asked).static_order())) == len(asked)
