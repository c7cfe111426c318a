"""Headers on replies, pages of other origins, and who may listen where."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest
from pydantic import ValidationError
from typer.testing import CliRunner

from app.cli.commands import cli
from app.serving.access.headers import SecurityHeaders
from app.serving.access.hosts import TrustedHosts
from app.serving.access.setup import ExposedError, check_exposure
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, ready
from tests.conftest import complete

pytestmark = pytest.mark.slow

ORIGIN = "https://dispatch.example.org"

Serve = Callable[..., httpx.Client]


def policy(reply: httpx.Response) -> dict[str, str]:
    """Return the content security policy by directive."""
    parts = (part.strip().partition(" ")
             for part in reply.headers["content-security-policy"].split(";"))
    return {name: value for name, _, value in parts}


@pytest.mark.parametrize(("method", "path", "status"), [
    ("GET", "/health/live", 200), ("GET", "/nothing", 404), ("GET", "/plan", 405),
    ("POST", "/plan", 400), ("GET", "/docs", 200), ("GET", "/openapi.json", 200),
    ("POST", "/plan?key=x", 400)])
def test_every_reply_has_security_headers(
        client: httpx.Client, method: str, path: str, status: int) -> None:
    reply = client.request(method, path)
    assert reply.status_code == status
    assert reply.headers["x-content-type-options"] == "nosniff"
    assert reply.headers["referrer-policy"] == "no-referrer"
    assert policy(reply)["frame-ancestors"] == "'none'"
    assert policy(reply)["object-src"] == "'none'"
    assert "strict-transport-security" not in reply.headers
    assert "access-control-allow-origin" not in reply.headers


def test_failures_have_security_headers_too(serve: Serve, smallest: dict[str, Any]) -> None:
    class Crashing(FirstFitPlanner):
        def plan(self, *_: Any, **__: Any) -> Any:
            raise ZeroDivisionError

    client = serve(Crashing())
    ready(client)
    reply = client.post("/plan", json=smallest)
    assert reply.status_code == 500
    assert reply.headers["x-content-type-options"] == "nosniff"


def test_plans_are_not_cached(client: httpx.Client, smallest: dict[str, Any]) -> None:
    assert client.post("/plan", json=smallest).headers["cache-control"] == "no-store"


def test_only_the_documentation_may_run_scripts_of_its_page(client: httpx.Client) -> None:
    assert policy(client.get("/docs"))["script-src"] == "'self' 'unsafe-inline'"
    assert policy(client.get("/openapi.json"))["script-src"] == "'self'"


def test_map_tiles_are_allowed_from_where_the_settings_say(serve: Serve) -> None:
    client = serve(FirstFitPlanner(), Settings(tile_url="https://t.example.org/{z}/{x}/{y}.png"))
    images = policy(client.get("/health/live"))["img-src"]
    assert images == "'self' data: blob: https://t.example.org"


def test_https_is_kept_by_browsers_once_it_was_used() -> None:
    async def app(scope: Any, receive: Any, send: Any) -> None:
        await send({"type": "http.response.start", "status": 200,
                    "headers": [(b"X-Frame-Options", b"SAMEORIGIN")]})

    sent: list[Any] = []

    async def send(message: Any) -> None:
        sent.append(message)

    for scheme in ("http", "https"):
        scope = {"type": "http", "path": "/", "scheme": scheme}
        complete(SecurityHeaders(app)(scope, None, send))
    plain, secure = (dict(message["headers"]) for message in sent)
    assert b"strict-transport-security" not in plain
    assert secure[b"strict-transport-security"].startswith(b"max-age=")
    assert secure[b"X-Frame-Options"] == b"SAMEORIGIN"
    assert b"x-frame-options" not in secure


def test_other_origins_are_told_nothing_by_default(client: httpx.Client) -> None:
    preflight = client.options("/plan", headers={
        "Origin": ORIGIN, "Access-Control-Request-Method": "POST"})
    assert "access-control-allow-origin" not in preflight.headers


def test_pages_of_other_origins_may_not_plan(
        client: httpx.Client, smallest: dict[str, Any]) -> None:
    for site in ("cross-site", "same-site"):
        reply = client.post("/plan", json=smallest,
                            headers={"Origin": ORIGIN, "Sec-Fetch-Site": site})
        assert reply.status_code == 403
        assert reply.json()["type"] == "urn:tandem:error:foreign-page"
        assert client.get("/docs", headers={"Sec-Fetch-Site": site}).status_code == 200
    for site in ("same-origin", "none"):
        assert client.post("/plan", json=smallest,
                           headers={"Sec-Fetch-Site": site}).status_code == 200


def test_listed_origins_may_plan(serve: Serve, smallest: dict[str, Any]) -> None:
    client = serve(FirstFitPlanner(), Settings(cors_origins=[ORIGIN]))
    ready(client)
    preflight = client.options("/plan", headers={
        "Origin": ORIGIN, "Access-Control-Request-Method": "POST",
        "Access-Control-Request-Headers": "x-api-key,content-type,idempotency-key"})
    assert preflight.status_code == 200
    assert preflight.headers["access-control-allow-origin"] == ORIGIN
    reply = client.post("/plan", json=smallest,
                        headers={"Origin": ORIGIN, "Sec-Fetch-Site": "cross-site"})
    assert reply.status_code == 200
    assert reply.headers["access-control-allow-origin"] == ORIGIN
    assert "Retry-After" in reply.headers["access-control-expose-headers"]
    other = client.post("/plan", json=smallest, headers={
        "Origin": "https://other.example.org", "Sec-Fetch-Site": "cross-site"})
    assert other.status_code == 403
    assert "access-control-allow-origin" not in other.headers


def test_page_under_a_name_of_its_own_reads_nothing(client: httpx.Client) -> None:
    for path in ("/jobs", "/", "/openapi.json", "/metrics", "/console/config.json"):
        reply = client.get(path, headers={"Host": "turned.example.org:8000"})
        assert (reply.status_code, reply.json()["type"]) == (421, "urn:tandem:error:untrusted-host")
        assert reply.headers["content-type"] == "application/problem+json"
        assert reply.headers["x-content-type-options"] == "nosniff"
    assert client.get("/jobs").status_code == 200


def test_probes_ask_under_whatever_name(client: httpx.Client) -> None:
    for path in ("/health/live", "/health/ready"):
        assert client.get(path, headers={"Host": "turned.example.org"}).status_code == 200


@pytest.mark.parametrize("host", [
    "localhost", "LOCALHOST:8000", "localhost.", "a.localhost", "127.0.0.1:80", "[::1]:8000",
    "192.0.2.7", "[2001:db8::1]", "fleet.example.org", "a.wild.example", "a.b.wild.example:81"])
def test_addresses_and_listed_names_are_trusted(host: str) -> None:
    assert TrustedHosts(["fleet.example.org", "*.wild.example"]).trusts(host)


@pytest.mark.parametrize("host", [
    "", "example.org", "localhost.example.org", "127.0.0.1.example.org", "xfleet.example.org",
    "a.fleet.example.org", "wild.example", "a@127.0.0.1", "127.0.0.1/x", "[::1", "notlocalhost",
    "[::1].evil.com", "[::1].evil.com:8000", "a[::1]", "[[::1]]", "[127.0.0.1", "127.0.0.1]",
    "127.0.0.1:80.evil.com", "localhost:x.evil.com", "[::1]:80:evil.com", "[::1%25.evil.com]",
    "127.0.0.1\\.evil.com", "127.0.0.1#.evil.com", "127.0.0.1 .evil.com", "[v1.evil]"])
def test_other_names_are_not_trusted(host: str) -> None:
    assert not TrustedHosts(["fleet.example.org", "*.wild.example"]).trusts(host)


def test_names_are_the_operators_choice(serve: Serve, tmp_path: Path) -> None:
    def status(host: str, **stated: Any) -> int:
        client = serve(FirstFitPlanner(), Settings(data_dir=tmp_path, **stated))
        return client.get("/docs", headers={"Host": host}).status_code

    assert status("fleet", access="open") == 421
    assert status("fleet", access="open", trusted_hosts=["fleet"]) == 200
    assert status("other", access="open", trusted_hosts=["*"]) == 200
    # A page that was turned to a service with keys has none.
    assert status("fleet", access="keys") == 200
    assert status("fleet", access="keys", trusted_hosts=["other"]) == 421


@pytest.mark.parametrize("name", ["https://a.example", "a.example:80", "a.*.example", "", "a b"])
def test_trusted_hosts_are_names_alone(name: str) -> None:
    with pytest.raises(ValidationError):
        Settings(trusted_hosts=[name])


@pytest.mark.parametrize(("origin", "status"), [
    ("http://fleet.example.org:8000", 200), ("https://fleet.example.org:8000", 200),
    ("http://fleet.example.org", 403), ("http://fleet.example.org:9000", 403),
    ("http://other.example.org:8000", 403), ("null", 403), ("http://[", 403),
    ("http://fleet.example.org:8000.evil.com", 403), ("http://a@fleet.example.org:8000", 403)])
def test_origin_counts_where_browsers_say_nothing_else(
        serve: Serve, smallest: dict[str, Any], origin: str, status: int) -> None:
    client = serve(FirstFitPlanner(), Settings(access="open",
                                               trusted_hosts=["fleet.example.org"]))
    ready(client)
    headers = {"Host": "fleet.example.org:8000", "Origin": origin}
    assert client.post("/plan", json=smallest, headers=headers).status_code == status
    assert client.get("/docs", headers=headers).status_code == 200


def test_origin_of_a_listed_page_counts_over_plain_http(
        serve: Serve, smallest: dict[str, Any]) -> None:
    client = serve(FirstFitPlanner(), Settings(cors_origins=["http://dispatch.local"]))
    ready(client)
    for origin, status in (("http://dispatch.local", 200), ("http://other.local", 403)):
        assert client.post("/plan", json=smallest, headers={"Origin": origin}).status_code == status


@pytest.mark.parametrize("host", ["127.0.0.1", "127.3.2.1", "::1", "localhost"])
def test_loopback_may_be_open(host: str) -> None:
    check_exposure(Settings(), host)


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.1", "2001:db8::1", "example.org", ""])
def test_other_addresses_need_a_decision(host: str) -> None:
    with pytest.raises(ExposedError, match="TANDEM_ACCESS=keys"):
        check_exposure(Settings(), host)
    check_exposure(Settings(access="open"), host)
    check_exposure(Settings(access="keys"), host)


def test_serve_refuses_to_start_open_to_the_network() -> None:
    done = CliRunner().invoke(cli, ["serve", "--host", "0.0.0.0", "--port", "0"])
    assert done.exit_code == 2
    assert "TANDEM_ACCESS=open" in done.output


def test_keys_are_made_listed_and_revoked(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TANDEM_DATA_DIR", str(tmp_path))

    def run(*arguments: str) -> str:
        done = CliRunner().invoke(cli, ["keys", *arguments])
        assert done.exit_code == 0, done.output
        return done.stdout

    key = run("create", "night shift", "--scope", "plan", "--scope", "admin").strip()
    key_id = key.split("_")[1]
    listed = run("list")
    assert key not in listed
    (line,) = (line for line in listed.splitlines() if key_id in line)
    assert "admin,plan" in line
    assert line.endswith("night shift")
    assert key_id in run("revoke", key_id)
    assert CliRunner().invoke(cli, ["keys", "revoke", key_id]).exit_code == 1


def test_database_that_cannot_be_used_is_no_traceback(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TANDEM_DATABASE_URL", "postgresql://ann:secret@127.0.0.1:1/none")
    done = CliRunner().invoke(cli, ["keys", "list"])
    assert done.exit_code == 1
    assert "TANDEM_DATABASE_URL" in done.output
    assert "secret" not in done.output
