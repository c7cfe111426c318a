"""Which customers of a request go together, which don't, and who is served before whom."""

from typing import Annotated, Literal

from pydantic import Field

from app.schemas.fields import Duration, Input, Name

MAX_RELATED = 1000


class RelationInput(Input):
    """Customers who go together, in an order or none, or no two of whom do.

    It binds those alone who are served.
    """

    kind: Literal["together", "apart", "before"] = Field(
        description="Whether one vehicle serves them `together`, they are served in their order "
        "(`before`), or they are kept `apart`."
    )
    customers: Annotated[list[Name], Field(min_length=2, max_length=MAX_RELATED)] = Field(
        description="Ids of customers, and of ends of shipments, such as `s1/pickup`, which stand "
        "for the shipment where there is no order."
    )
    scope: Literal["vehicle", "trip"] = Field(
        "vehicle",
        description="Whether it says so of one `vehicle` on all its trips, or of one `trip`. "
        "Drones' customers are on the trip that they are launched from.",
    )
    min_lag: Duration = Field(
        0.0,
        description="Of `before`: at least so many seconds lie between the start of service at a "
        "customer and that at all who are named behind. Trucks wait for that.",
    )
    max_lag: Duration | None = Field(
        None, description="Of `before`: at most so many seconds lie between one and the next named."
    )
    same_vehicle: bool = Field(
        True,
        description="Of `before`: whether one vehicle serves them. If not, trucks alone do, any of "
        "them, and wait for those whom others serve before or behind.",
    )
