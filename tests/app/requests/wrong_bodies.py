"""Bodies that are wrong all over or hold far too much, by endpoint, and what it takes to read them.

Run as a program, it reads each in a process of its own and prints as JSON by how many bytes that
grew, how many seconds it took and what came of it.
"""

import json
import os
import resource
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial

from app.formats.vroom.errors import VroomError
from app.formats.vroom.reading import read_request as read_vroom
from app.plans.checking import read_check
from app.plans.explaining import read_explain
from app.records.jobs.reading import JobReader
from app.requests.bounds import UNBOUNDED
from app.requests.reading import read_request
from app.schemas.errors import RequestError
from app.serving.settings import Settings
from tests.seeds import often

SIZE = often(8 * 2**20)

Endless = tuple[bytes, bytes, bytes]
"""How a body begins, what it repeats, and how it ends; `%d` in what it repeats is counted up."""

_LEGS = b"[" + b"0," * 1999 + b"0],"

_NOT_READ = (b'"depots":[],"customers":[],"fleet":[],"replan":{"plan":{"routes":[],'
             b'"legs":[{')

_PRICED = (b'{"id":"%d","location":[0,0],"demand":[1],"vehicle_costs":{'
           + b",".join(b'"v%d":0' % name for name in range(200)) + b"}},")

_PLAN: dict[str, Endless] = {
    "keys of what isn't read": (_NOT_READ, b'"%d":0,', b'"":0}]}}'),
    "prices of what isn't there": (b'"fleet":[],"depots":[],"customers":[', _PRICED,
                                   b'{"id":"","location":[0,0],"demand":[1]}]'),
    "numbers for routes": (b'"replan":{"plan":{"routes":[', b"0,", b"0]}}"),
    "empty routes": (b'"replan":{"plan":{"routes":[', b"{},", b"{}]}}"),
    "routes without trips": (b'"replan":{"plan":{"routes":[',
                             b'{"vehicle":"","type":"","trips":[]},', b"0]}}"),
    "empty trips": (b'"replan":{"plan":{"routes":[{"vehicle":"t-1","type":"t","trips":[',
                    b'{"stops":[]},', b'{"stops":[]}]}]}}'),
    "words for loads": (b'"replan":{"plan":{"routes":[{"vehicle":"t-1","type":"t","trips":[{'
                        b'"stops":[],"load":[', b'"",', b'""]}]}]}}'),
    "what isn't read, lists": (b'"replan":{"plan":{"routes":[],"solver":{"a":[', b"[],", b"0]}}}"),
    "what isn't read, numbers": (b'"replan":{"plan":{"routes":[],"solver":{"a":[', b"0,", b"0]}}}"),
    "what isn't read, keys": (b'"replan":{"plan":{"routes":[],"solver":{', b'"a":{},', b'"b":0}}}'),
    "empty reasons": (b'"replan":{"plan":{"routes":[],"unassigned":[{"id":"a","reasons":[', b"{},",
                      b"{}]}]}}"),
    "numbers for names": (b'"replan":{"plan":{"routes":[]},"pinned":[', b"0,", b"0]}"),
    "empty customers": (b'"customers":[', b"{},", b"{}]"),
    "numbers for customers": (b'"customers":[', b"0,", b"0]"),
    "customers beyond the bound": (b'"customers":[', b'{"id":"1","demand":[1]},', b"0]"),
    "a customer with many fields": (b'"customers":[{', b'"a":0,', b'"b":0}]'),
    "a field many times": (b"", b'"planar_unit":1,', b'"planar_unit":1'),
    "skills without end": (b'"customers":[{"id":"1","demand":[1],"skills":[', b'"a",', b'"b"]}]'),
    "skills that are numbers": (b"", b'"customers":[{"skills":[0,0,0,0]}],', b'"airspace":{}'),
    "hidden routes": (b'"replan":{"plan":{"\\u0072outes":[', b"0,", b"0]}}"),
    "unknown fields": (b"", b'"x":0,', b'"y":0'),
    "unknown lists": (b'"x":[', b"[],", b"0]"),
    "matrices without legs": (b'"matrices":{"truck":{"durations":[', b"[],", b"[]]}}"),
    "rows of words": (b'"matrices":{"truck":{"durations":[', b'["a"],', b"[]]}}"),
    "a row of words": (b'"matrices":{"truck":{"durations":[[', b'"",', b'""]]}}'),
    "a row of zeros": (b'"matrices":{"truck":{"durations":[[', b"0,", b"0]]}}"),
    "legs without places": (b'"matrices":{"truck":{"durations":[', _LEGS, b"[]]}}"),
    "many matrices": (b'"matrices":{', b'"a":{},', b'"b":0}'),
    "numbers for areas": (b'"airspace":{"no_fly":[', b"0,", b"0]}"),
    "areas of numbers": (b'"airspace":{"no_fly":[[', b"0,", b"0]]}"),
    "empty types": (b'"fleet":[', b"{},", b"{}]"),
    "a long name": (b'"coordinate_system":"', b"a", b'"'),
    "a long number": (b'"planar_unit":1', b"1", b""),
    "a long fraction": (b'"planar_unit":0.', b"1", b""),
    "a long exponent": (b'"planar_unit":1e', b"1", b""),
    "a long whole number": (b'"options":{"seed":1', b"1", b"}"),
    "lists in lists": (b'"customers":', b"[", b""),
    "objects in objects": (b'"customers":', b'{"a":', b""),
    "no end": (b'"customers":[0', b",", b""),
    "not finite": (b'"customers":[', b"NaN,", b"-Infinity]"),
}

_VROOM: dict[str, Endless] = {
    "empty jobs": (b'"jobs":[', b"{},", b"{}]"),
    "jobs nowhere": (b'"jobs":[', b'{"id":1},', b'{"id":2}]'),
    "numbers for jobs": (b'"jobs":[', b"0,", b"0]"),
    "empty vehicles": (b'"vehicles":[', b"{},", b"{}]"),
    "shipments": (b'"shipments":[', b"{},", b"{}]"),
    "shipments of lists": (b'"shipments":[[', b"[],", b"[]]]"),
    "breaks": (b'"vehicles":[{"id":1,"breaks":[', b"0,", b"0]}]"),
    "windows": (b'"jobs":[{"id":1,"time_windows":[', b"[0,1],", b"[0,1]]}]"),
    "durations by type": (b'"jobs":[{"id":1,"setup_per_type":{', b'"a":-1,', b'"b":-1}}]'),
    "unknown fields": (b"", b'"x":0,', b'"y":0'),
    "legs without places": (b'"matrix":[', _LEGS, b"[]]"),
    "no legs": (b'"matrix":[', b"[],", b"[]]"),
    "a row of zeros": (b'"matrix":[[', b"0,", b"0]]"),
    "a row of fractions": (b'"matrix":[[', b"0.5,", b"0]]"),
    "lists in lists": (b'"jobs":', b"[", b""),
    "a long whole number": (b'"jobs":[{"id":1', b"1", b"}]"),
}

_CHECK: dict[str, Endless] = {
    "numbers for routes": (b'"plan":{"routes":[', b"0,", b"0]}"),
    "unknown fields": (b"", b'"x":0,', b'"y":0'),
    "empty customers": (b'"problem":{"customers":[', b"{},", b"{}]}"),
    "legs without places": (b'"problem":{"matrices":{"truck":{"durations":[', _LEGS, b"[]]}}}"),
    "stops nowhere": (b'"plan":{"routes":[{"vehicle":"t-1","type":"t","trips":[{"stops":[',
                      b'{"kind":"customer","id":"","arrival":0,"service_start":0,"departure":0},',
                      b"0]}]}]}"),
}

_EXPLAIN: dict[str, Endless] = {
    "a long name": (b'"customer":"', b"a", b'"'),
    "stops nowhere": _CHECK["stops nowhere"],
}

_SWEEP: dict[str, Endless] = {
    "keys": (b'"grid":{', b'"a":0,', b'"b":0}'),
    "values": (b'"grid":{"a":[', b"0,", b"0]}"),
    "lists": (b'"grid":{"a":[', b"[],", b"0]}"),
    "lists in values": (b'"grid":{"a":[[', b"[],", b"0]]}"),
    "unknown fields": (b"", b'"x":0,', b'"y":0'),
    "legs without places": (b'"base":{"matrices":{"truck":{"durations":[', _LEGS, b"[]]}}}"),
    "empty customers in the base": (b'"base":{"customers":[', b"{},", b"{}]}"),
    "numbers for routes in the base": (b'"base":{"replan":{"plan":{"routes":[', b"0,", b"0]}}}"),
}

_COMPARE: dict[str, Endless] = {
    "fleets of nothing": (b'"fleets":{', b'"a":[],', b'"b":[]}'),
    "numbers for fleets": (b'"fleets":{', b'"a":0,', b'"b":0}'),
    "empty types": (b'"fleets":{"a":[', b"{},", b"{}]}"),
    "numbers for routes in the base": (b'"base":{"replan":{"plan":{"routes":[', b"0,", b"0]}}}"),
}

SHAPES = {"plan": _PLAN, "vroom": _VROOM, "check": _CHECK, "explain": _EXPLAIN, "sweep": _SWEEP,
          "compare": _COMPARE}


def body_of(shape: Endless, size: int) -> bytes:
    """Return a body of a size."""
    begin, unit, end = shape
    many = size // len(unit)
    middle = b"".join(unit % index for index in range(many)) if b"%d" in unit else unit * many
    return b"{" + begin + middle + end + b"}"


def readers() -> dict[str, Callable[[bytes], object]]:
    """Return what reads the bodies of each endpoint."""
    jobs = JobReader(["attention"], Settings())
    return {
        "plan": lambda body: read_request(body, None),
        "vroom": lambda body: read_vroom(body, 10_000, 10_000),
        "check": lambda body: read_check(body, UNBOUNDED),
        "explain": lambda body: read_explain(body, UNBOUNDED),
        "sweep": partial(jobs.validate, "sweep"),
        "compare": partial(jobs.validate, "compare"),
    }


def measured(read: Callable[[bytes], object], body: bytes) -> tuple[int, float, str]:
    """Return the bytes and seconds that reading takes in a process of its own, and what comes."""
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        began = time.process_time()
        try:
            read(body)
            outcome = "read"
        except (RequestError, VroomError) as error:
            outcome = f"{error}"[:80]
        grown = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
        os.write(theirs, json.dumps([grown, time.process_time() - began, outcome]).encode())
        os._exit(0)
    os.close(theirs)
    told = b"".join(iter(lambda: os.read(ours, 4096), b""))
    os.close(ours)
    os.waitpid(child, 0)
    grown, seconds, outcome = json.loads(told)
    return grown, seconds, outcome


def main(size: int) -> Iterator[str]:
    """Yield a line for each body: endpoint, shape, bytes, growth in bytes, seconds, outcome."""
    for endpoint, read in readers().items():
        for name, shape in SHAPES[endpoint].items():
            body = body_of(shape, size)
            yield json.dumps([endpoint, name, len(body), *measured(read, body)])


if __name__ == "__main__":
    for line in main(int(sys.argv[1]) if len(sys.argv) > 1 else SIZE):
        print(line, flush=True)
