"""Setup and service of jobs, as the planner times them."""

from collections.abc import Mapping

import numpy as np

from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.nodes import Nodes
from model.dialects.vroom.places import Sites
from model.dialects.vroom.request import Request
from model.dialects.vroom.timing import service_of, setup_of
from model.problem import IntArray


class Actions:
    """How long setup and service of jobs take, in seconds.

    The planner's windows bound the start of service, VROOM's that of setup. Whose setup can't be
    left out, since nothing else is at the same place, has one that is a part of its service. Others
    who may be served at any time have the planner's setup. With windows a setup is planned as if it
    were always needed; or, where that of all at the place takes longer than a window, as the
    planner's, behind windows that open so much later. Both may leave too little time, and never too
    much: the planner's windows can't hang on who comes before.

    The planner's setup is the same for all types of vehicles: what one needs more than the least is
    a part of its way there.
    """

    def __init__(self, request: Request, places: Sites, kinds: tuple[VehicleKind, ...],
                 nodes: Nodes, is_timed: bool) -> None:
        self._nodes = nodes
        types = dict.fromkeys(kind.type for kind in kinds)
        jobs = [request.jobs[job] for job in nodes.jobs]
        self._setup = {name: np.array([setup_of(job, name) for job in jobs], np.int64)
                       for name in types}
        self._service = {name: np.array([service_of(job, name) for job in jobs], np.int64)
                         for name in types}
        used = [*places.jobs.tolist(), *dict.fromkeys(places.starts.tolist())]
        counts = np.bincount(np.array(used, np.int64) + 1, minlength=2)
        is_shared = counts[places.jobs[list(nodes.jobs)] + 1] > 1
        is_open = np.array([job.time_windows is None for job in jobs], np.bool_)
        most: IntArray = np.max(list(self._setup.values()), axis=0)
        shortest = np.array([min((end - begin for begin, end in job.time_windows or ()), default=0)
                             for job in jobs], np.int64)
        all_setups = counts[places.jobs[list(nodes.jobs)] + 1] * most
        self._once = is_shared & (is_open | ((most <= shortest) & (shortest < all_setups)))
        self.opens_later: IntArray = np.where(is_open | ~self._once, 0, most)
        """(job,) than VROOM's its windows do."""
        # Without windows nothing hangs on times.
        self._counts = int(is_timed)
        self._before: Mapping[str, IntArray] = {
            name: np.where(self._once, setup, 0) * self._counts
            for name, setup in self._setup.items()}
        self.setup: IntArray = np.min(list(self._before.values()), axis=0)
        """(job,) unless the task before, or the start, is at the same place."""

    def service(self, name: str) -> IntArray:
        """Return (job,) what is spent by vehicles of a type, whoever was there before."""
        spent: IntArray = self._service[name] + np.where(self._once, 0, self._setup[name])
        return spent * self._counts

    def num_services(self) -> int:
        """Return in how many ways vehicles serve the jobs."""
        return len({self.service(name).tobytes() for name in self._service})

    def delays(self, kind: VehicleKind) -> bool:
        """Tell whether a kind's setup somewhere is more than others'."""
        return bool((self._before[kind.type] > self.setup).any())

    def beside_travel(self, kind: VehicleKind) -> IntArray:
        """Return (node, node) what legs take more, since a kind's setup is more than others'."""
        more = self._before[kind.type] - self.setup
        depots, number = len(self._nodes.depots), len(self._nodes.sites)
        beside = np.zeros((number, number), np.int64)
        beside[:, depots:] = more * self._nodes.changes_place()
        return beside

    def spent(self, kind: VehicleKind) -> IntArray:
        """Return (node, node) the time for setup and service that a leg leads to."""
        depots, number = len(self._nodes.depots), len(self._nodes.sites)
        spent = np.zeros((number, number), np.int64)
        spent[:, depots:] = (self._service[kind.type]
                             + self._setup[kind.type] * self._nodes.changes_place())
        return spent
