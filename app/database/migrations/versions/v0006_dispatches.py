"""Plans on the road: links for drivers, and what drivers tell."""

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"


def upgrade() -> None:
    """Make the tables."""
    op.create_table(
        "dispatches",
        sa.Column("id", sa.String(36), primary_key=True),
        sa.Column("owner", sa.String(200), nullable=False),
        sa.Column("client", sa.String(200), nullable=False),
        sa.Column("created_at", sa.BigInteger, nullable=False),
        sa.Column("plan_start", sa.BigInteger, nullable=False),
        sa.Column("ends_at", sa.BigInteger, nullable=False),
        sa.Column("expires_at", sa.BigInteger, nullable=False),
        sa.Column("zone_offset", sa.Integer, nullable=False),
        sa.Column("time_zone", sa.String(100)),
        sa.Column("plan", sa.LargeBinary, nullable=False),
    )
    op.create_index("dispatches_by_owner", "dispatches", ["owner", "created_at", "id"])
    op.create_index("ix_dispatches_expires_at", "dispatches", ["expires_at"])
    op.create_table(
        "driver_links",
        sa.Column("id", sa.String(12), primary_key=True),
        sa.Column("dispatch", sa.String(36), nullable=False),
        sa.Column("position", sa.Integer, nullable=False),
        sa.Column("vehicle", sa.Text, nullable=False),
        sa.Column("digest", sa.LargeBinary(32), nullable=False),
        sa.Column("opened_at", sa.BigInteger),
        sa.Column("revoked_at", sa.BigInteger),
        sa.Column("steps", sa.LargeBinary, nullable=False),
    )
    op.create_index("links_by_dispatch", "driver_links", ["dispatch", "position"])
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


def downgrade() -> None:
    """Drop them."""
    for table in ("driver_events", "driver_links", "dispatches"):
        op.drop_table(table)
