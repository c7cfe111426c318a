"""Databases, as for jobs."""

from tests.app.jobs.conftest import postgres, settings

__all__ = ["postgres", "settings"]
