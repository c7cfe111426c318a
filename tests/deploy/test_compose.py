"""compose.yaml is valid, keeps to this machine and states settings that exist."""

import json
import re
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
import yaml
from compose_spec import PyCompose

from app.serving.access.hosts import TrustedHosts
from app.serving.settings import Settings

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "compose.yaml").read_text("utf-8")
COMPOSE = yaml.safe_load(TEXT)
SERVICES = COMPOSE["services"]

Service = dict[str, Any]


def test_the_file_follows_the_compose_specification() -> None:
    # The parser knows no merge keys, which YAML's own resolves.
    parsed = PyCompose.from_json(json.dumps(COMPOSE))
    assert set(parsed.service_names()) == set(SERVICES)


@pytest.mark.parametrize("name", SERVICES)
def test_services_have_no_privileges_and_a_health_check(name: str) -> None:
    service = SERVICES[name]
    assert service["read_only"] is True
    assert service["cap_drop"] == ["ALL"]
    assert service["security_opt"] == ["no-new-privileges:true"]
    assert service["healthcheck"]["test"][0] == "CMD"
    assert not service.get("privileged", False)


@pytest.mark.parametrize("name", SERVICES)
def test_ports_are_published_on_this_machine_alone(name: str) -> None:
    for port in SERVICES[name].get("ports", []):
        assert port.startswith("127.0.0.1:")


def test_volumes_are_declared_and_folders_exist() -> None:
    for service in SERVICES.values():
        for volume in service.get("volumes", []):
            source = volume.split(":")[0]
            if source.startswith("./"):
                assert (ROOT / source).is_dir()
            else:
                assert source in COMPOSE["volumes"]


def test_settings_exist_and_are_valid(monkeypatch: pytest.MonkeyPatch) -> None:
    ours = {name: service for name, service in SERVICES.items()
            if service["image"] == "tandem-planner"}
    assert set(ours) == {"api", "worker-1", "worker-2"}
    for service in ours.values():
        stated = service["environment"]
        assert {name.removeprefix("TANDEM_").lower() for name in stated} <= set(
            Settings.model_fields)
        for name, value in stated.items():
            monkeypatch.setenv(name, value)
        Settings()


def test_health_checks_and_other_containers_ask_under_trusted_names(
        monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("api", "worker-1", "worker-2"):
        for variable, value in SERVICES[name]["environment"].items():
            monkeypatch.setenv(variable, value)
        trusted = TrustedHosts(Settings().trusted_hosts)
        (url,) = re.findall(r"http://[^']+", " ".join(SERVICES[name]["healthcheck"]["test"]))
        assert trusted.trusts(urlsplit(url).netloc)
        assert trusted.trusts("api:8000")
        for published in SERVICES[name].get("ports", []):
            assert trusted.trusts(published.rpartition(":")[0])


def test_each_worker_has_a_name_of_its_own() -> None:
    names = [service["environment"].get("TANDEM_WORKER_ID") for service in SERVICES.values()
             if service.get("environment", {}).get("TANDEM_ROLE") == "worker"]
    assert len(names) == len(set(names)) == 2
    assert None not in names


def test_grafana_finds_its_dashboards_and_prometheus() -> None:
    provisioning = ROOT / "deploy" / "grafana" / "provisioning"
    (provider,) = yaml.safe_load((provisioning / "dashboards" / "tandem.yaml").read_text())[
        "providers"]
    targets = [volume.split(":")[1] for volume in SERVICES["grafana"]["volumes"]]
    assert provider["options"]["path"] in targets
    (source,) = yaml.safe_load((provisioning / "datasources" / "prometheus.yaml").read_text())[
        "datasources"]
    assert source["url"] == "http://prometheus:9090"
