"""Which customers of a request go together, and which don't."""

from typing import Annotated, Literal

from pydantic import Field

from app.schemas.fields import Input, Name

MAX_RELATED = 1000


class RelationInput(Input):
    """Customers who go together, or no two of whom do. It binds those alone who are served."""

    kind: Literal["together", "apart"] = Field(
        description="Whether one vehicle serves them `together`, or they are kept `apart`."
    )
    customers: Annotated[list[Name], Field(min_length=2, max_length=MAX_RELATED)] = Field(
        description="Ids of customers; ends of shipments are none."
    )
    scope: Literal["vehicle", "trip"] = Field(
        "vehicle",
        description="Whether it says so of one `vehicle` on all its trips, or of one `trip`. "
        "Drones' customers are on the trip that they are launched from.",
    )
