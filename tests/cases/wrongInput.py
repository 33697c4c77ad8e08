"""What utilities do with wrong input: exit code 1, the place (file:line), what was found, what is allowed, and not one
file in the case folder made, changed or removed.

    wrongInput.py [WrongInput.test_name ...]      MPM_BUILD_DIR names the build (default: build/)
"""

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"
NOBODY = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]


def snapshot(folder):
    """Every file and folder with its content."""
    return {path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
            for path in sorted(folder.rglob("*"))}


class WrongInput(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name) / "column"
        self.case.mkdir()
        for part in ("geometry", "constant", "system"):
            shutil.copytree(COLUMN / part, self.case / part)

    # helpers

    def run_utility(self, name, *options, before=()):
        return subprocess.run([*before, BINARIES / name, *options], cwd=self.case, text=True, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=300)

    def seed(self):
        run = self.run_utility("seedParticles")
        self.assertEqual(run.returncode, 0, run.stderr)

    def break_line(self, file, old, new):
        """Replaces text in a file of the case; returns "file:line" of the change."""
        path = self.case / file
        text = path.read_text()
        self.assertEqual(text.count(old), 1, f"'{old}' in {file}")
        path.write_text(text.replace(old, new))
        return f"{file}:{text[:text.index(old)].count(chr(10)) + 1}"

    def assert_refused(self, name, *options, says, before=()):
        """The utility leaves with 1 and an untouched case; its message holds every one of the regular expressions."""
        held = snapshot(self.case)
        run = self.run_utility(name, *options, before=before)
        message = run.stderr
        self.assertEqual(run.returncode, 1, f"exit code {run.returncode}\n{run.stdout[-2000:]}{message}")
        for expression in says:
            self.assertRegex(message, expression)
        self.assertLess(len(message.splitlines()), 25, "a message, not a page")
        self.assertEqual(snapshot(self.case), held, "the case folder was touched")
        return message

    # words

    def test_misspelt_word_in_every_dictionary(self):
        self.seed()
        for file, right, wrong, utility in (
            ("system/controlDict", "endTime         2.5", "endTiem         2.5", "mpmSolve"),
            ("system/mpmSchemes", "stressUpdate ", "stressUpdat ", "mpmSolve"),
            ("system/mpmSchemes", "threshold ", "treshold ", "mpmSolve"),
            ("constant/materialProperties", "cohesion ", "cohesoin ", "mpmSolve"),
            ("constant/boundaryConditions", "separation ", "seperation ", "mpmSolve"),
            ("system/splitParticlesDict", "threshold ", "treshold ", "splitParticles"),
        ):
            with self.subTest(file, word=wrong):
                kept = (self.case / file).read_text()
                place = self.break_line(file, right, wrong)
                options = ["-time", "0", "-target", "refined"] if utility == "splitParticles" else []
                self.assert_refused(utility, *options, says=[re.escape(file), wrong.split()[0], right.split()[0]])
                message = self.run_utility(utility, *options).stderr
                self.assertTrue(place in message or right.split()[0] in message, message)
                (self.case / file).write_text(kept)

    def test_misspelt_word_before_seeding(self):
        for file, right, wrong in (
            ("system/gridDict", "cellSize        0", "cellsize        0"),
            ("system/seedParticlesDict", "particlesPerCell ", "particlePerCell "),
            ("constant/materialProperties", "density         1000", "densitty        1000"),
        ):
            with self.subTest(file):
                kept = (self.case / file).read_text()
                self.break_line(file, right, wrong)
                self.assert_refused("seedParticles", says=[re.escape(file), right.split()[0]])
                (self.case / file).write_text(kept)

    def test_a_word_too_many(self):
        place = self.break_line("system/gridDict", "dimension ", "colour red; dimension ")
        self.assert_refused("seedParticles", says=[re.escape(place), "colour", "cellSize"])

    def test_misspelt_name_out_of_a_catalogue(self):
        self.seed()
        place = self.break_line("system/mpmSchemes", "stressUpdate    MUSL", "stressUpdate    MULS")
        self.assert_refused("mpmSolve", says=[re.escape(place), "MULS", "USF", "USL", "MUSL"])

    # values

    def test_value_out_of_range(self):
        for file, right, wrong, says in (
            ("constant/materialProperties", "nu              0.42", "nu              0.5", ["nu", "0.5"]),
            ("constant/materialProperties", "density         1000", "density         -1000", ["density", "-1000", "> 0"]),
            ("system/gridDict", "cellSize        0.26", "cellSize        -0.26", ["cellSize", "> 0"]),
            ("system/seedParticlesDict", "particlesPerCell    2", "particlesPerCell    0", ["particlesPerCell"]),
        ):
            with self.subTest(file, value=wrong):
                kept = (self.case / file).read_text()
                place = self.break_line(file, right, wrong)
                self.assert_refused("seedParticles", says=[re.escape(place), *says])
                (self.case / file).write_text(kept)

    def test_value_of_the_wrong_kind(self):
        self.seed()
        place = self.break_line("system/controlDict", "deltaT          1e-3", "deltaT          fast")
        self.assert_refused("mpmSolve", says=[re.escape(place), "deltaT", "fast", "number"])

    def test_wrong_dimensions(self):
        place = self.break_line("constant/materialProperties", "density         1000", "density [1 -2 0 0 0 0 0] 1000")
        self.assert_refused("seedParticles", says=[re.escape(place), "density"])

    def test_missing_semicolon(self):
        place = self.break_line("system/gridDict", "dimension       2;", "dimension       2 ")
        message = self.assert_refused("seedParticles", says=["system/gridDict:", ";"])
        line = int(re.search(r"system/gridDict:(\d+)", message).group(1))
        self.assertLessEqual(abs(line - int(place.split(":")[1])), 2, message)

    def test_box_that_is_no_whole_number_of_cells(self):
        place = self.break_line("system/gridDict", "max             (16 12 0)", "max             (16.1 12 0)")
        self.assert_refused("seedParticles", says=[re.escape(place.split(":")[0]), "16.1|cellSize"])

    def test_soil_outside_the_grid(self):
        self.break_line("system/gridDict", "max             (16 12 0)", "max             (16 4 0)")
        self.assert_refused("seedParticles", says=["soil"])

    def test_time_step_beyond_the_stability_limit_names_both_numbers(self):
        self.seed()
        self.break_line("system/controlDict", "deltaT          1e-3", "deltaT          4e-3")
        self.assert_refused("mpmSolve", says=["0.004", r"0?\.00[123]"])

    def test_stress_last_is_refused_at_this_time_step(self):
        self.seed()
        self.break_line("system/mpmSchemes", "stressUpdate    MUSL", "stressUpdate    USL ")
        self.assert_refused("mpmSolve", says=["USL", "0.001", "deltaT"])

    def test_wall_named_after_no_boundary(self):
        self.seed()
        path = self.case / "constant" / "boundaryConditions"
        path.write_text(path.read_text().split("base")[0] + "bsae { type roller; }\n")
        self.assert_refused("mpmSolve", says=["constant/boundaryConditions:", "bsae", "base", "sides", "top"])

    def test_misspelt_type_of_a_wall(self):
        self.seed()
        self.break_line("constant/boundaryConditions", "type            friction", "type            frction ")
        self.assert_refused("mpmSolve", says=["constant/boundaryConditions:", "frction", "friction", "roller"])

    # options

    def test_unknown_option(self):
        for utility in ("seedParticles", "gravityLoading", "mpmSolve", "smoothStress", "stressQuality", "splitParticles",
                        "checkIntegration", "extractSurface"):
            with self.subTest(utility):
                self.assert_refused(utility, "-latesTime", says=["-latesTime", "-case"])

    def test_threads_out_of_range(self):
        self.seed()
        self.assert_refused("mpmSolve", "-threads", "0", says=["threads", "0"])

    def test_time_that_is_not_there(self):
        self.seed()
        self.assert_refused("smoothStress", "-time", "7", says=["7", r"\b0\b"])

    # cases and files

    def test_missing_case(self):
        for utility in ("seedParticles", "gravityLoading", "mpmSolve", "smoothStress", "stressQuality", "splitParticles",
                        "extractSurface"):
            with self.subTest(utility):
                self.assert_refused(utility, "-case", "nowhere", says=["nowhere"])

    def test_folder_that_is_no_case(self):
        for utility in ("seedParticles", "mpmSolve", "smoothStress", "stressQuality"):
            with self.subTest(utility):
                self.assert_refused(utility, "-case", "geometry", says=["geometry", "system"])

    def test_missing_dictionary(self):
        (self.case / "system" / "gridDict").unlink()
        self.assert_refused("seedParticles", says=["system/gridDict"])

    def test_missing_geometry(self):
        (self.case / "geometry" / "column.geo").unlink()
        self.assert_refused("seedParticles", says=["column.geo"])

    def test_solving_before_seeding(self):
        self.assert_refused("mpmSolve", says=["seedParticles|state.h5|no time"])

    def test_seeding_over_a_state_needs_overwrite(self):
        self.seed()
        self.assert_refused("seedParticles", says=["-overwrite"])
        self.assertEqual(self.run_utility("seedParticles", "-overwrite").returncode, 0)

    def test_time_folder_in_the_way(self):
        (self.case / "0").write_text("a file where a folder should be\n")
        self.assert_refused("seedParticles", says=[r"\b0\b"])

    def test_unwritable_folder(self):
        before = []
        if os.geteuid() == 0:
            before = NOBODY
            parent = self.case.parent
            parent.chmod(0o755)
            if subprocess.run([*NOBODY, "test", "-x", BINARIES / "seedParticles"], check=False).returncode:
                self.skipTest("the build cannot be read by another user, and root may write everywhere")
        self.case.chmod(0o555)
        self.addCleanup(self.case.chmod, 0o755)
        self.assert_refused("seedParticles", says=["written|[pP]ermission"], before=before)

    def test_truncated_state(self):
        self.seed()
        state = self.case / "0" / "state.h5"
        whole = state.read_bytes()
        for size in (0, 100, len(whole) // 2, len(whole) - 1):
            with self.subTest(size=size):
                state.write_bytes(whole[:size])
                for utility in ("mpmSolve", "smoothStress", "stressQuality"):
                    self.assert_refused(utility, says=["state.h5"])

    def test_foreign_state(self):
        self.seed()
        state = self.case / "0" / "state.h5"
        with h5py.File(state, "w") as file:
            file["temperature"] = [1.0, 2.0]
        self.assert_refused("mpmSolve", says=["state.h5", "libmpm"])
        state.write_text("no HDF5 at all\n")
        self.assert_refused("smoothStress", says=["state.h5"])

    def test_state_of_a_later_format(self):
        self.seed()
        with h5py.File(self.case / "0" / "state.h5", "r+") as file:
            file.attrs["formatVersion"] = file.attrs["formatVersion"] + 1
        self.assert_refused("mpmSolve", says=["state.h5", "[vV]ersion"])

    def test_state_that_is_not_a_number(self):
        self.seed()
        with h5py.File(self.case / "0" / "state.h5", "r+") as file:
            file["particles/velocity"][7, 0] = float("nan")
        self.assert_refused("mpmSolve", says=["state.h5", "velocity"])

    def test_zero_particles(self):
        self.seed()
        with h5py.File(self.case / "0" / "state.h5", "r+") as file:
            for group in ("particles", "visualisation"):
                for name in list(file[group]):
                    old = file[group][name]
                    attributes, shape, kind = dict(old.attrs), (0, *old.shape[1:]), old.dtype
                    del file[group][name]
                    new = file[group].create_dataset(name, shape=shape, dtype=kind)
                    for key, value in attributes.items():
                        new.attrs[key] = value
        self.assert_refused("mpmSolve", says=["particle"])

    def test_dry_run_writes_nothing(self):
        held = snapshot(self.case)
        run = self.run_utility("seedParticles", "-dry-run")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(snapshot(self.case), held)
        self.seed()
        held = snapshot(self.case)
        run = self.run_utility("mpmSolve", "-dry-run")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(snapshot(self.case), held)


if __name__ == "__main__":
    unittest.main()
