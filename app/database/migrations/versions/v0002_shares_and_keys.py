"""Whose share of the open jobs a job takes and how much of it; keys apart from ids."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"


def upgrade() -> None:
    """Add the columns; jobs that are open count as what they are."""
    op.add_column("jobs", sa.Column("client", sa.String(200)))
    op.add_column("jobs", sa.Column("plans", sa.Integer, nullable=False, server_default="1"))
    op.add_column("jobs", sa.Column("key", sa.String(36)))
    op.create_index("jobs_by_key", "jobs", ["key"], unique=True)
    jobs = sa.table("jobs", sa.column("id"), sa.column("parent"), sa.column("plans"))
    scenarios = jobs.alias()
    count = (sa.select(sa.func.count()).select_from(scenarios)
             .where(scenarios.c.parent == jobs.c.id).scalar_subquery())
    parents = sa.select(scenarios.c.parent).where(scenarios.c.parent.is_not(None))
    op.execute(jobs.update().where(jobs.c.id.in_(parents)).values(plans=count))


def downgrade() -> None:
    """Drop the columns."""
    op.drop_index("jobs_by_key", "jobs")
    op.drop_column("jobs", "key")
    op.drop_column("jobs", "plans")
    op.drop_column("jobs", "client")
