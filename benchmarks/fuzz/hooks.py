"""Keeps generated requests quick: loaded by schemathesis, see `benchmarks.fuzz.api`."""

from typing import Any

import schemathesis

TIME_LIMIT = 0.02


@schemathesis.hook
def map_body(context: schemathesis.HookContext, body: Any) -> Any:
    """Return a body whose plans take no longer than `TIME_LIMIT` seconds."""
    if not isinstance(body, dict):
        return body
    if isinstance(body.get("base"), dict):
        return body | {"base": _quick(body["base"])}
    return _quick(body) if "fleet" in body else body


def _quick(request: dict[str, Any]) -> dict[str, Any]:
    options = request.get("options", {})
    if not isinstance(options, dict):
        return request
    return request | {"options": options | {"time_limit": TIME_LIMIT}}
