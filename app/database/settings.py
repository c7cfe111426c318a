"""Which database the service has."""

from dataclasses import dataclass
from pathlib import Path

from pydantic import SecretStr


@dataclass(frozen=True)
class DatabaseSettings:
    """Where the database is."""

    url: SecretStr | None  # None: a file in the data folder
    data_dir: Path
