"""Wrong inputs and the message each gets, word for word: docs/wrongInputs.md is what the programs say.

    wrongInputTable.py             fails where the table differs from the programs
    wrongInputTable.py --write     writes the table anew; read what changed before it is kept

Every input leaves with exit code 1 and an untouched case folder. MPM_BUILD_DIR names the build (default: build/).
"""

import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from wrongInput import BINARIES, COLUMN, PROJECT, snapshot
from wrongInputList import GROUPS

TABLE = PROJECT / "docs" / "wrongInputs.md"
HEAD = """# Wrong inputs and what the programs say

Written by `tests/cases/wrongInputTable.py --write`, which runs each of these on a copy of `cases/collapsingSoilColumn`; the test
`cases: wrongInputTable` fails when a program says something else. Every one ends with exit code 1 and leaves the case as
it was. A place `system/gridDict:12` is file and line.
"""


class Wrong(Exception):
    """An input that did not end as it should."""


def fresh(folder, seeded):
    """A copy of the column; `seeded` holds its 0/."""
    folder.mkdir(parents=True)
    for part in ("geometry", "constant", "system"):
        shutil.copytree(COLUMN / part, folder / part)
    if seeded:
        shutil.copytree(seeded / "0", folder / "0")
    return folder


def run(command, folder):
    name, *options = command.split()
    environment = {key: value for key, value in os.environ.items() if not key.startswith("OMP_")}
    while "=" in name:
        key, value = name.split("=")
        environment[key] = value
        name, *options = options
    return subprocess.run([BINARIES / name, *options], cwd=folder, text=True, capture_output=True, timeout=300,
                          stdin=subprocess.DEVNULL, env=environment)


def message_of(entry, folder, seeded):
    """What the program says; any other outcome is a Wrong."""
    case = fresh(folder / "column", seeded if entry.seeded else None)
    if entry.change:
        entry.change(case)
    held = snapshot(folder)
    done = run(entry.command, case)
    where = f"{entry.what}: {entry.command}"
    if done.returncode != 1:
        raise Wrong(f"{where}\nleft with {done.returncode}, expected is 1\n{done.stdout[-1000:]}{done.stderr[-2000:]}")
    if snapshot(folder) != held:
        raise Wrong(f"{where}\nchanged the folder")
    text = re.sub(r"(?m)^libgomp: .*\n|^\n", "", done.stderr).strip()  # OpenMP says of its environment what it likes
    text = re.sub(r"^--> \w+: error: ", "", text)
    if len(text) > 1500 or not text:
        raise Wrong(f"{where}\nsays {len(text)} characters")
    for place in (folder.as_posix(), PROJECT.as_posix(), BINARIES.as_posix(), os.path.expanduser("~")):
        if place in text:
            raise Wrong(f"{where}\nnames a place of this machine: {text}")
    return text


def cell(text):
    return re.sub(r"\s*\n\s*", " ", text).replace("|", r"\|").replace("<", "&lt;").replace("*", r"\*")


def written():
    with tempfile.TemporaryDirectory() as top:
        top = Path(top)
        seeded = fresh(top / "seeded", None)
        done = run("seedParticles", seeded)
        if done.returncode:
            sys.exit(done.stderr)
        entries = [(group, entry) for group, some in GROUPS for entry in some]
        with ThreadPoolExecutor(2) as pool:
            jobs = [pool.submit(message_of, entry, top / str(i), seeded) for i, (_, entry) in enumerate(entries)]
        wrong = [str(job.exception()) for job in jobs if job.exception()]
        if wrong:
            sys.exit("\n\n".join(wrong))
        messages = [job.result() for job in jobs]
    lines, last = HEAD.splitlines(), None
    for (group, entry), message in zip(entries, messages):
        if group != last:
            lines += ["", f"## {group}", "", "| wrong | program | message |", "|---|---|---|"]
            last = group
        lines.append(f"| {cell(entry.what)} | `{entry.command}` | {cell(message)} |")
    return "\n".join(lines + ["", f"{len(entries)} inputs.", ""])


def main():
    text = written()
    if sys.argv[1:] == ["--write"]:
        TABLE.parent.mkdir(exist_ok=True)
        TABLE.write_text(text)
        return
    kept = TABLE.read_text() if TABLE.is_file() else ""
    differences = list(difflib.unified_diff(kept.splitlines(), text.splitlines(), "docs/wrongInputs.md", "the programs",
                                            lineterm="", n=0))
    if differences:
        print("\n".join(differences))
        sys.exit("docs/wrongInputs.md is not what the programs say; if they are right: tests/cases/wrongInputTable.py --write")


if __name__ == "__main__":
    main()
