"""Days: dispatches become days, which may keep a problem and be planned; events are of any kind."""

import sqlalchemy as sa
from alembic import op

revision = "0010"
down_revision = "0009"

_NUMBERS = ("revision", "asked", "planned", "plan_number")

_TO_EVENTS = """
INSERT INTO day_events (day, number, origin, id, kind, time, received_at, vehicle, step, outcome,
                        reason)
SELECT told.dispatch,
       ROW_NUMBER() OVER (PARTITION BY told.dispatch
                          ORDER BY told.received_at, told.position, told.number),
       CAST(told.position AS VARCHAR(10)), told.id,
       CASE WHEN told.step = 'vehicle' THEN 'vehicle.broken'
            WHEN told.step LIKE '%-depart-%' THEN 'vehicle.departed'
            WHEN told.step LIKE '%-return-%' THEN 'vehicle.arrived'
            WHEN told.step LIKE '%-launch-%' THEN 'drone.launched'
            WHEN told.step LIKE '%-recover-%' THEN 'drone.recovered'
            WHEN told.kind = 'failed' THEN 'vehicle.failed'
            ELSE 'vehicle.served' END,
       told.time, told.received_at, link.vehicle, told.step, told.kind, told.reason
FROM driver_events AS told
JOIN (SELECT dispatch, position, MIN(vehicle) AS vehicle FROM driver_links
      GROUP BY dispatch, position) AS link
  ON link.dispatch = told.dispatch AND link.position = told.position
"""
_REVISIONS = """
UPDATE days SET revision = (SELECT COUNT(*) FROM day_events WHERE day = days.id)
"""
_FROM_EVENTS = """
INSERT INTO driver_events (dispatch, position, id, number, step, kind, time, received_at, reason)
SELECT day, CAST(origin AS INTEGER), id, number, step, outcome, time, received_at, reason
FROM day_events WHERE origin <> ''
"""


def upgrade() -> None:
    """Make the tables, with what dispatches have."""
    op.drop_index("dispatches_by_owner", "dispatches")
    op.drop_index("ix_dispatches_expires_at", "dispatches")
    op.rename_table("dispatches", "days")
    op.add_column("days", sa.Column("name", sa.String(64)))
    op.add_column("days", sa.Column("request", sa.LargeBinary))
    for name in _NUMBERS:
        op.add_column("days", sa.Column(name, sa.BigInteger, nullable=False, server_default="0"))
    op.add_column("days", sa.Column("lease_until", sa.BigInteger))
    op.add_column("days", sa.Column("lease_by", sa.String(36)))
    op.add_column("days", sa.Column("failure", sa.Text))
    op.create_index("days_by_owner", "days", ["owner", "created_at", "id"])
    op.create_index("days_by_name", "days", ["owner", "name"], unique=True)
    op.create_index("ix_days_expires_at", "days", ["expires_at"])
    behind = sa.text("asked > planned")
    op.create_index("days_to_plan", "days", ["id"], sqlite_where=behind, postgresql_where=behind)
    op.create_table(
        "day_events",
        sa.Column("day", sa.String(36), primary_key=True),
        sa.Column("number", sa.BigInteger, primary_key=True, autoincrement=False),
        sa.Column("origin", sa.String(10), nullable=False),
        sa.Column("id", sa.String(64), nullable=False),
        sa.Column("kind", sa.String(20), nullable=False),
        sa.Column("time", sa.BigInteger, nullable=False),
        sa.Column("received_at", sa.BigInteger, nullable=False),
        sa.Column("vehicle", sa.Text),
        sa.Column("step", sa.String(40)),
        sa.Column("outcome", sa.String(10)),
        sa.Column("reason", sa.Text),
        sa.Column("body", sa.Text),
    )
    op.create_index("day_events_by_id", "day_events", ["day", "origin", "id"], unique=True)
    op.execute(_TO_EVENTS)
    op.execute(_REVISIONS)
    op.drop_table("driver_events")


def downgrade() -> None:
    """Drop what dispatches didn't have: days that are planned, and what drivers didn't tell."""
    op.create_table(
        "driver_events",
        sa.Column("dispatch", sa.String(36), primary_key=True),
        sa.Column("position", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("id", sa.String(36), primary_key=True),
        sa.Column("number", sa.Integer, nullable=False),
        sa.Column("step", sa.String(40), nullable=False),
        sa.Column("kind", sa.String(10), nullable=False),
        sa.Column("time", sa.BigInteger, nullable=False),
        sa.Column("received_at", sa.BigInteger, nullable=False),
        sa.Column("reason", sa.Text),
    )
    op.execute("DELETE FROM driver_links WHERE dispatch IN "
               "(SELECT id FROM days WHERE request IS NOT NULL)")
    op.execute("DELETE FROM day_events WHERE day IN "
               "(SELECT id FROM days WHERE request IS NOT NULL)")
    op.execute("DELETE FROM days WHERE request IS NOT NULL")
    op.execute(_FROM_EVENTS)
    op.drop_table("day_events")
    for index in ("days_by_owner", "days_by_name", "ix_days_expires_at", "days_to_plan"):
        op.drop_index(index, "days")
    for name in ("name", "request", *_NUMBERS, "lease_until", "lease_by", "failure"):
        op.drop_column("days", name)
    op.rename_table("days", "dispatches")
    op.create_index("dispatches_by_owner", "dispatches", ["owner", "created_at", "id"])
    op.create_index("ix_dispatches_expires_at", "dispatches", ["expires_at"])
