"""Whatever fits or doesn't fit the API's description is answered as it says, never with a 5xx.

The study of ten thousand cases is `python -m benchmarks.fuzz.api`.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from app.database.connections import make_engine
from app.serving.access.keys import SCOPES, KeyStore
from app.serving.settings import Settings
from tests.app.serving.observe.server import running
from tests.conftest import PATIENCE

pytestmark = pytest.mark.slow

CASES = 1
"""Most of each operation in a phase."""

UNCHECKED = "positive_data_acceptance"
"""What fits the schema may still be refused: ids that repeat, windows that end before they begin.
"""


def test_generated_requests_are_answered_as_described(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path / "data")
    engine = make_engine(settings.database)
    key = KeyStore(engine).create("fuzz", SCOPES)
    engine.dispose()
    with running(TANDEM_ACCESS="keys", TANDEM_DATA_DIR=str(settings.data_dir), TANDEM_ROLE="all",
                 TANDEM_WRONG_KEYS_PER_MINUTE="0", TANDEM_LOG_LEVEL="error") as server:
        # Made once, which takes longer on a busy machine than Schemathesis waits.
        described = set(server.client.get("/openapi.json", timeout=PATIENCE).json()["paths"])
        command = [
            Path(sys.executable).parent / "schemathesis", "run",
            f"{server.client.base_url}/openapi.json", "--header", f"Authorization: Bearer {key}",
            "--phases", "examples,fuzzing", "--max-examples", str(CASES), "--seed", "7",
            "--exclude-checks", UNCHECKED, "--continue-on-failure", "--no-shrink",
            "--suppress-health-check", "all", "--request-timeout", str(PATIENCE),
            "--report", "json", "--report-json-path", "report.json",
        ]
        done = subprocess.run(command, cwd=tmp_path, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False)
    assert done.returncode == 0, done.stdout
    report = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert report["operations"]["tested"] >= len(described)
    assert report["test_cases"]["generated"] > CASES
