"""Roads and geocoders that commands plan with."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import typer

from app.cli.file_errors import EXIT_BAD_INPUT
from app.maps.addresses.setting import GeocoderSettingError
from app.maps.roads.opening import opened_roads
from app.maps.roads.roads import Roads
from app.maps.roads.setting import SettingError
from app.serving.settings import Settings


@contextmanager
def roads_of(settings: Settings) -> Iterator[Roads]:
    """Yield roads and geocoders that the settings name; say in words what is wrong with them."""
    with ExitStack() as stack:
        try:
            roads = stack.enter_context(opened_roads(settings))
        except (SettingError, GeocoderSettingError) as error:
            typer.echo(str(error), err=True)
            raise typer.Exit(EXIT_BAD_INPUT) from error
        yield roads
