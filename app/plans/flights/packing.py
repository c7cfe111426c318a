"""Several files as one ZIP, the same for the same files."""

import zipfile
from collections.abc import Mapping
from io import BytesIO

FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""The earliest date that a ZIP can tell."""


def packed(files: Mapping[str, bytes]) -> bytes:
    """Return a ZIP of files by their names."""
    content = BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, part in files.items():
            archive.writestr(zipfile.ZipInfo(name, FIRST_DAY), part, zipfile.ZIP_DEFLATED)
    return content.getvalue()
