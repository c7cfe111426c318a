"""The planner; knows no HTTP."""

import os

# ONNX Runtime reports usage to its maker unless told not to before it is loaded. A planning
# service calls nobody.
os.environ["ORT_DISABLE_TELEMETRY"] = "1"
