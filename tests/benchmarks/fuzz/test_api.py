"""The service at which requests are thrown is alone with its settings."""

from pathlib import Path

import pytest

from benchmarks.fuzz.api import environment_of


def test_service_has_no_settings_of_whoever_starts_it(monkeypatch: pytest.MonkeyPatch,
                                                      tmp_path: Path) -> None:
    # As tests of the service leave it, which then works on no jobs.
    monkeypatch.setenv("TANDEM_ROLE", "api")
    monkeypatch.setenv("TANDEM_ENGINE_LIBRARY", "/somewhere/libtandem.so")
    monkeypatch.setenv("PATH", "/somewhere")
    environment = environment_of(tmp_path)
    assert "TANDEM_ROLE" not in environment
    assert environment["TANDEM_ENGINE_LIBRARY"] == "/somewhere/libtandem.so"
    assert environment["PATH"] == "/somewhere"
    assert environment["TANDEM_DATA_DIR"] == str(tmp_path)
