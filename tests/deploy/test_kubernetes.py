"""The manifests fit Kubernetes's schemas, each other and the service."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import kubernetes_validate
import pytest
import yaml

from app.main import create_app
from app.serving.settings import Settings

FOLDER = Path(__file__).parents[2] / "deploy" / "kubernetes"
KUSTOMIZATION = yaml.safe_load((FOLDER / "kustomization.yaml").read_text("utf-8"))

VERSIONS = ("1.29", "1.34")
"""The oldest that all features used are in, and a recent one."""

Manifest = dict[str, Any]


def load() -> Iterator[Manifest]:
    """Yield all manifests."""
    for name in KUSTOMIZATION["resources"]:
        yield from yaml.safe_load_all((FOLDER / name).read_text("utf-8"))


MANIFESTS = {f"{manifest['kind']}/{manifest['metadata']['name']}": manifest for manifest in load()}
WORKLOADS = [manifest for manifest in MANIFESTS.values()
             if manifest["kind"] in ("Deployment", "StatefulSet")]


def container(workload: Manifest) -> Manifest:
    """Return a workload's only container."""
    (only,) = workload["spec"]["template"]["spec"]["containers"]
    return only


def environment(workload: Manifest) -> dict[str, Any]:
    """Return a workload's variables by name, a ConfigMap's included."""
    variables = {item["name"]: item for item in container(workload)["env"]}
    for source in container(workload)["envFrom"]:
        variables |= MANIFESTS[f"ConfigMap/{source['configMapRef']['name']}"]["data"]
    return variables


def test_every_file_is_listed() -> None:
    files = {path.name for path in FOLDER.iterdir()} - {"kustomization.yaml"}
    assert set(KUSTOMIZATION["resources"]) == files


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", MANIFESTS)
def test_manifests_fit_their_schemas(name: str, version: str) -> None:
    kubernetes_validate.validate(MANIFESTS[name], version, strict=True)


@pytest.mark.parametrize("workload", WORKLOADS, ids=lambda workload: workload["kind"])
def test_pods_run_without_privileges_in_bounds(workload: Manifest) -> None:
    pod = workload["spec"]["template"]["spec"]
    assert pod["securityContext"]["runAsNonRoot"] is True
    assert pod["securityContext"]["seccompProfile"]["type"] == "RuntimeDefault"
    assert pod["automountServiceAccountToken"] is False
    assert container(workload)["securityContext"] == {
        "allowPrivilegeEscalation": False, "readOnlyRootFilesystem": True,
        "capabilities": {"drop": ["ALL"]}}
    assert set(container(workload)["resources"]["limits"]) == {"cpu", "memory"}
    volumes = {volume["name"] for volume in pod["volumes"]}
    assert {mount["name"] for mount in container(workload)["volumeMounts"]} == volumes


@pytest.mark.parametrize("workload", WORKLOADS, ids=lambda workload: workload["kind"])
def test_settings_exist_and_are_valid(workload: Manifest) -> None:
    variables = environment(workload)
    stated = {name.removeprefix("TANDEM_").lower() for name in variables}
    assert stated <= set(Settings.model_fields)
    plain = {name: text for name, text in (
        (name, item if isinstance(item, str) else item.get("value"))
        for name, item in variables.items()) if text is not None}
    with pytest.MonkeyPatch.context() as patch:
        for name, text in plain.items():
            patch.setenv(name, text)
        settings = Settings()
    cores = float(container(workload)["resources"]["limits"]["cpu"])
    assert settings.max_concurrent_plans <= cores
    graceful = settings.drain_seconds + settings.shutdown_seconds
    assert workload["spec"]["template"]["spec"]["terminationGracePeriodSeconds"] > graceful


@pytest.mark.parametrize("workload", WORKLOADS, ids=lambda workload: workload["kind"])
def test_probes_ask_for_what_is_there(workload: Manifest) -> None:
    paths = create_app(Settings()).openapi()["paths"]
    ports = {port["name"] for port in container(workload)["ports"]}
    for probe in ("startupProbe", "readinessProbe", "livenessProbe"):
        asked = container(workload)[probe]["httpGet"]
        assert asked["path"] in paths
        assert asked["port"] in ports


def test_selectors_find_their_pods() -> None:
    pods = [workload["spec"]["template"]["metadata"]["labels"] for workload in WORKLOADS]
    for name, manifest in MANIFESTS.items():
        selector = manifest.get("spec", {}).get("selector")
        if selector is not None:
            wanted = selector.get("matchLabels", selector)
            assert sum(wanted.items() <= labels.items() for labels in pods) == 1, name


def test_services_lead_to_ports_that_containers_open() -> None:
    ports = {port["name"] for workload in WORKLOADS for port in container(workload)["ports"]}
    for manifest in MANIFESTS.values():
        if manifest["kind"] == "Service":
            assert {port["targetPort"] for port in manifest["spec"]["ports"]} <= ports


def test_the_autoscaler_scales_the_api() -> None:
    target = MANIFESTS["HorizontalPodAutoscaler/tandem-api"]["spec"]["scaleTargetRef"]
    scaled = MANIFESTS[f"{target['kind']}/{target['name']}"]
    # A number of its own would undo the autoscaler's at each rollout.
    assert "replicas" not in scaled["spec"]


def test_workers_keep_their_names() -> None:
    worker = MANIFESTS["StatefulSet/tandem-worker"]
    identity = environment(worker)["TANDEM_WORKER_ID"]
    assert identity["valueFrom"]["fieldRef"]["fieldPath"] == "metadata.name"
    assert MANIFESTS[f"Service/{worker['spec']['serviceName']}"]["spec"]["clusterIP"] == "None"


@pytest.mark.parametrize("workload", WORKLOADS, ids=lambda workload: workload["kind"])
def test_the_database_is_a_secret(workload: Manifest) -> None:
    assert "secretKeyRef" in environment(workload)["TANDEM_DATABASE_URL"]["valueFrom"]
