"""Requests whose places are addresses."""

import json
from typing import Any

import pytest
from pydantic_core import to_json

from app.maps.addresses.addresses import Addresses
from app.maps.addresses.geocoder import (
    Candidates, GeocoderError, GeocoderStoppedError, GeocoderUnavailableError,
)
from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.pictures.scene import DrawnPlan
from app.plans.task import Task, task_of
from app.requests.conversion.preparing import Preparing, StoppedError
from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError, NoGeocoderError
from model.planner import PlanOptions
from tests.app.conftest import FirstFitPlanner
from tests.app.maps.addresses.stated import StatedGeocoder, place

KNOWN = {"A 1": (place("A 1, Town", 24.94, 60.17),), "B 2": (place("B 2, Town", 24.95, 60.17),),
         "B": (place("B, Town", 24.96, 60.17, "street"),),
         "Town": (place("Town", 24.90, 60.10, "town"),),
         "C 3": (place("C 3, Town", 24.93, 60.17), place("C 3, Far", 25.93, 60.17)),
         "D 4, Else": (place("D 4, Town", 24.92, 60.17, unmatched=("else",)),),
         "Z 9": (place("Z 9, Abroad", 34.0, 60.17),)}


def request(*customers: str, depot: Any = None, **changes: Any) -> dict[str, Any]:
    """Return a request with customers at these addresses."""
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "d", "location": depot or [24.94, 60.16]}],
        "customers": [{"id": str(number), "location": {"address": address}, "demand": [1]}
                      for number, address in enumerate(customers)],
        "fleet": [{"id": "t", "count": 1, "capacity": [10]}],
        **changes,
    }


def planned(stated: dict[str, Any], error: GeocoderError | None = None,
            known: dict[str, Candidates] | None = None) -> Task:
    roads = Roads({}, addresses=Addresses([StatedGeocoder(known or KNOWN, error)]))
    return task_of(read_request(to_json(stated), None), Preparing(), roads=roads)


def replied(task: Task) -> dict[str, Any]:
    options = PlanOptions("attention", time_limit=0)
    return task.reply(options, task.plan(FirstFitPlanner(), options))


def errors(stated: dict[str, Any]) -> list[tuple[str, str]]:
    with pytest.raises(InvalidRequestError) as refusal:
        planned(stated)
    return [(error.code, error.path) for error in refusal.value.errors]


def test_address_is_as_good_as_its_coordinates() -> None:
    with_points = request("A 1")
    with_points["customers"][0]["location"] = [24.94, 60.17]
    by_points, by_address = replied(planned(with_points)), replied(planned(request("A 1")))
    assert by_address.pop("addresses") == [{
        "path": "$.customers[0].location", "address": "A 1", "location": (24.94, 60.17),
        "label": "A 1, Town", "quality": "house", "by": "stated", "doubt": None}]
    assert "addresses" not in by_points
    assert by_address["routes"] == by_points["routes"]
    assert by_points["summary"]["distance"] > 2000


def test_all_places_may_be_addresses() -> None:
    stated = request("A 1", "B 2", "A 1", depot={"address": "B 2"})
    stated["fleet"][0] |= {"start_location": {"address": "A 1"},
                           "end": {"location": {"address": "B 2"}}}
    assert [(each["path"], each["address"]) for each in replied(planned(stated))["addresses"]] == [
        ("$.depots[0].location", "B 2"), ("$.fleet[0].start_location", "A 1"),
        ("$.fleet[0].end.location", "B 2"), ("$.customers[0].location", "A 1"),
        ("$.customers[1].location", "B 2"), ("$.customers[2].location", "A 1")]


def test_all_addresses_that_are_not_found_are_named_at_once() -> None:
    assert errors(request("A 1", "Nowhere 1", "C 3", "Town", "D 4, Else", "Nowhere 2")) == [
        ("ADDRESS_NOT_FOUND", "$.customers[1].location"),
        ("ADDRESS_AMBIGUOUS", "$.customers[2].location"),
        ("ADDRESS_INEXACT", "$.customers[3].location"),
        ("ADDRESS_NOT_FOUND", "$.customers[4].location"),
        ("ADDRESS_NOT_FOUND", "$.customers[5].location")]


def test_candidates_of_an_ambiguous_address_are_told() -> None:
    with pytest.raises(InvalidRequestError) as refusal:
        planned(request("C 3"))
    message = refusal.value.errors[0].message
    assert "C 3, Town (60.17000, 24.93000); C 3, Far (60.17000, 25.93000)" in message


def test_street_is_taken_and_told_unless_houses_are_asked_for() -> None:
    (told,) = replied(planned(request("B")))["addresses"]
    assert (told["quality"], "street alone" in told["doubt"]) == ("street", True)
    assert errors(request("B", addresses={"accept": "house"})) == [
        ("ADDRESS_INEXACT", "$.customers[0].location")]


def test_likeliest_place_is_taken_if_any_will_do() -> None:
    stated = request("C 3", "Town", "D 4, Else", addresses={"accept": "any"})
    told = replied(planned(stated))["addresses"]
    assert [each["label"] for each in told] == ["C 3, Town", "Town", "D 4, Town"]
    assert all(each["doubt"] for each in told)
    assert errors(request("Nowhere", addresses={"accept": "any"})) == [
        ("ADDRESS_NOT_FOUND", "$.customers[0].location")]


def test_place_far_from_all_others_is_doubted() -> None:
    told = replied(planned(request("A 1", "B 2", "A 1", "Z 9")))["addresses"]
    assert [bool(each["doubt"]) for each in told] == [False, False, False, True]
    assert "far from all other places" in told[3]["doubt"]


def test_doubts_are_warnings_once_for_each_kind() -> None:
    reply = replied(planned(request("A 1", "B", "B", "Z 9", "B 2")))
    assert [(each["code"], each["path"]) for each in reply["warnings"]
            if each["code"].startswith("ADDRESS")] == [
        ("ADDRESS_INEXACT", "$.customers[1].location"), ("ADDRESS_FAR", "$.customers[3].location")]
    assert any("1 more" in each["message"] for each in reply["warnings"])


def test_service_without_geocoder_says_so_at_each_address() -> None:
    with pytest.raises(InvalidRequestError) as refusal:
        task_of(read_request(to_json(request("A 1", "B 2")), None), roads=NO_ROADS)
    assert [(error.code, error.path) for error in refusal.value.errors] == [
        ("NO_GEOCODER", "$.customers[0].location"), ("NO_GEOCODER", "$.customers[1].location")]
    assert "TANDEM_GEOCODER" in refusal.value.errors[0].message


def test_geocoder_that_fails_is_told_with_how_far_it_came() -> None:
    error = GeocoderUnavailableError("The geocoder didn't answer in time.")
    with pytest.raises(NoGeocoderError, match="1 of 2 addresses are known so far") as refusal:
        planned(request("A 1", "Unasked 1"), error)
    assert refusal.value.status == 503


def test_work_that_is_stopped_ends() -> None:
    with pytest.raises(StoppedError):
        planned(request("Unasked 1"), GeocoderStoppedError("Stopped."))


def test_addresses_on_a_plane_are_refused_with_all_other_errors() -> None:
    stated = request("A 1", coordinate_system="planar")
    stated["customers"].append({"id": "0", "location": [1, 2], "demand": [1]})
    with pytest.raises(InvalidRequestError) as refusal:
        read_request(to_json(stated), None)
    assert [(error.code, error.path) for error in refusal.value.errors] == [
        ("DUPLICATE_ID", "$.customers[1].id"), ("ADDRESS_ON_PLANE", "$.customers[0].location")]


@pytest.mark.parametrize(("location", "code", "path"), [
    ({}, "WRONG_TYPE", "$.customers[0].location"),
    ({"lat": 52.5, "lng": 13.4}, "WRONG_TYPE", "$.customers[0].location"),
    ({"address": ""}, "WRONG_LENGTH", "$.customers[0].location.address"),
    ({"address": 5}, "WRONG_TYPE", "$.customers[0].location.address"),
    ({"address": "x", "town": "y"}, "UNKNOWN_FIELD", "$.customers[0].location.town"),
    ({"address": "x" * 501}, "WRONG_LENGTH", "$.customers[0].location.address"),
    ("A 1", "WRONG_TYPE", "$.customers[0].location"),
    ([1, "2"], "WRONG_TYPE", "$.customers[0].location[1]"),
    ([1], "MISSING_FIELD", "$.customers[0].location[1]"),
])
def test_wrong_locations(location: Any, code: str, path: str) -> None:
    stated = request("A 1")
    stated["customers"][0]["location"] = location
    with pytest.raises(InvalidRequestError) as refusal:
        read_request(to_json(stated), None)
    assert [(error.code, error.path) for error in refusal.value.errors] == [(code, path)]


def test_pictures_draw_where_addresses_were_found() -> None:
    stated = request("A 1", depot={"address": "B 2"})
    reply = to_json(replied(planned(stated)))
    drawn = DrawnPlan.replied(read_request(to_json(stated), None), reply)
    assert drawn.layout is not None
    assert json.loads(reply)["addresses"][0]["address"] == "B 2"
