"""Keys in the database: random, hashed, revocable."""

import fcntl
import os
import re
import sqlite3
import stat
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from sqlalchemy import Engine

from app.database.connections import FILE_NAME, database_url, make_engine
from app.serving.access.keys import KeyStore, StoredKey, find_key
from app.serving.settings import Settings
from tests.app.conftest import opened
from tests.conftest import PATIENCE

pytestmark = pytest.mark.slow


@pytest.fixture
def engine(tmp_path: Path) -> Iterator[Engine]:
    """Return a new database."""
    with opened(Settings(data_dir=tmp_path / "data")) as engine:
        yield engine


@pytest.fixture
def store(engine: Engine) -> KeyStore:
    """Return a store without keys."""
    return KeyStore(engine)


def test_key_is_found_by_itself_alone(store: KeyStore) -> None:
    ann, bob = (store.create(name, ["plan"]) for name in ("ann", "bob"))
    keys = store.load()
    found = find_key(keys, ann)
    assert found is not None
    assert (found.name, found.scopes) == ("ann", frozenset({"plan"}))
    for wrong in ("", "tdm_", ann[:-1], ann + "0", ann.upper(), ann[:-1] + "é",
                  ann[:17] + bob[17:], ann[:-1] + ("0" if ann[-1] != "0" else "1")):
        assert find_key(keys, wrong) is None, wrong


def test_keys_are_long_random_and_name_their_id(store: KeyStore) -> None:
    keys = [store.create("x", ["plan"]) for _ in range(20)]
    assert len(set(keys)) == 20
    assert all(re.fullmatch(r"tdm_[0-9a-f]{12}_[0-9a-f]{64}", key) for key in keys)
    assert {key.split("_")[1] for key in keys} == set(store.load())


def test_database_holds_no_key(store: KeyStore, tmp_path: Path) -> None:
    key = store.create("ann", ["plan", "jobs"])
    secret = key.rpartition("_")[2]
    for file in (tmp_path / "data").iterdir():
        content = file.read_bytes()
        assert secret.encode() not in content
        assert bytes.fromhex(secret) not in content


def test_data_folder_is_for_its_owner_alone(store: KeyStore, tmp_path: Path) -> None:
    assert stat.S_IMODE((tmp_path / "data").stat().st_mode) == 0o700


def test_revoked_key_is_listed_and_not_found(store: KeyStore) -> None:
    key = store.create("ann", ["plan"])
    (key_id,) = store.load()
    assert store.revoke(key_id)
    assert not store.revoke(key_id)
    assert not store.revoke("unknown")
    assert store.load()[key_id].revoked_at is not None
    assert find_key(store.load(), key) is None


def test_key_needs_a_scope(store: KeyStore) -> None:
    with pytest.raises(ValueError, match="scopes"):
        store.create("ann", [])


def test_every_key_presented_is_hashed_and_compared_once(
        store: KeyStore, monkeypatch: pytest.MonkeyPatch) -> None:
    right = store.create("ann", ["plan"])
    revoked = store.create("bob", ["plan"])
    store.revoke(revoked.split("_")[1])
    keys = store.load()
    compared: list[tuple[int, int]] = []
    compare: Callable[[bytes, bytes], bool] = bytes.__eq__

    def noting(one: bytes, other: bytes) -> bool:
        compared.append((len(one), len(other)))
        return compare(one, other)

    monkeypatch.setattr("hmac.compare_digest", noting)
    presented = (right, revoked, right[:-1] + "x", "tdm_" + "0" * 12 + "_" + "0" * 64, "junk", "")
    found = [find_key(keys, key) is not None for key in presented]
    assert found == [True, False, False, False, False, False]
    assert compared == [(32, 32)] * len(presented)


def test_nobody_has_the_key_that_stands_in_for_unknown_ones() -> None:
    stored = StoredKey("", "", bytes(32), frozenset({"plan"}), 0)
    assert find_key({"": stored}, "") is None


def test_processes_may_make_the_tables_at_once(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path)
    failures: list[Exception] = []

    def start() -> None:
        engine = make_engine(settings.database)
        try:
            KeyStore(engine).create("x", ["plan"])
        except Exception as error:
            failures.append(error)
        finally:
            engine.dispose()

    threads = [threading.Thread(target=start) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    with sqlite3.connect(tmp_path / FILE_NAME) as connection:
        assert connection.execute("SELECT count(*) FROM api_keys").fetchone() == (8,)
    connection.close()


@pytest.fixture
def usual_mask() -> Iterator[None]:
    """Let new files be read by everybody, as is usual."""
    before = os.umask(0o022)
    yield
    os.umask(before)


def modes(folder: Path) -> dict[str, int]:
    """Return the permissions of the database's files."""
    return {path.name: stat.S_IMODE(path.stat().st_mode) for path in folder.glob("*.db*")}


@pytest.mark.usefixtures("usual_mask")
@pytest.mark.parametrize("is_named", [False, True])
def test_a_new_file_is_its_owners_alone(tmp_path: Path, is_named: bool) -> None:
    url = f"sqlite:///{tmp_path / FILE_NAME}" if is_named else None
    tmp_path.chmod(0o755)
    engine = make_engine(Settings(data_dir=tmp_path, database_url=url).database)
    KeyStore(engine).create("ann", ["plan"])
    with engine.connect() as connection:
        connection.exec_driver_sql("SELECT * FROM api_keys").all()
        assert modes(tmp_path) == {f"{FILE_NAME}{end}": 0o600 for end in ("", "-wal", "-shm")}
    engine.dispose()


@pytest.mark.usefixtures("usual_mask")
def test_a_file_of_an_earlier_version_is_closed_and_that_of_others_is_left(tmp_path: Path) -> None:
    ours, theirs = tmp_path / FILE_NAME, tmp_path / "theirs.db"
    for file in (ours, theirs):
        sqlite3.connect(file).close()
        file.touch()
        file.chmod(0o640)
    make_engine(Settings(data_dir=tmp_path).database).dispose()
    make_engine(Settings(database_url=f"sqlite:///{theirs}").database).dispose()
    assert modes(tmp_path) == {FILE_NAME: 0o600, "theirs.db": 0o640}


def test_a_new_file_is_set_up_by_one_at_a_time(tmp_path: Path) -> None:
    engine = make_engine(Settings(data_dir=tmp_path).database)
    descriptor = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(descriptor, fcntl.LOCK_EX)
    with ThreadPoolExecutor(1) as pool:
        connecting = pool.submit(engine.connect)
        with pytest.raises(TimeoutError):
            connecting.result(timeout=0.2)
        os.close(descriptor)
        with connecting.result(PATIENCE) as connection:
            assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == "wal"
    engine.dispose()


@pytest.mark.parametrize(("stated", "driver"), [
    ("postgresql://a:b@host/x", "postgresql+psycopg"), ("postgres://a:b@host/x",
                                                        "postgresql+psycopg"),
    ("postgresql+psycopg://a:b@host/x", "postgresql+psycopg"), ("sqlite:////tmp/x.db", "sqlite")])
def test_urls_get_the_driver_that_is_installed(stated: str, driver: str) -> None:
    assert database_url(Settings(database_url=stated).database).drivername == driver


def test_wrong_url_is_refused_without_its_password() -> None:
    settings = Settings(database_url="hunter2@nothing")
    with pytest.raises(ValueError, match="TANDEM_DATABASE_URL") as caught:
        database_url(settings.database)
    assert "hunter2" not in str(caught.value)
    assert "hunter2" not in repr(settings)
