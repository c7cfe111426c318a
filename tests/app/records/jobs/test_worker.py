"""What works on jobs, as the database sees it."""

from pathlib import Path

import pytest
from sqlalchemy import text

from app.database.durable import connect
from app.serving.settings import Settings
from tests.app.records.jobs.conftest import serving
from tests.app.records.jobs.stepping import ended, request_of, submit
from tests.conftest import eventually

pytestmark = pytest.mark.slow

SECRET = "whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE="


def test_steps_are_called_as_earlier_versions_called_them(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, role="all", job_slots=2, drain_seconds=0,
                        webhook_secret=SECRET)
    engine = connect(settings.database)

    def steps(workflow: str) -> set[str]:
        query = text("SELECT function_name FROM operation_outputs WHERE workflow_uuid = :id")
        with engine.connect() as connection:
            return set(connection.scalars(query, {"id": workflow}))

    with serving(settings) as client:
        # Nobody listens there, so the address is asked for again.
        job = submit(client, request_of(0.1), params={"webhook": "http://127.0.0.1:1/"})
        ended(client, job)
        call = f"{job}:webhook:0"
        eventually(lambda: len(steps(call)) >= 2)
    assert steps(job) == {"JobEngine._work.<locals>.slice_of_work"}
    assert steps(call) >= {"JobEngine._call", "JobEngine._webhook"}
    engine.dispose()
