"""Proofs of delivery: who took it, a photo and a signature, as a phone tells them."""

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import AwareDatetime, Base64Bytes, Field, StringConstraints, field_validator
from pydantic_core import PydanticCustomError, from_json, to_json
from sqlalchemy import Engine, func, insert, select

from app.database.tables import PROOFS
from app.records.clock import now_ms
from app.records.dispatches.driving import clock_error, open_or_over
from app.records.dispatches.errors import TooManyProofsError, UnknownProofError
from app.records.dispatches.instants import milliseconds
from app.records.dispatches.rows import DayRow
from app.records.dispatches.schemas import DriverInput, ProofReply
from app.records.dispatches.store import DispatchStore

MAX_PHOTO, MAX_SIGNATURE = 400_000, 100_000
"""Bytes of each."""

MAX_PROOFS = 500
"""Most proofs of a vehicle's day."""

Part = Literal["photo", "signature"]

_BEGINNINGS = {b"\xff\xd8\xff": "image/jpeg", b"\x89PNG\r\n\x1a\n": "image/png"}


def kind_of(picture: bytes) -> str | None:
    """Return the type of a picture by how it begins, None if it is neither JPEG nor PNG."""
    return next((kind for begins, kind in _BEGINNINGS.items() if picture.startswith(begins)), None)


class ProofInput(DriverInput):
    """A proof that something was delivered."""

    id: Annotated[str, Field(min_length=1, max_length=36, pattern="^[A-Za-z0-9-]+$")] = Field(
        description="A name that is this proof's own: sent again it counts once.")
    step: Annotated[str, Field(min_length=1, max_length=40)] = Field(
        description="Id of the step.")
    now: AwareDatetime = Field(description="The sender's clock now.")
    time: AwareDatetime = Field(description="When it was taken, by the sender's clock.")
    name: Annotated[str, StringConstraints(strip_whitespace=True, max_length=100)] = Field(
        "", description="Of who took it.")
    photo: Base64Bytes | None = Field(
        None, description=f"JPEG or PNG in base64, at most {MAX_PHOTO} bytes.")
    signature: Base64Bytes | None = Field(
        None, description=f"The same, at most {MAX_SIGNATURE} bytes.")

    @field_validator("photo", "signature")
    @classmethod
    def _is_picture(cls, picture: bytes | None) -> bytes | None:
        """Refuse what is no picture."""
        if picture is not None and kind_of(picture) is None:
            raise PydanticCustomError("WRONG_TYPE", "It is neither JPEG nor PNG: send one of them.")
        return picture

    @field_validator("photo")
    @classmethod
    def _is_small(cls, picture: bytes | None) -> bytes | None:
        """Refuse a large photo."""
        return _bounded(picture, MAX_PHOTO)

    @field_validator("signature")
    @classmethod
    def _is_line(cls, picture: bytes | None) -> bytes | None:
        """Refuse a large signature."""
        return _bounded(picture, MAX_SIGNATURE)


def _bounded(picture: bytes | None, most: int) -> bytes | None:
    if picture is not None and len(picture) > most:
        raise PydanticCustomError("OUT_OF_RANGE", "It has more than {most} bytes: make it smaller.",
                                  {"most": most})
    return picture


def keep_proof(engine: Engine, token: str, proof: ProofInput) -> list[ProofReply]:
    """Keep a proof that isn't there yet; return those of the vehicle. In place.

    Raises
    ------
    UnknownLinkError, LinkOverError
        If the token is none, or its link was revoked.
    TooManyProofsError
        If there are too many.
    """
    store = DispatchStore(engine)
    link, dispatch = open_or_over(store, token)
    steps = {step.id: step for step in store.steps(link.id)}
    orders = [each.id for each in steps[proof.step].customers] if proof.step in steps else []
    mine = (PROOFS.c.day == dispatch.id, PROOFS.c.vehicle == link.vehicle)
    now = now_ms()
    time = min(milliseconds(proof.time) + clock_error(proof.now, now), now)
    with engine.begin() as connection:
        there = set(connection.scalars(select(PROOFS.c.id).where(*mine)))
        if len(there) >= MAX_PROOFS:
            raise TooManyProofsError(MAX_PROOFS)
        if proof.id not in there:
            connection.execute(insert(PROOFS).values(
                day=dispatch.id, vehicle=link.vehicle, id=proof.id, step=proof.step,
                orders=to_json(orders).decode(), name=proof.name, time=time,
                photo=proof.photo, signature=proof.signature))
    return proofs_of(engine, dispatch, link.vehicle)


def proofs_of(engine: Engine, dispatch: DayRow,
              vehicle: str | None = None) -> list[ProofReply]:
    """Return the proofs of a dispatch, or of one of its vehicles, the youngest first."""
    statement = select(
        PROOFS.c.id, PROOFS.c.vehicle, PROOFS.c.step, PROOFS.c.orders, PROOFS.c.name,
        PROOFS.c.time, func.length(PROOFS.c.photo), func.length(PROOFS.c.signature),
    ).where(PROOFS.c.day == dispatch.id).order_by(PROOFS.c.time.desc(), PROOFS.c.id)
    if vehicle is not None:
        statement = statement.where(PROOFS.c.vehicle == vehicle)
    with engine.connect() as connection:
        rows: Sequence[tuple[str, str, str, str, str, int, int | None, int | None]] = [
            tuple(row) for row in connection.execute(statement)]
    return [ProofReply(id=name, vehicle=by, step=step, orders=from_json(orders), name=who,
                       time=(time - dispatch.plan_start) / 1000, photo=bool(photo),
                       signature=bool(signature))
            for name, by, step, orders, who, time, photo, signature in rows]


def picture_of(engine: Engine, dispatch: DayRow, vehicle: str, proof: str,
               part: Part) -> tuple[bytes, str]:
    """Return a picture of a proof and its type.

    Raises
    ------
    UnknownProofError
        If there is none.
    """
    with engine.connect() as connection:
        picture = connection.scalar(select(PROOFS.c[part]).where(
            PROOFS.c.day == dispatch.id, PROOFS.c.vehicle == vehicle, PROOFS.c.id == proof))
    kind = None if picture is None else kind_of(picture)
    if picture is None or kind is None:
        raise UnknownProofError
    return picture, kind
