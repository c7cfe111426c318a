"""Settings, read from environment variables that begin with `TANDEM_`."""

import os
import re
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, SecretStr
from pydantic_settings import BaseSettings, SettingsConfigDict

from app.database.settings import DatabaseSettings
from app.schemas.limits import (
    DEFAULT_POLICY, MAX_CUSTOMERS, MAX_LEGS, MAX_NUM_SAMPLES, MAX_THREADS, MAX_TIME_LIMIT,
)
from model.engine.cores import num_cores

WEIGHTS_DIR = Path(__file__).resolve().parents[2] / "model" / "weights"

BYTES_PER_CUSTOMER = 15_000
"""What planning holds in memory for a customer where legs are computed."""

BYTES_PER_LEG = 50
"""What planning holds in memory for a leg."""


HOST_NAME = r"^(\*|(\*\.)?[A-Za-z0-9_-]+(\.[A-Za-z0-9_-]+)*)$"
"""What names of hosts look like; an asterisk stands for any."""


def memory_bytes() -> int:
    """Return how much memory this machine, or the container on it, has."""
    machine = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    limit = Path("/sys/fs/cgroup/memory.max")
    stated = limit.read_text().strip() if limit.exists() else "max"
    return machine if stated == "max" else min(machine, int(stated))


def default_data_dir() -> Path:
    """Return the folder for data of the user who runs the service."""
    shared = os.environ.get("XDG_DATA_HOME") or os.path.expanduser("~/.local/share")
    return Path(shared, "tandem")


def _webhook_secret(secret: SecretStr) -> SecretStr:
    """Refuse what is no secret of Standard Webhooks."""
    if re.fullmatch(r"whsec_[A-Za-z0-9+/]{32,100}={0,2}", secret.get_secret_value()) is None:
        raise ValueError("write 'whsec_' and at least 24 random bytes in base64")
    return secret


class Settings(BaseSettings):
    """How the service runs."""

    model_config = SettingsConfigDict(env_prefix="TANDEM_", frozen=True,
                                      hide_input_in_errors=True)

    weights_dir: Path = Field(
        WEIGHTS_DIR, description="Folder with one sub-folder of exported weights per policy."
    )
    policies: tuple[str, ...] = Field(
        (DEFAULT_POLICY, "pointer"), min_length=1, description="Policies to load, as a JSON list."
    )
    max_body_bytes: int = Field(
        32 * 2**20, ge=1, description="Largest accepted request body in bytes."
    )
    max_concurrent_plans: int = Field(
        default_factory=num_cores,
        ge=1,
        description="Plans computed at the same time; further requests wait for their turn. "
        "As many as there are cores, or a container may use.",
    )
    search_threads: int = Field(
        1,
        ge=1,
        le=MAX_THREADS,
        description="Threads of a search when the request states none; no more than this machine "
        "has cores are ever used.",
    )
    roads: SecretStr | None = Field(
        None,
        description="Where legs between places on the globe come from, by the `profile` of vehicle "
        "types: an extract of OpenStreetMap that `tandem roads build` has prepared, or a server, "
        "such as `truck=berlin.osm.pbf,car=osrm:http://localhost:5000`. None: great circles.",
    )
    roads_cache_bytes: int = Field(
        2**30, ge=0, description="Most bytes of road legs kept in `TANDEM_DATA_DIR`, so that plans "
        "for the same places needn't ask for them again. 0: none there."
    )
    geocoder: SecretStr | None = Field(
        None,
        description="Where addresses are looked up, in this order, each asked for what those "
        "before it don't know exactly: extracts of OpenStreetMap that `tandem roads build` or "
        "`tandem addresses build` has prepared, or servers, such as `extract:berlin.osm.pbf,"
        "nominatim:https://nominatim.example.org` (also `photon:` and `pelias:`). None: "
        "addresses are not looked up.",
    )
    airspace: tuple[Path, ...] = Field(
        (), description="Files of airspace zones that hold for all requests on the globe, as "
        "ED-269, ED-318, GeoJSON or KML, as a JSON list such as `[\"/data/zones.json\"]`. They "
        "are read as the service starts (`tandem airspace check`).",
    )
    tile_url: str | None = Field(
        None,
        pattern=r"^https?://[^/]+/.*\{z\}.*",
        description="Address of map tiles for the console, with `{z}`, `{x}` and `{y}`, such as "
        "`https://tiles.example.org/{z}/{x}/{y}.png`. None: no tiles, and no request leaves.",
    )
    tile_attribution: str = Field(
        "", description="Whom the console thanks for map tiles, as plain text."
    )
    log_format: Literal["auto", "json", "console"] = Field(
        "auto", description="Log lines: `json`, `console` (for people) or `auto`, which is "
        "`console` on a terminal and `json` elsewhere.",
    )
    log_level: Literal["debug", "info", "warning", "error"] = Field(
        "info", description="Least urgent log lines to write."
    )
    metrics_open: bool = Field(
        False, description="Whether `/metrics` may be read without a key where keys are needed."
    )
    otlp_endpoint: str | None = Field(
        None,
        pattern="^https?://",
        description="Address of an OpenTelemetry collector for traces (OTLP over HTTP), such as "
        "`http://collector:4318`; needs the packages of the extra `trace`. None: no traces.",
    )
    data_dir: Path = Field(
        default_factory=default_data_dir,
        description="Folder for the service's own data where no database is named. Usually "
        "`~/.local/share/tandem`.",
    )
    database_url: SecretStr | None = Field(
        None,
        description="Database for keys, jobs and kept plans, such as "
        "`postgresql://user:password@host/tandem`. None: an SQLite file in `TANDEM_DATA_DIR`.",
    )
    access: Literal["keys", "open"] | None = Field(
        None,
        description="`keys`: every request needs an API key (`tandem keys create`); `open`: none "
        "does. None: open, and `tandem serve` listens on a loopback address only.",
    )
    plans_per_minute: int = Field(
        0, ge=0, description="Plans a minute for each key, or for each address where access is "
        "open, in each process. 0: no limit.",
    )
    jobs_per_minute: int = Field(
        0, ge=0, description="Jobs a minute for each key or address, in each process. 0: no limit."
    )
    wrong_keys_per_minute: int = Field(
        60, ge=0, description="Wrong keys a minute from one address, in each process, before they "
        "are answered with 429. 0: no limit.",
    )
    driver_requests_per_minute: int = Field(
        120, ge=0, description="Requests a minute with one driver's link, in each process. 0: no "
        "limit.",
    )
    trusted_hosts: tuple[Annotated[str, Field(pattern=HOST_NAME)], ...] = Field(
        (), description="Names by which the service is called where no keys are needed, besides "
        "`localhost` and addresses, as a JSON list such as `[\"tandem.example.org\"]`, without "
        "port; `*.example.org` stands for all names below, `*` for any. Requests for others are "
        "refused with 421. Where keys are needed: any, unless some are listed.",
    )
    cors_origins: tuple[str, ...] = Field(
        (), description="Origins whose pages may call the service, as a JSON list such as "
        '`["https://dispatch.example.org"]`.',
    )
    max_queued_plans: int = Field(
        default_factory=lambda known: 2 * known.get("max_concurrent_plans", 1),
        ge=0,
        description="Plans that may wait while others are computed; what comes beyond is refused "
        "with 503. Usually twice `TANDEM_MAX_CONCURRENT_PLANS`.",
    )
    max_queue_seconds: float = Field(
        2.0, gt=0, description="Longest wait for a plan's turn in seconds, then 503."
    )
    max_customers: int = Field(
        default_factory=lambda: min(MAX_CUSTOMERS, memory_bytes() // 4 // BYTES_PER_CUSTOMER),
        ge=1, le=MAX_CUSTOMERS,
        description="Most customers of a request. Planning holds about 15 kB a customer, besides "
        "tables of legs; usually 100,000, or as many as a quarter of the memory holds.",
    )
    max_num_samples: int = Field(
        MAX_NUM_SAMPLES, ge=1, le=MAX_NUM_SAMPLES,
        description="Largest `options.num_samples` of a request.",
    )
    max_legs: int = Field(
        default_factory=lambda: min(MAX_LEGS, memory_bytes() // 4 // BYTES_PER_LEG),
        ge=1, le=MAX_LEGS,
        description="Most legs of a request: places squared, for each way to travel by speed or "
        "matrix. Planning holds about 50 bytes a leg; usually as many as a quarter of the memory "
        "holds.",
    )
    max_plan_seconds: float = Field(
        60.0, ge=0, le=MAX_TIME_LIMIT,
        description="Largest `options.time_limit` of `POST /plan` in seconds.",
    )
    max_body_seconds: float = Field(
        30.0, gt=0, description="Longest time that a body may take to arrive in seconds, then 408."
    )
    max_buffered_bytes: int = Field(
        256 * 2**20, ge=1, description="Most bytes of bodies in memory at once, in each process; "
        "what comes beyond is refused with 503.",
    )
    drain_seconds: float = Field(
        1.0, ge=0, description="After SIGTERM, how long new requests are answered with 503 before "
        "the port is closed, so that load balancers notice.",
    )
    shutdown_seconds: int = Field(
        10, ge=1, description="Longest time in seconds that requests may take to end after the "
        "port is closed.",
    )
    role: Literal["all", "api", "worker"] = Field(
        "all", description="What this process does: `api` answers requests and takes jobs in, "
        "`worker` works on jobs and answers only for its health and metrics, `all` does both.",
    )
    worker_id: str | None = Field(
        None,
        pattern="^[A-Za-z0-9][A-Za-z0-9_.-]{0,99}$",
        description="Name of this worker, which must be its own and the same again after a "
        "restart, so that it goes on at once with its jobs. None: `local` with SQLite, else the "
        "name of the host.",
    )
    job_slots: int = Field(
        default_factory=lambda known: known.get("max_concurrent_plans", 1),
        ge=1,
        description="Jobs' plans computed at once in each process; the same for all workers. "
        "Usually as many as `TANDEM_MAX_CONCURRENT_PLANS`.",
    )
    region_from: int = Field(
        10_000, ge=2,
        description="Jobs of at least so many customers are planned by regions once there is a "
        "first plan: several at a time, by all workers.",
    )
    region_customers: int = Field(
        2500, ge=1, description="Customers of a region, about; usually 2,000 to 5,000."
    )
    region_seconds: float = Field(
        10.0, ge=0.1, le=MAX_TIME_LIMIT,
        description="Seconds of search for each region, usually 5 to 30, before what was found is "
        "put together and other borders are drawn. Jobs with less than three times as long are "
        "planned whole.",
    )
    max_job_seconds: float = Field(
        MAX_TIME_LIMIT, gt=0, le=MAX_TIME_LIMIT,
        description="Largest `options.time_limit` of a job in seconds.",
    )
    max_open_jobs: int = Field(
        10_000, ge=1, description="Plans that may wait or run as jobs, scenarios included; what "
        "comes beyond is refused with 503.",
    )
    max_scenarios: int = Field(
        500, ge=1, le=10_000, description="Most scenarios of a comparison or sweep."
    )
    max_open_jobs_per_client: int = Field(
        default_factory=lambda known: min(
            known.get("max_open_jobs", 1),
            max(known.get("max_open_jobs", 1) // 4, known.get("max_scenarios", 1))),
        ge=1,
        description="As `TANDEM_MAX_OPEN_JOBS`, for each key, or for each address where access is "
        "open; what comes beyond is refused with 429. Usually a quarter of it, but not below "
        "`TANDEM_MAX_SCENARIOS`.",
    )
    job_expiry_hours: float = Field(
        72.0, gt=0, description="Hours after their end when jobs and their results are deleted."
    )
    max_kept_plans: int = Field(
        1000, ge=0, description="Plans that may be kept by name for each key, or for all who ask "
        "where access is open; beyond that keeping is refused with 409. 0: none may be kept."
    )
    max_kept_bytes: int = Field(
        2**30, ge=0, description="Most bytes of all kept plans of a key, as JSON; the database "
        "holds about a fifth of that. Beyond that keeping is refused with 409.",
    )
    kept_plan_days: float | None = Field(
        None, gt=0, le=36_500, description="Days after their last change when kept plans are "
        "deleted, and the links to them with them. None: they stay until somebody deletes them.",
    )
    public_url: str | None = Field(
        None, pattern=r"^https?://[^/?#]+[^?#]*$",
        description="Address under which drivers reach the service, such as "
        "`https://tandem.example.org`, of which their links are made. None: the one by which the "
        "service was asked for them.",
    )
    dispatch_hours: float = Field(
        24.0, gt=0, le=24 * 366, description="Hours after which drivers' links end where no start "
        "of the plan is stated; else they end at the midnight after the plan, or four "
        "hours after it."
    )
    dispatch_expiry_hours: float = Field(
        72.0, gt=0, le=24 * 366, description="Hours after the end of drivers' links when all that "
        "is kept of the plan is deleted."
    )
    max_dispatches_per_client: int = Field(
        200, ge=1, description="Plans on the road at a time, for each key, or for each address "
        "where access is open; what comes beyond is refused with 429."
    )
    webhook_secret: Annotated[SecretStr, AfterValidator(_webhook_secret)] | None = Field(
        None,
        description="What webhooks are signed with: `whsec_` and at least 24 random bytes in "
        "base64, as Standard Webhooks has it. None: no webhooks are called.",
    )
    webhook_private: bool | None = Field(
        None,
        description="Whether webhooks may be on this machine or in private networks. None: only "
        "where the service itself listens on a loopback address.",
    )
    vroom_seconds: float = Field(
        1.0, gt=0, le=MAX_TIME_LIMIT,
        description="Time limit of `POST /vroom` in seconds where `options` state none.",
    )
    vroom_speeds: dict[str, Annotated[float, Field(ge=1, le=1000)]] = Field(
        {"car": 40.0, "truck": 40.0, "bike": 15.0, "foot": 5.0},
        description="Speeds in km/h of `POST /vroom` by profile, for legs that no matrix states, "
        "as a JSON object.",
    )

    @property
    def database(self) -> DatabaseSettings:
        """Which database this is."""
        return DatabaseSettings(self.database_url, self.data_dir)
