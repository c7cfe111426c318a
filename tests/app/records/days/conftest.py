"""Databases for days."""

from tests.app.records.jobs.conftest import postgres, settings

__all__ = ["postgres", "settings"]
