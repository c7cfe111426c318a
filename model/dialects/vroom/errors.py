"""Why a valid request is refused, in words for whoever sent it."""


class RefusedError(ValueError):
    """A request asks for what the planner can't do."""


class TooLargeError(RefusedError):
    """A request asks for more than there is room for."""
