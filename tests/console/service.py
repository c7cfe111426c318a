"""Serves as `tandem serve` does, but for the example that a console opens with.

Nearly all tests open it, few look at how it is planned, and its search goes on when they are over.
"""

import json
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

from app.cli.commands import main
from app.schemas import openapi

FIRST_EXAMPLE, SECONDS = "table1.json", 0.2


def serve_briefly() -> None:
    """Serve, with that example searched for a moment."""
    with TemporaryDirectory() as folder:
        examples = Path(shutil.copytree(openapi.EXAMPLES_DIR, folder, dirs_exist_ok=True))
        request = json.loads((examples / FIRST_EXAMPLE).read_text("utf-8"))
        request["options"]["time_limit"] = SECONDS
        (examples / FIRST_EXAMPLE).write_text(json.dumps(request), "utf-8")
        openapi.EXAMPLES_DIR = examples
        main()


if __name__ == "__main__":
    serve_briefly()
