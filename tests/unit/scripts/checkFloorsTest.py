"""etc/checkFloors finds every kind of violation it promises to find, each planted into a clean miniature tree."""

import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[3] / "etc" / "checkFloors"

CLEAN = {
    "libmpm/base/types.hpp": "#pragma once\n#include <array>\n",
    "libmpm/state/particles.hpp": '#pragma once\n#include "base/types.hpp"\n#include <Eigen/Dense>\n',
    "libmpm/dictionary/dictionary.hpp": '#pragma once\n#include "base/types.hpp"\n',
    "libmpm/geometry/gmshMesh.cpp": "#include <gmsh.h>\n",
    "libmpm/geometry/region2D.cpp": "#include <CGAL/Polygon_2.h>\n",
    "libmpm/output/hdf5File.cpp": '#include <hdf5.h>\n#include <sys/stat.h>\n#include "state/particles.hpp"\n',
    "libmpm/reference/cvodeSolver.cpp": "#include <cvode/cvode.h>\n#include <sunmatrix/sunmatrix_dense.h>\n",
    "libmpm/case/application.cpp": "#include <fmt/format.h>\n",
    "utilities/mpmSolve/mpmSolve.cpp": '#include "case/application.hpp"\n#include <fmt/core.h>\n',
    "tests/unit/anyTest.cpp": "#include <catch2/catch.hpp>\nconst char* folder = \"/tmp/scratch\";\n",
    "cases/column/constant/g": "value (0 -9.8 0);\n",
    "etc/bashrc": "#!/usr/bin/env bash\n",
}

# name: (file, its text, what the report must say)
PLANTED = {
    "include upwards": ("libmpm/base/up.hpp", '#pragma once\n#include "state/particles.hpp"\n',
                        'libmpm/base/up.hpp:2: "state/particles.hpp" goes up'),
    "include of a neighbour": ("libmpm/state/side.hpp", '#pragma once\n#include "dictionary/dictionary.hpp"\n',
                               "state/ and dictionary/ lie on the same floor 1"),
    "include not written from libmpm": ("libmpm/base/near.cpp", '#include "types.hpp"\n', "is no file below libmpm/"),
    "folder without floor": ("libmpm/attic/box.hpp", "#pragma once\n", "folder attic/ has no floor"),
    "gmsh elsewhere": ("libmpm/geometry/other.cpp", "#include <gmsh.h>\n", "gmsh may be included only by"),
    "CGAL in a header": ("libmpm/geometry/region2D.hpp", "#pragma once\n#include <CGAL/Polygon_2.h>\n",
                         "CGAL may be included only by"),
    "HDF5 elsewhere": ("libmpm/output/stateFile.cpp", "#include <hdf5.h>\n", "HDF5 may be included only by"),
    "SUNDIALS elsewhere": ("libmpm/state/ode.cpp", "#include <cvode/cvode.h>\n", "SUNDIALS may be included only by"),
    "Boost": ("libmpm/case/caseDirectory.cpp", "#include <boost/program_options.hpp>\n", "nobody owns"),
    "unknown third party": ("libmpm/base/log.cpp", "#include <spdlog/spdlog.h>\n", "nobody owns"),
    "system header in a header": ("libmpm/base/log.hpp", "#pragma once\n#include <unistd.h>\n", "belong into .cpp"),
    "third party in a utility": ("utilities/mpmSolve/more.cpp", "#include <hdf5.h>\n", "HDF5 may be included only by"),
    "missing pragma once": ("libmpm/base/bare.hpp", "struct Bare;\n", "libmpm/base/bare.hpp:1: no #pragma once"),
    "long file": ("libmpm/base/long.cpp", "// line\n" * 401, "401 lines, more than 400"),
    "private path in code": ("libmpm/base/path.cpp", 'const char* p = "/home/me/case";\n', "a path of one machine"),
    "private path in a script": ("etc/script", "cd /tmp/x\n", "etc/script:1: a path of one machine"),
    "private path in a case": ("cases/column/system/controlDict", "include /work/x;\n", "a path of one machine"),
}


def write(top, name, text):
    path = Path(top) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def check(top):
    run = subprocess.run([SCRIPT, top], capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr


class CheckFloors(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = folder.name
        for name, text in CLEAN.items():
            write(self.top, name, text)

    def test_clean_tree_passes(self):
        code, report = check(self.top)
        self.assertEqual(code, 0, report)
        self.assertIn("no violation", report)

    def test_planted_violations_are_found_one_by_one(self):
        for kind, (name, text, message) in PLANTED.items():
            with self.subTest(kind):
                write(self.top, name, text)
                code, report = check(self.top)
                self.assertEqual(code, 1, report)
                self.assertIn(message, report)
                self.assertIn("1 violations", report)
                (Path(self.top) / name).unlink()
                if name.startswith("libmpm/attic"):
                    (Path(self.top) / name).parent.rmdir()

    def test_circle_of_headers_is_found(self):
        write(self.top, "libmpm/base/a.hpp", '#pragma once\n#include "base/b.hpp"\n')
        write(self.top, "libmpm/base/b.hpp", '#pragma once\n#include "base/a.hpp"\n')
        code, report = check(self.top)
        self.assertEqual(code, 1)
        self.assertIn("base/a.hpp -> base/b.hpp -> base/a.hpp", report)

    def test_folder_without_libmpm_is_refused(self):
        with tempfile.TemporaryDirectory() as empty:
            code, report = check(empty)
        self.assertEqual(code, 1)
        self.assertIn("has no folder libmpm/", report)


if __name__ == "__main__":
    unittest.main()
