"""Installs packages into the environment of the Python that runs this: `install.py ARGUMENT...`.

The arguments are those of `pip install`, but what one of both alone knows. uv does it in a tenth of
the time, from the registries that pip is configured for; pip does, where uv isn't to be had.
"""

import os
import subprocess
import sys
from ast import literal_eval
from pathlib import Path

SETTINGS = {
    "index-url": "UV_DEFAULT_INDEX", "extra-index-url": "UV_INDEX", "find-links": "UV_FIND_LINKS",
    "constraint": "UV_CONSTRAINT", "no-index": "UV_NO_INDEX", "cert": "SSL_CERT_FILE",
    "trusted-host": "UV_INSECURE_HOST", "proxy": "ALL_PROXY", "timeout": "UV_HTTP_TIMEOUT",
}
"""Names of pip's settings, and the variables by which uv takes the same."""

SECTIONS = ("global", "install", ":env:")
"""Where pip reads settings, each before what overrides it."""

PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check"]


def main(arguments: list[str]) -> int:
    """Install packages; return the exit status of whoever did."""
    uv = _uv()
    if uv is not None:
        installed = subprocess.run(
            [uv, "pip", "install", "--quiet", "--python", sys.executable,
             # As pip does: the best version, whichever registry has it.
             "--index-strategy", "unsafe-best-match", *arguments],
            env=_settings() | os.environ, capture_output=True, text=True, check=False)
        if installed.returncode == 0:
            return 0
        print(installed.stderr.strip(), "pip tries instead of uv.", sep="\n", file=sys.stderr)
    return subprocess.run([*PIP, "install", "--quiet", "--no-compile", *arguments],
                          check=False).returncode


def _uv() -> Path | None:
    """Return where uv is, which is fetched first; None if it isn't to be had."""
    uv = Path(sys.executable).parent / "uv"
    if not uv.exists():
        subprocess.run([*PIP, "install", "--quiet", "--no-compile", "uv"], check=False,
                       capture_output=True)
    return uv if uv.exists() else None


def _settings() -> dict[str, str]:
    """Return pip's settings as uv reads them."""
    listed = subprocess.run([*PIP, "config", "list"], check=False, capture_output=True, text=True)
    lines = [line.partition("=")[::2] for line in listed.stdout.splitlines()]
    stated: dict[str, str] = {}
    for section in SECTIONS:
        for place, value in lines:
            of, _, name = place.partition(".")
            if of == section and name in SETTINGS:
                separator = "," if name == "find-links" else " "
                stated[SETTINGS[name]] = separator.join(literal_eval(value).split())
    return stated



if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
