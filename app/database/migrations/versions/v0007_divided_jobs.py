"""Which plans go on by regions, jobs of their own."""

import sqlalchemy as sa
from alembic import op

revision = "0007"
down_revision = "0006"


def upgrade() -> None:
    """Add the column; no plan does so far."""
    op.add_column("jobs", sa.Column("divided", sa.Boolean, nullable=False,
                                    server_default=sa.false()))


def downgrade() -> None:
    """Drop the column, and regions with it: earlier versions plan the whole."""
    for table in ("job_requests", "job_results"):
        op.execute(f"DELETE FROM {table} WHERE job IN "
                   "(SELECT id FROM jobs WHERE kind = 'region')")
    op.execute("DELETE FROM jobs WHERE kind = 'region'")
    op.drop_column("jobs", "divided")
