"""Keys and jobs, as they were before there were versions."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Make the tables that aren't there."""
    _create_keys()
    _create_jobs()
    for name, *columns in (("ix_jobs_parent", "parent"), ("ix_jobs_expires_at", "expires_at"),
                           ("jobs_by_owner", "owner", "created_at", "id"),
                           ("jobs_by_state", "state")):
        op.create_index(name, "jobs", columns, if_not_exists=True)
    for table in ("job_requests", "job_results"):
        op.create_table(
            table,
            sa.Column("job", sa.String(36), primary_key=True),
            sa.Column("body", sa.LargeBinary, nullable=False),
            if_not_exists=True,
        )


def downgrade() -> None:
    """Drop all."""
    for table in ("job_results", "job_requests", "jobs", "api_keys"):
        op.drop_table(table)


def _create_keys() -> None:
    op.create_table(
        "api_keys",
        sa.Column("id", sa.String(12), primary_key=True),
        sa.Column("name", sa.Text, nullable=False),
        sa.Column("digest", sa.LargeBinary(32), nullable=False),
        sa.Column("scopes", sa.String(100), nullable=False),
        sa.Column("created_at", sa.BigInteger, nullable=False),
        sa.Column("revoked_at", sa.BigInteger),
        sa.Column("last_used_at", sa.BigInteger),
        if_not_exists=True,
    )


def _create_jobs() -> None:
    op.create_table(
        "jobs",
        sa.Column("id", sa.String(36), primary_key=True),
        sa.Column("kind", sa.String(10), nullable=False),
        sa.Column("owner", sa.String(200), nullable=False),
        sa.Column("state", sa.String(10), nullable=False),
        sa.Column("parent", sa.String(36)),
        sa.Column("position", sa.Integer),
        sa.Column("fingerprint", sa.String(64), nullable=False),
        sa.Column("webhook", sa.Text),
        sa.Column("created_at", sa.BigInteger, nullable=False),
        sa.Column("started_at", sa.BigInteger),
        sa.Column("finished_at", sa.BigInteger),
        sa.Column("expires_at", sa.BigInteger),
        sa.Column("progress", sa.Float, nullable=False),
        sa.Column("cost", sa.Float),
        sa.Column("search_iterations", sa.BigInteger, nullable=False),
        sa.Column("searched", sa.Float, nullable=False),
        sa.Column("error", sa.Text),
        sa.Column("cancel_requested", sa.Boolean, nullable=False),
        sa.Column("revision", sa.BigInteger, nullable=False),
        sa.Column("improved_revision", sa.BigInteger, nullable=False),
        sa.Column("attempt", sa.Integer, nullable=False),
        sa.Column("crashes", sa.Integer, nullable=False),
        if_not_exists=True,
    )
