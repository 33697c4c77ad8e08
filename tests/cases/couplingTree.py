"""What others build against: an installed tree that was moved, the example in C by pkg-config and by find_package, and
the symbols libmpm.so shows.

    couplingTree.py     MPM_BUILD_DIR names the build (default: build/)
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve()
EXAMPLE = PROJECT / "examples" / "c"


def run(*command, cwd=None, code=0, **variables):
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("MPM_", "PKG_CONFIG", "LD_LIBRARY"))}
    done = subprocess.run([str(word) for word in command], cwd=cwd, text=True, capture_output=True, timeout=300,
                          stdin=subprocess.DEVNULL, env={**kept, **variables})
    assert done.returncode == code, f"{command}: exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + (done.stderr if code else "")


class Tree(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        first = cls.folder / "first"
        run("cmake", "--install", BUILD, "--prefix", first, "--component", "coupling")
        cls.home = first.rename(cls.folder / "moved")
        cls.library = next(cls.home.glob("lib/**/libmpm.so.*"))
        cls.column = cls.folder / "column"
        shutil.copytree(PROJECT / "cases" / "collapsingSoilColumn", cls.column,
                        ignore=shutil.ignore_patterns("[0-9]*", "*.png", "postProcessing", "log.*"))
        for file, word, value in (("gridDict", "cellSize", "0.4"), ("seedParticlesDict", "particlesPerCell", "3")):
            path = cls.column / "system" / file
            path.write_text(re.sub(rf"(?m)^({word}\s+)[^;]*", rf"\g<1>{value}", path.read_text()))
        run(BUILD / "bin" / "seedParticles", "-case", cls.column)

    def flags(self, *words):
        return run("pkg-config", *words, "libmpm", PKG_CONFIG_PATH=str(self.library.parent / "pkgconfig")).split()

    def by_pkg_config(self):
        program = self.folder / "byPkgConfig"
        run("cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", EXAMPLE / "pushedWall.c", "-o", program,
            *self.flags("--cflags", "--libs"), "-Wl,-rpath," + self.flags("--variable=libdir")[0])
        return program

    def by_cmake(self):
        build = self.folder / "byCMake"
        run("cmake", "-S", EXAMPLE, "-B", build, f"-DCMAKE_PREFIX_PATH={self.home}")
        run("cmake", "--build", build)
        return build / "pushedWall"

    def copy_of_column(self, name):
        return shutil.copytree(self.column, self.folder / name)

    def test_the_example_runs_the_same_either_way(self):
        said = [run(program, self.copy_of_column(program.name + name), "0.1")
                for name, program in (("1", self.by_pkg_config()), ("2", self.by_cmake()))]
        self.assertEqual(said[0], said[1])
        rows = [[float(word) for word in line.split()] for line in said[0].splitlines()[2:-1]]
        self.assertEqual([row[0] for row in rows], [0.02, 0.04, 0.06, 0.08, 0.1])
        self.assertTrue(all(row[1] < 0 and row[3] == 20 for row in rows), said[0])  # held back by the soil; deltaT 1 ms
        self.assertRegex(said[0], r"work of the wall on the soil: [1-9]")

    def test_the_last_accepted_window_can_be_gone_on_from(self):
        case = self.copy_of_column("goesOn")
        run(self.by_pkg_config(), case, "0.06")
        self.assertTrue((case / "0.06" / "state.h5").exists())
        run(self.by_pkg_config(), case, "0.08")
        self.assertTrue((case / "0.08" / "state.h5").exists())

    def test_what_is_wrong_is_told(self):
        case = self.copy_of_column("wrong")
        schemes = case / "system" / "mpmSchemes"
        schemes.write_text(schemes.read_text().replace("uGIMP;", "uGIMPS;", 1))
        said = run(self.by_pkg_config(), case, code=1)
        self.assertRegex(said, r"mpmSchemes:\d+: .*uGIMPS.*uGIMP")

    def test_dictionaries_find_the_etc_of_the_tree(self):
        etc = self.home / "share" / "libmpm" / "etc"
        etc.mkdir(parents=True)
        (etc / "installed").write_text("../../bin\n")
        (etc / "schemesOfTheTest").write_text("shape uGIMP; stressUpdate MUSL; transfer FLIP; picRate 2;\n")
        case = self.copy_of_column("includes")
        (case / "system" / "mpmSchemes").write_text('#includeEtc "schemesOfTheTest"\n')
        self.assertIn("work of the wall", run(self.by_pkg_config(), case, "0.02"))

    def test_only_the_functions_of_the_header_are_seen(self):
        header = (self.home / "include" / "libmpm" / "mpm.h").read_text()
        declared = set(re.findall(r"\b(mpm_\w+)\(", re.sub(r"/\*.*?\*/", "", header, flags=re.S)))
        shown = {line.split()[-1].split("@")[0] for line in run("nm", "-D", "--defined-only", self.library).splitlines()}
        self.assertEqual(shown - {"MPM_1"}, declared)
        self.assertGreater(len(declared), 35)

    def test_the_tree_names_no_place(self):
        dynamic = run("readelf", "-d", self.library)
        self.assertNotIn(str(BUILD), dynamic)
        self.assertIn(f"[{self.library.name}]", dynamic)  # SONAME
        needed = re.findall(r"NEEDED.*\[(.*)\]", dynamic)
        self.assertFalse([name for name in needed if re.search("gmsh|CGAL|sundials|python", name)], needed)
        for path in self.home.rglob("*"):
            if path.suffix in (".pc", ".cmake", ".h"):
                for place in (BUILD, PROJECT, self.folder):
                    self.assertNotIn(str(place), path.read_text(), path)

    def test_a_missing_library_is_told(self):
        broken = shutil.copytree(self.home, self.folder / "broken", symlinks=True)
        for path in broken.glob("lib/**/libmpm.so*"):
            path.unlink()
        said = run("cmake", "-S", EXAMPLE, "-B", self.folder / "none", f"-DCMAKE_PREFIX_PATH={broken}", code=1)
        self.assertIn("no libmpm.so", said)


if __name__ == "__main__":
    unittest.main()
