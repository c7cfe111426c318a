"""Databases, as for jobs."""

from tests.app.records.jobs.conftest import postgres, settings

__all__ = ["postgres", "settings"]
