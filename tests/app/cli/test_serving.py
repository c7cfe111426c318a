"""What a service has loaded once it has started."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.thorough

ROOT = Path(__file__).parents[3]

STARTED = """
import asyncio
import sys
import app.cli.planning, app.cli.serving
from app.main import create_app

async def start(app):
    async with app.router.lifespan_context(app):
        print(*sys.modules, sep='\\n')

with asyncio.Runner() as runner:
    runner.run(start(create_app()))
"""


def test_a_service_starts_without_what_few_requests_need(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TANDEM_DATA_DIR", str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    done = subprocess.run([sys.executable, "-c", STARTED], cwd=ROOT, check=True, text=True,
                          stdout=subprocess.PIPE)
    loaded = set(done.stdout.splitlines())
    assert "app.main" in loaded
    assert loaded & {"alembic", "charset_normalizer", "highspy", "httpx", "lxml", "matplotlib",
                     "opentelemetry.sdk", "osmium", "python_calamine", "torch"} == set()
