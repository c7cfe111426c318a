"""Crews that orders ask for -> the vehicles that have them."""

import re
from collections.abc import Iterable, Mapping, Sequence

from app.formats.sheets.cells import Doubt
from app.formats.sheets.customers import Entry
from app.formats.sheets.headings import simple
from app.formats.sheets.vans import Van

_SIZE = re.compile(r"(\d{1,2}) ?([a-z]*)")


def with_crews(served: Iterable[Entry], vans: Sequence[Van]) -> list[Doubt]:
    """Have who asks for a crew, such as `2 men`, served by the vehicles with one. In place."""
    crews = {van.name: simple(van.texts["crew"]) for van in vans if "crew" in van.texts}
    asked: dict[str, str] = {}
    for entry in served:
        allowed = entry.customer.get("vehicles", {}).get("allowed", ())
        named = [name for crew in allowed if crew not in crews for name in _having(crew, crews)]
        if named:
            kept = [name for name in allowed if name in crews]
            entry.customer["vehicles"] = {"allowed": list(dict.fromkeys([*kept, *named]))}
            asked.setdefault(allowed[0], entry.rows[0].cell("vehicles"))
    if not asked:
        return []
    return [Doubt("CREWS", f"Who asks for {', '.join(list(asked)[:10])} is served by vehicles "
                  "with that crew, or more of it.", cell=next(iter(asked.values())))]


def _having(crew: str, crews: Mapping[str, str]) -> list[str]:
    """Return the vehicles that have a crew: the same, or as many people or more."""
    wanted = _SIZE.fullmatch(simple(crew))
    if wanted is None:
        return [name for name, own in crews.items() if own == simple(crew)]
    sizes = {name: _SIZE.fullmatch(own) for name, own in crews.items()}
    return [name for name, own in sizes.items()
            if own and own[2] == wanted[2] and int(own[1]) >= int(wanted[1])]
