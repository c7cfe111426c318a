"""Dashboard, alerts and Prometheus's configuration ask for nothing that nobody tells."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import promql_parser
import pytest
import yaml
from prometheus_client.parser import text_string_to_metric_families

from app.serving.observe.metrics import Metrics

DEPLOY = Path(__file__).parents[2] / "deploy"
DASHBOARD = json.loads((DEPLOY / "grafana" / "dashboards" / "tandem.json").read_text("utf-8"))
ALERTS = yaml.safe_load((DEPLOY / "prometheus" / "alerts.yml").read_text("utf-8"))

ADDED_BY_PROMETHEUS = {"instance", "job"}
GRAFANA_VARIABLES = {"$__rate_interval": "5m", "$instance": ".*"}
REPLY = {
    "status": "complete", "unassigned": [], "routes": [{"trips": [{"load_rate": 0.5}]}],
    "solver": {"policy": "attention", "start": "policy", "decoded_cost": 2, "final_cost": 1,
               "search_iterations": 1,
               "elapsed": {"validate": 0, "decode": 0, "search": 0, "check": 0, "total": 0}},
}


@pytest.fixture(scope="module")
def told() -> dict[str, set[str]]:
    """Return the labels of each metric, by name, that a service tells which has seen all."""
    metrics = Metrics("1")
    metrics.count_request("GET", "/plan", 200, 0.1)
    metrics.count_plan(REPLY)
    metrics.count_submitted_job("plan")
    metrics.count_finished_job("plan", "done", 1.0)
    metrics.watch_jobs(lambda: {("plan", "queued"): 1})
    labels: dict[str, set[str]] = {"up": set()}
    for family in text_string_to_metric_families(metrics.render("")[0].decode()):
        for sample in family.samples:
            labels.setdefault(sample.name, set()).update(sample.labels)
    return labels


def panels() -> list[dict[str, Any]]:
    """Return the dashboard's panels, without its headings."""
    return [panel for panel in DASHBOARD["panels"] if panel["type"] != "row"]


def alerts() -> list[dict[str, Any]]:
    """Return all alerts."""
    return [rule for group in ALERTS["groups"] for rule in group["rules"]]


def expressions() -> Iterator[tuple[str, str]]:
    """Yield each query of the dashboard and of the alerts, and where it stands."""
    for panel in panels():
        for target in panel["targets"]:
            expression = target["expr"]
            for variable, value in GRAFANA_VARIABLES.items():
                expression = expression.replace(variable, value)
            yield panel["title"], expression
    for alert in alerts():
        yield alert["alert"], alert["expr"]


def selectors(expression: str) -> list[promql_parser.VectorSelector]:
    """Return the metrics that a query reads."""
    found: list[promql_parser.VectorSelector] = []

    def visit(node: promql_parser.Expr) -> None:
        if isinstance(node, promql_parser.MatrixSelector):
            found.append(node.vector_selector)
        elif isinstance(node, promql_parser.VectorSelector):
            found.append(node)

    promql_parser.walk(promql_parser.parse(expression), visit)
    return found


def grouped_labels(expression: str) -> set[str]:
    """Return the labels that a query groups by."""
    found: set[str] = set()

    def visit(node: promql_parser.Expr) -> None:
        if isinstance(node, promql_parser.AggregateExpr) and node.modifier is not None:
            found.update(node.modifier.labels)

    promql_parser.walk(promql_parser.parse(expression), visit)
    return found


@pytest.mark.parametrize(("place", "expression"), list(expressions()))
def test_every_metric_and_label_asked_for_is_told(
        told: dict[str, set[str]], place: str, expression: str) -> None:
    read = selectors(expression)
    assert read, place
    known = set(ADDED_BY_PROMETHEUS)
    for selector in read:
        assert selector.name in told
        known |= told[selector.name]
        asked = {matcher.name for matcher in selector.matchers.matchers}
        assert asked <= told[selector.name] | ADDED_BY_PROMETHEUS
    assert grouped_labels(expression) <= known


def test_every_metric_of_ours_is_on_the_dashboard(told: dict[str, set[str]]) -> None:
    shown = " ".join(target["expr"] for panel in panels() for target in panel["targets"])
    ours = {re.sub("_(bucket|sum|count|total|created)$", "", name) for name in told
            if name.startswith("tandem_")}
    assert {name for name in ours if name not in shown} == set()


def test_panels_are_named_explained_and_side_by_side() -> None:
    taken: set[tuple[int, int]] = set()
    for panel in DASHBOARD["panels"]:
        place = panel["gridPos"]
        cells = {(x, y) for x in range(place["x"], place["x"] + place["w"])
                 for y in range(place["y"], place["y"] + place["h"])}
        assert place["x"] + place["w"] <= 24
        assert not cells & taken
        taken |= cells
    assert len({panel["id"] for panel in DASHBOARD["panels"]}) == len(DASHBOARD["panels"])
    assert all(panel["title"] and panel["description"] for panel in panels())


def test_alerts_say_how_urgent_they_are_and_what_to_do() -> None:
    names = [alert["alert"] for alert in alerts()]
    assert len(set(names)) == len(names)
    for alert in alerts():
        assert set(alert) <= {"alert", "expr", "for", "labels", "annotations"}
        assert alert["labels"]["severity"] in {"critical", "warning", "info"}
        assert {"summary", "description"} == set(alert["annotations"])


def test_prometheus_reads_the_alerts_and_the_services_of_compose() -> None:
    configuration = yaml.safe_load((DEPLOY / "prometheus" / "prometheus.yml").read_text("utf-8"))
    assert configuration["rule_files"] == ["alerts.yml"]
    (ours,) = (job for job in configuration["scrape_configs"] if job["job_name"] == "tandem")
    services = yaml.safe_load((DEPLOY.parent / "compose.yaml").read_text("utf-8"))["services"]
    assert set(ours["dns_sd_configs"][0]["names"]) <= set(services)
