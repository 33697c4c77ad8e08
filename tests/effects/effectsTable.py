"""docs/effects.md lists the effects the program has; prices, which are of a machine, are not compared.

    effectsTable.py     MPM_BUILD_DIR names the build (default: build/)
"""

import difflib
import os
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PAGE = PROJECT / "docs" / "effects.md"


def catalogue(page):
    """What stands before the prices."""
    head, mark, _ = page.partition("\n## Prices\n")
    if not mark:
        sys.exit("a page without prices")
    return head.splitlines()


environment = {**os.environ, "MPM_BUILD_DIR": os.environ.get("MPM_BUILD_DIR") or str(PROJECT / "build")}
run = subprocess.run([PROJECT / "etc" / "effectsTable", "--print"], env=environment, capture_output=True, text=True, timeout=300)
if run.returncode != 0:
    sys.exit(run.stdout + run.stderr)
changes = list(difflib.unified_diff(catalogue(PAGE.read_text()), catalogue(run.stdout), "docs/effects.md", "the program", lineterm=""))
if changes:
    sys.exit("\n".join(changes) + "\nrenew docs/effects.md by etc/effectsTable")
for part in ("| in use | share", "| off | adds"):
    if part not in run.stdout:
        sys.exit(f"no table '{part}'")
