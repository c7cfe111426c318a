"""The setting -> roads to plan with."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from app.maps.addresses.addresses import NO_ADDRESSES
from app.maps.addresses.opening import opened_addresses
from app.maps.airspace.files import ZoneFileError, zones_in
from app.maps.roads.building import BuildError, find_build
from app.maps.roads.caching import TableCache
from app.maps.roads.embedded import EmbeddedRoads
from app.maps.roads.engine import RoadEngine
from app.maps.roads.roads import NO_ROADS, Roads
from app.maps.roads.servers import server_engine
from app.maps.roads.setting import Extract, RoadsServer, SettingError, Source, read_setting
from app.maps.roads.tools import ToolsMissingError, find_tools
from app.serving.settings import Settings

CACHE = "roads"
"""Folder, in that for data, of tables answered before."""


def extracts_of(settings: Settings) -> list[Path]:
    """Return the extracts that the settings name; raises as `opened_roads` does."""
    return [source.path for source in _sources(settings).values()
            if isinstance(source, Extract)]


@contextmanager
def opened_roads(settings: Settings) -> Iterator[Roads]:
    """Yield the roads that the settings name; nothing is started yet, and all is ended then.

    Raises
    ------
    SettingError, GeocoderSettingError
        If a setting can't be read, or names what isn't there or prepared.
    """
    sources, addresses = _sources(settings), opened_addresses(settings)
    try:
        zones = zones_in(settings.airspace)
    except ZoneFileError as error:
        raise SettingError(str(error), "TANDEM_AIRSPACE") from error
    if not sources and addresses is NO_ADDRESSES and not zones:
        yield NO_ROADS
        return
    extracts = {source: _embedded(source) for source in sources.values()
                if isinstance(source, Extract)}
    roads = Roads({profile: extracts[source] if isinstance(source, Extract)
                   else _server(source, profile) for profile, source in sources.items()},
                  TableCache(settings.data_dir / CACHE, settings.roads_cache_bytes),
                  {profile: source.url for profile, source in sources.items()
                   if isinstance(source, RoadsServer)},
                  tuple(engine.start for engine in extracts.values()), addresses=addresses,
                  zones=zones)
    try:
        yield roads
    finally:
        roads.close()


def _sources(settings: Settings) -> dict[str, Source]:
    return {} if settings.roads is None else read_setting(settings.roads.get_secret_value())


def _embedded(source: Extract) -> EmbeddedRoads:
    try:
        tools = find_tools()
        return EmbeddedRoads(find_build(source, tools), tools)
    except (BuildError, ToolsMissingError) as error:
        raise SettingError(str(error)) from error


def _server(source: RoadsServer, profile: str) -> RoadEngine:
    try:
        return server_engine(source.kind, source.url, profile)
    except ValueError as error:
        raise SettingError(f"{profile}: {error}") from error
