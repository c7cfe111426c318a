"""A small island with a street, a house and a park, and the extract of the examples."""

from pathlib import Path

import pytest

HELSINKI = Path(__file__).parents[4] / "examples" / "helsinki.osm.pbf"

PLACES = {
    1: (0.001, 0.001), 2: (0.009, 0.001),  # a street
    3: (0.002, 0.002), 4: (0.003, 0.002), 5: (0.003, 0.003), 6: (0.002, 0.003),  # a house
    7: (0.004, 0.004), 8: (0.008, 0.004), 9: (0.008, 0.008), 10: (0.004, 0.008),  # a park
    11: (0.005, 0.005), 12: (0.006, 0.005), 13: (0.006, 0.006),  # a pond in it
    14: (0.0, 0.009), 15: (0.01, 0.009),  # the coast, the sea north of it
}

WAYS = {
    21: ((1, 2), {"highway": "residential"}),
    22: ((3, 4, 5, 6, 3), {"building": "yes"}),
    23: ((7, 8, 9, 10, 7), {}),
    24: ((11, 12, 13, 11), {}),
    25: ((15, 14), {"natural": "coastline"}),
    26: ((1, 99), {"highway": "residential"}),  # whose other end isn't in the extract
    27: ((2, 2), {"railway": "rail"}),
}


def osm_xml() -> str:
    """Return the island as OpenStreetMap's XML."""
    lines = ['<osm version="0.6"><bounds minlat="0" minlon="0" maxlat="0.01" maxlon="0.01"/>']
    lines += [f'<node id="{name}" version="1" lat="{lat}" lon="{lon}"/>'
              for name, (lon, lat) in PLACES.items()]
    for name, (nodes, tags) in WAYS.items():
        inner = [f'<nd ref="{node}"/>' for node in nodes]
        inner += [f'<tag k="{key}" v="{value}"/>' for key, value in tags.items()]
        lines.append(f'<way id="{name}" version="1">{"".join(inner)}</way>')
    lines.append('<relation id="31" version="1"><member type="way" ref="23" role="outer"/>'
                 '<member type="way" ref="24" role="inner"/><tag k="type" v="multipolygon"/>'
                 '<tag k="leisure" v="park"/></relation></osm>')
    return "".join(lines)


@pytest.fixture
def island(tmp_path: Path) -> Path:
    """Return the island's extract."""
    extract = tmp_path / "island.osm"
    extract.write_text(osm_xml())
    return extract
