"""The console's modules as two files, which a page asks for in place of nearly two hundred, and its
style sheets as one.

To ask for a module costs a browser a millisecond or two, even where it has kept it: that was half
of the processor's time in which a page opens.
"""

import posixpath
import re
from collections.abc import Iterable, Mapping

FOLDER = "js/"
"""Where the modules are that become part of the file; others are fetched as they are."""

ENTRY = "js/main.js"

BUNDLE, LATER = "console.js", "later.js"
"""What a page begins with, and what is fetched once something of it is needed."""

STYLES = ("base", "layout", "widgets", "import", "map", "hands", "live", "print")
"""Style sheets in their order."""

STYLE = "css/console.css"
"""All of them: browsers fetch six files at once, and others a round trip later."""

IMPORT = re.compile(r"^import (?:\* as (\w+)|\{([^{}]*)\}) from '([^']+)';$", re.MULTILINE)
PASSED_ON = re.compile(r"^export \{([^{}]*)\} from '([^']+)';$", re.MULTILINE)
DECLARED = re.compile(
    r"^export (?=(?:(?:async )?function\*? ?|const |class )(?:(\w+)|\{([\w\s,]*)\} =))",
    re.MULTILINE)
COMMENT = re.compile(r"^ *(?:/\*\*(?:[^*]|\*(?!/))*\*/|//.*)\n", re.MULTILINE)
ON_DEMAND = re.compile(r"\bimport\(")
OTHERWISE = re.compile(r"^(?:import|export)\b.*", re.MULTILINE)

FIRST = """const $modules = {
%s
};
const $made = {};
export const $url = (path) => new URL(path, import.meta.url).href;
export const $from = (path, asked) => module(new URL(asked, `file:///${path}`).pathname.slice(1));

async function $fetched(path) {
  try {
    return await (path.startsWith('%s') ? (await import($url('%s'))).modules[path]()
      : import($url(path)));
  } catch (error) {
    // Once the service can be reached again it is fetched.
    delete $made[path];
    throw error;
  }
}

/** Resolves in what a module exports, by its path below the console's folder. */
export function module(path) {
  $made[path] ??= Object.hasOwn($modules, path) ? $modules[path]() : $fetched(path);
  return $made[path];
}

await module('%s');
"""

REST = """import { $from, $url } from './%s';

export const modules = {
%s
};
"""


def bundled(files: Mapping[str, str]) -> dict[str, str]:
    """Return the two files that do what `ENTRY` and all that it imports do.

    Each module becomes a function, called when it is first imported, that resolves in what the
    module exports. Those are values, no bindings: modules may not import one another in a circle,
    nor change what they have exported. Nor may `ENTRY` wait for what it imports on demand, which
    waits for it.

    Parameters
    ----------
    files
        Modules by their paths below the console's folder.

    Raises
    ------
    ValueError
        If a module imports or exports in a way that isn't known here.
    """
    modules = {path: text for path, text in files.items() if path.startswith(FOLDER)}
    first = _imported(ENTRY, modules)
    return {BUNDLE: FIRST % (_functions(modules, first), FOLDER, LATER, ENTRY),
            LATER: REST % (BUNDLE, _functions(modules, modules.keys() - first))}


def styled(files: Mapping[str, str]) -> str:
    """Return the style sheets as one.

    Parameters
    ----------
    files
        Style sheets by their paths below the console's folder.
    """
    return "\n".join(files[f"css/{name}.css"] for name in STYLES)


def _imported(entry: str, modules: Mapping[str, str]) -> set[str]:
    """Return a module and all that it has imported once it runs."""
    found, left = set[str](), [entry]
    while left:
        path = left.pop()
        if path in modules and path not in found:
            found.add(path)
            asked = [*IMPORT.findall(modules[path]), *PASSED_ON.findall(modules[path])]
            left += [posixpath.normpath(f"{posixpath.dirname(path)}/{name}") for *_, name in asked]
    return found


def _functions(modules: Mapping[str, str], paths: Iterable[str]) -> str:
    return "\n".join(_function(path, modules[path]) for path in sorted(paths))


def _function(path: str, text: str) -> str:
    """Return a module as an entry of an object."""
    exports: list[str] = []

    def imported(match: re.Match[str]) -> str:
        whole, names, asked = match.groups()
        return f"const {whole or _renamed(names)} = await $from('{path}', '{asked}');"

    def passed_on(match: re.Match[str]) -> str:
        names, asked = match.groups()
        exports.extend(_listed(names))
        return f"const {_renamed(names)} = await $from('{path}', '{asked}');"

    def declared(match: re.Match[str]) -> str:
        name, names = match.groups()
        exports.extend([name] if name else _listed(names))
        return ""

    body = DECLARED.sub(declared, PASSED_ON.sub(passed_on, IMPORT.sub(imported, text)))
    if unknown := OTHERWISE.search(body):
        raise ValueError(f"{path}: {unknown[0]}")
    body = COMMENT.sub("", body)
    body = ON_DEMAND.sub(f"$from('{path}', ", body).replace("import.meta.url", f"$url('{path}')")
    return f"'{path}': async () => {{\n{body}return {{ {', '.join(exports)} }};\n}},"


def _listed(names: str) -> list[str]:
    return [name for name in re.split(r"[\s,]+", names) if name]


def _renamed(names: str) -> str:
    return f"{{{names.replace(' as ', ': ')}}}"
