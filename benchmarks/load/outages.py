"""Stops PostgreSQL under a service that works on jobs, and looks what becomes of them.

    python -m benchmarks.load.outages --database-url postgresql://user@host/tandem \\
        --stop 'pg_ctl -D data -m fast stop' --start 'pg_ctl -D data -w start'

Jobs of several seconds are kept coming. While the database is away, `POST /jobs` has to be refused
and `POST /plan` to be answered. Afterwards no job may be lost, have two results or a higher cost.
"""

import argparse
import json
import random
import subprocess
import tempfile
import time
from collections import Counter
from pathlib import Path

from benchmarks.load.crashes import EXAMPLE, POLLING, Service, Study, outcome_of, table

AROUND = 8.0
"""Seconds that jobs run before the first outage and after each."""


def ask_during(service: Service, seconds: float) -> Counter[str]:
    """Return how plans and jobs were answered in so many seconds, a few each second."""
    request = json.loads(EXAMPLE.read_text("utf-8"))
    answers: Counter[str] = Counter()
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        for path, limit in (("/plan", 0), ("/jobs", 5)):
            reply = service.client.post(path, json=request | {"options": {"time_limit": limit}})
            answers[f"POST {path} {reply.status_code}"] += 1
        time.sleep(POLLING)
    return answers


def main() -> None:
    """Run the study and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--database-url", required=True)
    parser.add_argument("--stop", required=True, help="command that stops PostgreSQL")
    parser.add_argument("--start", required=True, help="command that starts it again")
    parser.add_argument("--outages", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=20.0, help="length of an outage")
    parser.add_argument("--jobs-at-once", type=int, default=4)
    arguments = parser.parse_args()
    answers: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        service = Service(Path(folder), arguments.database_url)
        # The longest outlast an outage, the shortest end within it.
        study = Study(service, (3.0, 1.5 * arguments.seconds), arguments.jobs_at_once,
                      random.Random(0))
        service.start()
        try:
            for _ in range(arguments.outages):
                study.run_until(time.monotonic() + AROUND)
                subprocess.run(arguments.stop, shell=True, check=True)
                answers += ask_during(service, arguments.seconds)
                subprocess.run(arguments.start, shell=True, check=True)
                study.run_until(time.monotonic() + AROUND)
            study.finish()
            study.look_again()
        finally:
            service.kill()
    print(table(outcome_of(study), 0, "PostgreSQL"))
    print(f"while it was away: {dict(answers)}")


if __name__ == "__main__":
    main()
