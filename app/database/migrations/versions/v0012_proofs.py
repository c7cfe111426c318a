"""Proofs of delivery."""

import sqlalchemy as sa
from alembic import op

revision = "0012"
down_revision = "0011"


def upgrade() -> None:
    """Make the table."""
    op.create_table(
        "day_proofs",
        sa.Column("day", sa.String(36), primary_key=True),
        sa.Column("vehicle", sa.Text, primary_key=True),
        sa.Column("id", sa.String(36), primary_key=True),
        sa.Column("step", sa.String(40), nullable=False),
        sa.Column("orders", sa.Text, nullable=False),
        sa.Column("name", sa.Text, nullable=False),
        sa.Column("time", sa.BigInteger, nullable=False),
        sa.Column("photo", sa.LargeBinary),
        sa.Column("signature", sa.LargeBinary),
    )


def downgrade() -> None:
    """Drop the table, and all proofs."""
    op.drop_table("day_proofs")
