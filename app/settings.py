"""Settings, read from environment variables that begin with `TANDEM_`."""

import os
from pathlib import Path

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict

DEFAULT_POLICY = "attention"
"""Policy that plans when a request names none."""

MAX_THREADS = 64
"""Most threads of a search that may be asked for."""

WEIGHTS_DIR = Path(__file__).resolve().parent.parent / "model" / "weights"


class Settings(BaseSettings):
    """How the service runs."""

    model_config = SettingsConfigDict(env_prefix="TANDEM_", frozen=True)

    weights_dir: Path = Field(
        WEIGHTS_DIR, description="Folder with one sub-folder of exported weights per policy."
    )
    policies: tuple[str, ...] = Field(
        (DEFAULT_POLICY, "pointer"), min_length=1, description="Policies to load, as a JSON list."
    )
    max_body_bytes: int = Field(
        32 * 2**20, ge=1, description="Largest accepted request body in bytes."
    )
    max_concurrent_plans: int = Field(
        default_factory=lambda: os.cpu_count() or 1,
        ge=1,
        description="Plans computed at the same time; further requests wait for their turn.",
    )
    search_threads: int = Field(
        1,
        ge=1,
        le=MAX_THREADS,
        description="Threads of a search when the request states none; no more than this machine "
        "has cores are ever used.",
    )
