"""Copies of the collapsing column, for tests that run its utilities."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"


class ColumnCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)

    @classmethod
    def seed(cls, **words):
        """The case every fresh() copies, seeded: word = (file, value) changes an entry."""
        cls.seeded = cls.folder / "seeded"
        cls.seeded.mkdir()
        for part in ("geometry", "constant", "system"):
            shutil.copytree(COLUMN / part, cls.seeded / part)
        for word, (file, value) in words.items():
            cls.set(cls.seeded, file, word, value)
        cls.run_utility(cls.seeded, "seedParticles")

    @staticmethod
    def set(case, file, word, value):
        """Gives the entry that begins a line with this word another value."""
        path = case / file
        text, count = re.subn(rf"(?m)^(\s*{word}\s+)[^;]*;", rf"\g<1>{value};", path.read_text())
        assert count == 1, f"{word} in {file}"
        path.write_text(text)

    @classmethod
    def fresh(cls, name):
        shutil.copytree(cls.seeded, cls.folder / name)
        return cls.folder / name

    @staticmethod
    def run_utility(case, name, *options):
        """What it prints; an exit code other than 0 is an error."""
        return subprocess.run([BINARIES / name, *options], cwd=case, check=True, text=True, stdout=subprocess.PIPE,
                              stdin=subprocess.DEVNULL, timeout=600).stdout
