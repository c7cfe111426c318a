"""Plans that are kept by name, and links that show one."""

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"


def upgrade() -> None:
    """Make the tables."""
    op.create_table(
        "kept_plans",
        sa.Column("owner", sa.String(200), primary_key=True),
        sa.Column("id", sa.String(64), primary_key=True),
        sa.Column("name", sa.Text, nullable=False),
        sa.Column("note", sa.Text, nullable=False),
        sa.Column("version", sa.String(16), nullable=False),
        sa.Column("created_at", sa.BigInteger, nullable=False),
        sa.Column("changed_at", sa.BigInteger, nullable=False),
        sa.Column("bytes", sa.BigInteger, nullable=False),
        sa.Column("customers", sa.Integer, nullable=False),
        sa.Column("cost", sa.Float),
    )
    op.create_index("kept_plans_by_owner", "kept_plans", ["owner", "changed_at", "id"])
    op.create_index("ix_kept_plans_changed_at", "kept_plans", ["changed_at"])
    op.create_table(
        "kept_plan_bodies",
        sa.Column("owner", sa.String(200), primary_key=True),
        sa.Column("plan", sa.String(64), primary_key=True),
        sa.Column("body", sa.LargeBinary, nullable=False),
    )
    op.create_table(
        "plan_links",
        sa.Column("id", sa.String(12), primary_key=True),
        sa.Column("owner", sa.String(200), nullable=False),
        sa.Column("plan", sa.String(64), nullable=False),
        sa.Column("digest", sa.LargeBinary(32), nullable=False),
        sa.Column("created_at", sa.BigInteger, nullable=False),
    )
    op.create_index("plan_links_by_plan", "plan_links", ["owner", "plan"])


def downgrade() -> None:
    """Drop them with what they hold."""
    for table in ("plan_links", "kept_plan_bodies", "kept_plans"):
        op.drop_table(table)
