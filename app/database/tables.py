"""The tables of the service's own database, as this version has them.

`app/database/migrations/versions` leads from those of earlier versions to these.
"""

from sqlalchemy import (
    BigInteger, Boolean, Column, Float, Index, Integer, LargeBinary, MetaData, String, Table, Text,
    false, text,
)

TABLES = MetaData()

KEYS = Table(
    "api_keys", TABLES,
    Column("id", String(12), primary_key=True),
    Column("name", Text, nullable=False),
    Column("digest", LargeBinary(32), nullable=False),
    Column("scopes", String(100), nullable=False),
    # Seconds since 1970.
    Column("created_at", BigInteger, nullable=False),
    Column("revoked_at", BigInteger),
    Column("last_used_at", BigInteger),
)

JOBS = Table(
    "jobs", TABLES,
    Column("id", String(36), primary_key=True),
    Column("kind", String(10), nullable=False),
    Column("owner", String(200), nullable=False),
    Column("state", String(10), nullable=False),
    # Of a scenario: the comparison or sweep, and the scenario's place in it.
    Column("parent", String(36), index=True),
    Column("position", Integer),
    Column("fingerprint", String(64), nullable=False),
    Column("webhook", Text),
    # Milliseconds since 1970.
    Column("created_at", BigInteger, nullable=False),
    Column("started_at", BigInteger),
    Column("finished_at", BigInteger),
    Column("expires_at", BigInteger, index=True),
    Column("progress", Float, nullable=False),
    Column("cost", Float),
    Column("search_iterations", BigInteger, nullable=False),
    Column("searched", Float, nullable=False),  # seconds
    Column("error", Text),
    Column("cancel_requested", Boolean, nullable=False),
    # Raised by each change that clients see; the second one is that of the last lower cost.
    Column("revision", BigInteger, nullable=False),
    Column("improved_revision", BigInteger, nullable=False),
    # Raised when a process takes the job: what an earlier one still writes is refused.
    Column("attempt", Integer, nullable=False),
    Column("crashes", Integer, nullable=False),  # attempts in a row that wrote no progress
    # Who sent the job: a key, or an address where access is open. Scenarios have none.
    Column("client", String(200)),
    Column("plans", Integer, nullable=False, server_default="1"),  # that it stands for
    # Of the owner and the idempotency key, if there is one.
    Column("key", String(36)),
    # What hinders its beginning, since when, and when it is tried again.
    Column("waiting_for", Text),
    Column("waiting_since", BigInteger),
    Column("retry_at", BigInteger),
    # A plan that goes on by regions, which are jobs with it for a parent.
    Column("divided", Boolean, nullable=False, server_default=false()),
    Column("deaths", Integer, nullable=False, server_default="0"),  # of those that planned it
    Index("jobs_by_owner", "owner", "created_at", "id"),
    Index("jobs_by_client", "state", "parent", "client", "plans"),
    Index("jobs_by_key", "key", unique=True),
)

# Apart from JOBS, whose rows are written each second: SQLite writes rows as a whole.
REQUESTS = Table(
    "job_requests", TABLES,
    Column("job", String(36), primary_key=True),
    Column("body", LargeBinary, nullable=False),  # compressed JSON
)
RESULTS = Table(
    "job_results", TABLES,
    Column("job", String(36), primary_key=True),
    Column("body", LargeBinary, nullable=False),  # compressed JSON, of the best plan so far
)

KEPT_PLANS = Table(
    "kept_plans", TABLES,
    # A key, or all who ask where access is open.
    Column("owner", String(200), primary_key=True),
    Column("id", String(64), primary_key=True),
    Column("name", Text, nullable=False),
    Column("note", Text, nullable=False),
    # Another after each change.
    Column("version", String(16), nullable=False),
    # Milliseconds since 1970.
    Column("created_at", BigInteger, nullable=False),
    Column("changed_at", BigInteger, nullable=False, index=True),
    Column("bytes", BigInteger, nullable=False),  # of the body before it is compressed
    Column("customers", Integer, nullable=False),
    Column("cost", Float),
    Column("day", String(36)),  # whose it is, as that stands; null: it is as it was kept
    Index("kept_plans_by_owner", "owner", "changed_at", "id"),
)
KEPT_PLAN_BODIES = Table(
    "kept_plan_bodies", TABLES,
    Column("owner", String(200), primary_key=True),
    Column("plan", String(64), primary_key=True),
    Column("body", LargeBinary, nullable=False),  # compressed JSON, of request and plan
)
PLAN_LINKS = Table(
    "plan_links", TABLES,
    Column("id", String(12), primary_key=True),
    Column("owner", String(200), nullable=False),
    Column("plan", String(64), nullable=False),
    Column("digest", LargeBinary(32), nullable=False),  # see `app.serving.access.tokens`
    Column("created_at", BigInteger, nullable=False),  # milliseconds since 1970
    Index("plan_links_by_plan", "owner", "plan"),
)

DAYS = Table(
    "days", TABLES,
    Column("id", String(36), primary_key=True),
    Column("owner", String(200), nullable=False),
    Column("client", String(200), nullable=False),
    # Milliseconds since 1970.
    Column("created_at", BigInteger, nullable=False),
    Column("plan_start", BigInteger, nullable=False),
    Column("ends_at", BigInteger, nullable=False),
    Column("expires_at", BigInteger, nullable=False, index=True),
    Column("zone_offset", Integer, nullable=False),  # of the plan's start, in minutes
    Column("time_zone", String(100)),
    Column("plan", LargeBinary, nullable=False),  # compressed JSON; empty: none yet
    # Of a day that is planned as it goes on; else a plan was sent out, and others plan on from it.
    Column("name", String(64)),  # that its client gave it
    Column("request", LargeBinary),  # compressed JSON, with which the day began
    # Numbers of the last event, of the last that the client told, and of the last planned for.
    Column("revision", BigInteger, nullable=False, server_default="0"),
    Column("asked", BigInteger, nullable=False, server_default="0"),
    Column("planned", BigInteger, nullable=False, server_default="0"),
    Column("plan_number", BigInteger, nullable=False, server_default="0"),
    # Until when some process plans it, and which; milliseconds since 1970.
    Column("lease_until", BigInteger),
    Column("lease_by", String(36)),
    Column("failure", Text),  # why the last plan failed
    Index("days_by_owner", "owner", "created_at", "id"),
    Index("days_by_name", "owner", "name", unique=True),
    # Processes look often for days whose plan is behind, of which there are few.
    Index("days_to_plan", "id", sqlite_where=text("asked > planned"),
          postgresql_where=text("asked > planned")),
)
LINKS = Table(
    "driver_links", TABLES,
    # The part of the token that is no secret.
    Column("id", String(12), primary_key=True),
    Column("dispatch", String(36), nullable=False),
    Column("position", Integer, nullable=False),
    Column("vehicle", Text, nullable=False),
    Column("name", Text),  # that people call it
    Column("digest", LargeBinary(32), nullable=False),
    Column("opened_at", BigInteger),
    Column("revoked_at", BigInteger),
    Column("steps", LargeBinary, nullable=False),  # compressed JSON
    Column("flights", LargeBinary),  # the same, of its drones; null: none that can be written
    Index("links_by_dispatch", "dispatch", "position"),
)
EVENTS = Table(
    "day_events", TABLES,
    Column("day", String(36), primary_key=True),
    Column("number", BigInteger, primary_key=True, autoincrement=False),  # in order of arrival
    # The position of the driver's link who told it: names of events are its own. Empty: any other.
    Column("origin", String(10), nullable=False),
    Column("id", String(64), nullable=False),
    Column("kind", String(20), nullable=False),
    Column("time", BigInteger, nullable=False),
    Column("received_at", BigInteger, nullable=False),
    # Events belong to the vehicle: a new link in place of a lost one goes on with them.
    Column("vehicle", Text),
    Column("step", String(40)),
    Column("outcome", String(10)),  # of the step
    Column("reason", Text),
    Column("body", Text),  # JSON: what else was told
    Index("day_events_by_id", "day", "origin", "id", unique=True),
)
PROOFS = Table(
    "day_proofs", TABLES,
    Column("day", String(36), primary_key=True),
    Column("vehicle", Text, primary_key=True),
    Column("id", String(36), primary_key=True),  # that the phone gave it
    Column("step", String(40), nullable=False),
    Column("orders", Text, nullable=False),  # JSON: whom it is of
    Column("name", Text, nullable=False),  # of who took it
    Column("time", BigInteger, nullable=False),  # milliseconds since 1970
    Column("photo", LargeBinary),
    Column("signature", LargeBinary),
)
