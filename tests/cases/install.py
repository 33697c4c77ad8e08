"""cmake --install of a portable build: a tree that works where it is put, with every instruction set and no build folder.

    install.py     MPM_BUILD_DIR names the build (default: build-portable/)
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build-portable").resolve()


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        first = Path(folder.name) / "first"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", first], check=True, stdout=subprocess.DEVNULL)
        cls.home = first.rename(Path(folder.name) / "moved")
        cls.share = next(cls.home.glob("share/libmpm"))
        cls.case = Path(folder.name) / "case"

    def shell(self, command, **more):
        kept = {key: value for key, value in os.environ.items() if not key.startswith("MPM_") and key != "GLIBC_TUNABLES"}
        run = subprocess.run(["bash", "-c", command], text=True, capture_output=True, stdin=subprocess.DEVNULL,
                             timeout=300, env={**kept, **more})
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout

    def test_programs_take_the_library_beside_them(self):
        for program in sorted((self.home / "bin").iterdir()):
            with self.subTest(program.name):
                place = re.search(r"libmpmCore\.so => (\S+)", self.shell(f"ldd '{program}'")).group(1)
                self.assertTrue(Path(place).resolve().is_relative_to(self.home), place)
                self.assertNotIn(str(BUILD), self.shell(f"readelf -d '{program}'"))

    def test_all_utilities_and_libraries_are_there(self):
        utilities = {path.name for path in (PROJECT / "utilities").iterdir() if path.is_dir()}
        self.assertEqual({path.name for path in (self.home / "bin").iterdir()}, utilities)
        self.assertEqual(len(list(self.home.glob("lib/**/libmpmCore.so"))), len(list(BUILD.glob("lib/**/libmpmCore.so"))))

    def symbols(self, option, path):
        return {line.split()[-1] for line in self.shell(f"nm -D {option} '{path}'").splitlines()}

    def test_programs_find_all_they_call_in_every_library(self):
        # a type that depends on the instruction set, as Record, would be another name in each library
        for name in ("libmpmCore.so", "libmpmBenchmark.so"):
            first, *others = sorted(self.home.glob(f"lib/**/{name}"), key=lambda path: len(path.parts))
            offered = self.symbols("--defined-only", first)
            called = set().union(*(self.symbols("--undefined-only", path) for path in (self.home / "bin").iterdir()))
            self.assertGreater(len(offered & called), 3)
            for other in others:
                with self.subTest(other.relative_to(self.home)):
                    self.assertEqual((offered & called) - self.symbols("--defined-only", other), set())

    def test_each_instruction_set_can_be_asked_for(self):
        said = [self.shell(f". '{self.share}/etc/bashrc'; mpmSolve -version | grep instructions", MPM_INSTRUCTION_SET=name)
                for name in ("x86-64-v2", "")]
        self.assertEqual(said[0].split(), ["instructions", "x86-64-v2"])
        self.assertTrue(said[1].startswith("    instructions x86-64-v"))

    def test_a_case_runs_from_a_copy(self):
        shutil.copytree(self.share / "cases" / "collapsingSoilColumn", self.case)
        self.assertFalse(list(self.case.glob("log.*")) + list(self.case.glob("0*")))
        control = self.case / "system" / "controlDict"
        control.write_text(re.sub(r"(?m)^(endTime\s+)[^;]*", r"\g<1>0.01", control.read_text()))
        out = self.shell(f". '{self.share}/etc/RunFunctions'; cd '{self.case}'; '{self.share}/etc/bootstrap' || exit 1;"
                         "runApplication seedParticles; runApplication mpmSolve; command -v mpmSolve plotCase")
        self.assertEqual(out.split()[-2:], [str(self.home / "bin" / "mpmSolve"), str(self.share / "etc" / "plotCase")])
        self.assertTrue((self.case / "0.01" / "state.h5").exists())

    def test_dictionaries_find_the_installed_etc_without_a_variable(self):
        include = self.share / "etc" / "soilOfTheTest"
        include.write_text("law linearElastic; density 1; E 1e6; nu 0.3;\n")
        law = self.home / "law"
        law.write_text('#includeEtc "soilOfTheTest"\n')
        self.shell(f"cd '{self.home}' && bin/driveLaw -law law -path triaxial -noPlot")


if __name__ == "__main__":
    unittest.main()
