"""The `tandem` command."""

from importlib import import_module
from typing import Any

import typer
from typer.core import TyperGroup

from app.serving.load.memory import collect_seldom, loading

COMMANDS = {
    "keys": "app.cli.keys:keys_cli",
    "database": "app.cli.database:database_cli",
    "roads": "app.cli.roads:roads_cli",
    "addresses": "app.cli.addresses:addresses_cli",
    "airspace": "app.cli.airspace:airspace_cli",
    "plot": "app.cli.plot:plot",
    "flights": "app.cli.flights:flights",
    "import": "app.cli.importing:import_sheet",
    "serve": "app.cli.serving:serve",
    "settings": "app.cli.settings_page:list_settings",
    "plan": "app.cli.planning:plan",
    "check": "app.cli.planning:check_plan",
    "convert": "app.cli.planning:convert",
}
"""Where each command is. One that plans needn't wait for all that one that serves imports."""


class Commands(TyperGroup):
    """The `COMMANDS`, each imported when it is asked for."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Return the names of all."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Return a command; None if there is none of that name."""
        if cmd_name not in COMMANDS:
            return None
        module, _, name = COMMANDS[cmd_name].partition(":")
        with loading():
            found = getattr(import_module(module), name)
        if not isinstance(found, typer.Typer):
            function, found = found, typer.Typer(add_completion=False)
            found.command(cmd_name)(function)
        command = typer.main.get_command(found)
        command.name = cmd_name
        return command


cli = typer.Typer(cls=Commands, no_args_is_help=True, add_completion=False)


@cli.callback()
def _tandem() -> None:
    """Plan deliveries for trucks that carry drones."""


def main() -> None:
    """Run the command line."""
    collect_seldom()
    cli()
