FROM python:3.13-slim AS builder

ENV PIP_DISABLE_PIP_VERSION_CHECK=1 \
    PIP_NO_CACHE_DIR=1

RUN apt-get update \
    && apt-get install --yes --no-install-recommends g++ \
    && rm -rf /var/lib/apt/lists/* \
    && python3 -m venv /opt/tandem
WORKDIR /src
COPY pyproject.toml README.md LICENSE zensical.toml ./
COPY docs ./docs
COPY engine ./engine
COPY app ./app
COPY model ./model
RUN /opt/tandem/bin/pip install '.[trace,roads]' \
    && /opt/tandem/bin/python -I -c 'from model.engine.header import interface; interface()' \
    && /opt/tandem/bin/pip uninstall --yes pip
# What of packages nothing here loads: their tests, the runtime and HiGHS once more, for programs in
# C, and OSRM's programs for another way to prepare roads.
RUN cd /opt/tandem/lib/python3*/site-packages \
    && find . -name tests -type d -prune -exec rm -r {} + \
    && rm onnxruntime/capi/libonnxruntime.so.* highspy/libhighs.so.*.* \
        osrm/bin/osrm-components osrm/bin/osrm-customize osrm/bin/osrm-datastore \
        osrm/bin/osrm-partition


FROM python:3.13-slim

RUN useradd --system --uid 10001 --user-group --no-create-home --home-dir /nonexistent \
        --shell /usr/sbin/nologin tandem \
    && install --directory --owner=tandem --group=tandem /data
COPY --from=builder /opt/tandem /opt/tandem

ENV PATH=/opt/tandem/bin:$PATH \
    MPLCONFIGDIR=/tmp/matplotlib \
    ORT_DISABLE_TELEMETRY=1 \
    PYTHONDONTWRITEBYTECODE=1 \
    PYTHONUNBUFFERED=1 \
    TANDEM_ACCESS=keys \
    TANDEM_DATA_DIR=/data

USER tandem
WORKDIR /data
# Without a database elsewhere, keys and jobs are kept here.
VOLUME /data

EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=3s --start-period=30s --retries=3 \
    CMD ["python3", "-c", "import urllib.request as r; r.urlopen('http://127.0.0.1:8000/health/ready', timeout=2)"]
CMD ["tandem", "serve", "--host", "0.0.0.0", "--port", "8000"]
