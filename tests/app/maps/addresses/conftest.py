"""Helsinki's addresses, gathered once."""

import shutil
from pathlib import Path

import pytest

from app.maps.addresses.index import build_index
from app.maps.streets.filing import folder_beside
from tests.app.maps.streets.conftest import HELSINKI


@pytest.fixture(scope="session")
def helsinki(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return Helsinki's extract with its addresses beside it."""
    extract = tmp_path_factory.mktemp("addresses") / HELSINKI.name
    shutil.copy(HELSINKI, extract)
    build_index(extract, [folder_beside(extract)])
    return extract


@pytest.fixture(scope="session")
def helsinki_index(helsinki: Path) -> Path:
    """Return the file with Helsinki's addresses."""
    return build_index(helsinki, [folder_beside(helsinki)])
