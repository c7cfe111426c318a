"""`tandem keys`: makes, lists and revokes API keys."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from enum import StrEnum
from typing import Annotated

import typer

from app.cli.database import database, fail
from app.serving.access.keys import KeyStore

keys_cli = typer.Typer(help="Make, list and revoke API keys.", no_args_is_help=True,
                       add_completion=False)


class ScopeName(StrEnum):
    """`Scope`, as the command line can list it."""

    PLAN = "plan"
    JOBS = "jobs"
    ADMIN = "admin"


Scopes = Annotated[list[ScopeName], typer.Option(
    "--scope", help="What the key may do; repeat it for several. admin reads metrics.")]


@keys_cli.command()
def create(
    name: Annotated[str, typer.Argument(help="Whose key it is, for your own records.")],
    scope: Scopes = [ScopeName.PLAN, ScopeName.JOBS],  # noqa: B006 (it isn't changed)
) -> None:
    """Make a key and print it: only this once."""
    with _key_store() as store:
        key = store.create(name, [one.value for one in scope])
    typer.echo("Keep this key: it can't be shown again.", err=True)
    typer.echo(key)


@keys_cli.command("list")
def list_keys() -> None:
    """List all keys by their id, which is the part between tdm_ and the next underscore."""
    with _key_store() as store:
        keys = store.load()
    typer.echo(f"{'id':12}  {'scopes':15}  {'created':16}  {'last used':16}  {'revoked':16}  name")
    for key in keys.values():
        times = (key.created_at, key.last_used_at, key.revoked_at)
        typer.echo(f"{key.id}  {','.join(sorted(key.scopes)):15}  "
                   + "  ".join(f"{_moment(moment):16}" for moment in times) + f"  {key.name}")


@keys_cli.command()
def revoke(
    key_id: Annotated[str, typer.Argument(metavar="ID", help="As 'tandem keys list' shows it.")],
) -> None:
    """Make a key invalid for good, within a second for services that run."""
    with _key_store() as store:
        is_revoked = store.revoke(key_id)
    if not is_revoked:
        fail(f"There is no valid key with the id {key_id!r}.")
    typer.echo(f"{key_id} is revoked.")


@contextmanager
def _key_store() -> Iterator[KeyStore]:
    """Yield the keys in the database that the settings name."""
    with database() as engine:
        yield KeyStore(engine)


def _moment(seconds: int | None) -> str:
    """Return a time in UTC, to the minute."""
    return "-" if seconds is None else time.strftime("%Y-%m-%d %H:%M", time.gmtime(seconds))
