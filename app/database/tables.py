"""The tables of the service's own database, as this version has them.

`app/database/migrations/versions` leads from those of earlier versions to these.
"""

from sqlalchemy import (
    BigInteger, Boolean, Column, Float, Index, Integer, LargeBinary, MetaData, String, Table, Text,
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
