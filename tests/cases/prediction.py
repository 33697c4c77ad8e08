"""mpmSolve -dry-run, -withinTime, -withinError: what a run will cost is known before it, and a setting is picked.

    prediction.py [Prediction.test_name ...]     MPM_BUILD_DIR names the build (default: build/)

Counts are exact, bytes and memory near, seconds are only asked to be there: how fast the machine is decides no test.
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py

import errorTable
from wrongInput import snapshot

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"
UNITS = {"B": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9}


def size(text):
    number, unit = re.fullmatch(r"([\d.]+) (k?M?G?B)", text).groups()
    return float(number) * UNITS[unit]


class Case(unittest.TestCase):
    """A seeded copy of the column that runs to 0.1 s."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name) / "column"
        self.case.mkdir()
        for part in ("geometry", "constant", "system"):
            shutil.copytree(COLUMN / part, self.case / part)
        self.change("system/controlDict", "endTime", "0.1")
        self.change("system/controlDict", "writeInterval", "0.03")
        self.run_utility("seedParticles")

    def change(self, file, word, value):
        path = self.case / file
        text, count = re.subn(rf"(?m)^(\s*{word}\s+)[^;]*;", rf"\g<1>{value};", path.read_text())
        self.assertEqual(count, 1, f"{word} in {file}")
        path.write_text(text)

    def no_splitting(self):
        path = self.case / "system" / "mpmSchemes"
        path.write_text(re.sub(r"\nsplitting\n\{.*?\n\}\n", "\n", path.read_text(), flags=re.S))

    def run_utility(self, name, *options, code=0):
        run = subprocess.run([BINARIES / name, *options], cwd=self.case, stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, timeout=600)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        self.log, self.errors = run.stdout, run.stderr
        return self.log

    def dry_run(self, *options):
        held = snapshot(self.case)
        log = self.run_utility("mpmSolve", "-dry-run", *options)
        self.assertEqual(snapshot(self.case), held, "a dry run leaves the case as it was")
        return log

    def found(self, pattern):
        match = re.search(pattern, self.log)
        self.assertTrue(match, f"'{pattern}' in\n{self.log}")
        return match.groups() if len(match.groups()) > 1 else match[1]

    def states(self):
        return sorted((path.parent.name for path in self.case.glob("*/state.h5")), key=float)


class Prediction(Case):
    def test_counts_of_a_fixed_step_are_those_of_the_run(self):
        self.no_splitting()
        self.change("system/controlDict", "historyInterval", "7")
        self.dry_run()
        steps = int(self.found(r"\n  steps +(\d+) of 0.001 s"))
        states, bytes_of_state, rows, all_bytes = self.found(
            r"on disk +(\d+) states of ([\d.]+ \w+), (\d+) rows of history; ([\d.]+ \w+) in all")
        memory = size(self.found(r"memory +([\d.]+ \w+) at most"))
        self.assertEqual(self.found(r"cells +(\d+) hold particles, ([\d.]+)"), ("450", "4.0"))
        self.found(r"predicted +([\d.]+) ")
        self.found(r"speed +([\d.]+) ns per particle and step")

        self.run_utility("mpmSolve")
        self.assertEqual(int(self.found(r"Done: (\d+) steps")), steps)
        self.assertEqual(len(self.states()) - 1, int(states))
        series = (self.case / "postProcessing" / "history.csv").read_text().splitlines()
        self.assertEqual(len(series) - 1, int(rows))
        last = self.case / self.states()[-1] / "state.h5"
        self.assertAlmostEqual(size(bytes_of_state) / last.stat().st_size, 1, delta=0.06)
        written = sum((self.case / name / "state.h5").stat().st_size for name in self.states()[1:])
        written += sum(path.stat().st_size for path in self.case.glob("postProcessing/*"))
        self.assertAlmostEqual(size(all_bytes) / written, 1, delta=0.06)
        self.assertAlmostEqual(memory / size(self.found(r"memory +([\d.]+ \w+) at most")), 1, delta=0.15)

    def test_counts_from_a_stored_time(self):
        self.run_utility("mpmSolve")
        self.change("system/controlDict", "endTime", "0.16")
        self.dry_run()
        self.found(r"\n  steps +(60) of 0.001 s")
        self.found(r"on disk +(3) states of")
        self.change("system/controlDict", "endTime", "0.1")
        self.assertIn("there is nothing to do", self.dry_run())
        self.found(r"\n  steps +(0) of")

    def test_purged_states_are_written_but_do_not_stay(self):
        self.change("system/controlDict", "purgeWrite", "2")
        self.dry_run()
        self.found(r"on disk +(4) states of .*, of which the last 2 stay")

    def test_steps_that_adapt_are_an_estimate(self):
        self.no_splitting()
        self.change("system/controlDict", "adjustTimeStep", "yes")
        self.dry_run()
        estimate, step, falling = self.found(
            r"steps +about (\d+), estimated from the step allowed now, ([\d.e-]+) s; (\d+) at the speed of a fall")
        self.found(r"the middle between (\S+) \w+, as the state is now, and \S+ \w+, with the larger number of steps")
        self.run_utility("mpmSolve")
        real = int(self.found(r"Done: (\d+) steps"))
        self.assertLessEqual(int(estimate) - 1, real)
        self.assertLessEqual(real, int(falling) + 1)

    def test_splitting_is_a_range(self):
        self.dry_run()
        self.found(r"predicted +(\S+ \w+).* if no particle splits")
        self.assertEqual(self.found(r"if each splits once, at the start \((\d+) particles"), "7200")
        self.assertEqual(self.found(r"at most (\d+) particles by maxGeneration and maxParticles"), "460800")

    def test_domains_that_will_be_wider_make_a_range(self):
        self.no_splitting()
        self.change("system/mpmSchemes", "shape", "cpGIMP")
        self.dry_run()
        self.found(r"speed +([\d.]+) ns per particle and step .*; ([\d.]+) when domains are wider than a cell")

    def test_a_rehearsal_changes_no_bit_of_the_run(self):
        self.no_splitting()
        self.dry_run()
        self.run_utility("mpmSolve")
        with h5py.File(self.case / "0.1" / "state.h5") as file:
            first = file["particles/position"][()]
        errorTable.write(self.case, [errorTable.row("same", endTime=0.1)])
        self.change("system/controlDict", "startFrom", "firstTime")
        self.run_utility("mpmSolve", "-overwrite", "-withinError", "0.5")
        self.assertIn("say so already", self.log)
        with h5py.File(self.case / "0.1" / "state.h5") as file:
            self.assertTrue((file["particles/position"][()] == first).all())

    def test_nothing_beyond_the_end_is_rehearsed(self):
        self.no_splitting()
        self.change("system/controlDict", "endTime", "0.003")
        self.dry_run()
        self.found(r"rehearsed +(3) steps in")
        self.found(r"predicted +([\d.]+) ")

    def test_a_step_that_cannot_be_taken_is_said(self):
        self.no_splitting()
        with h5py.File(self.case / "0" / "state.h5", "r+") as file:
            file["particles/velocity"][0] = (-1e4, 0)
        self.change("system/controlDict", "deltaT", "5e-6")
        self.change("system/controlDict", "endTime", "0.005")
        self.change("system/gridDict", "min", "(-0.8 0 0)")
        self.dry_run()
        self.found(r"rehearsal +a step cannot be taken: (.*)")


class Picked(Case):
    """Settings from a table."""

    def setUp(self):
        super().setUp()
        rows = [errorTable.row("plain", endTime=0.1, error=0.05, cpuSeconds=0.01),
                errorTable.row("followed", endTime=0.1, error=0.01, cpuSeconds=0.012, shape="cpGIMP", deltaT=0.0005,
                                  courant=0.4237),
                errorTable.row("slow", endTime=0.1, error=0.004, cpuSeconds=1000, deltaT=1e-6, courant=0.0008474),
                errorTable.row("unresolved", endTime=0.1, error=0, cpuSeconds=0.001, stressUpdate="USF",
                                  referenceError=0.5),
                errorTable.row("fine", endTime=0.1, error=0.002, cpuSeconds=0.05, cellSize=0.13333333333333333,
                                  referenceError=1e-4),
                errorTable.row("fast", endTime=0.1, error="", cpuSeconds="", status="failed"),
                errorTable.row("pressed", endTime=0.1, errorMeasure="basePressure", error=0.3, cpuSeconds=0.01)]
        errorTable.write(self.case, rows)

    def test_within_error_takes_the_cheapest(self):
        self.run_utility("mpmSolve", "-withinError", "0.01")
        self.assertIn("picked         row followed", self.log)
        self.assertRegex(self.log, r"stay as they are; this run takes shape cpGIMP, no splitting, deltaT 5e-04")
        self.assertRegex(self.log, r"method +cpGIMP, MUSL")
        self.assertNotRegex(self.log, r"\n  splitting")
        self.assertIn("Done: 200 steps", self.log)
        self.assertIn("uGIMP;", (self.case / "system" / "mpmSchemes").read_text())
        with h5py.File(self.case / "0.1" / "state.h5") as file:
            self.assertEqual(file["provenance/overrides"][()].decode().splitlines()[:2],
                             ["-withinError 0.01", "system/mpmSchemes shape cpGIMP"])
            dictionaries = file["provenance/dictionaries"][()].decode()
        self.assertRegex(dictionaries, r"shape\s+cpGIMP;")
        self.assertNotRegex(dictionaries, "splitting")

    def test_a_run_that_goes_on_keeps_them(self):
        self.change("system/controlDict", "endTime", "0.1")
        self.run_utility("mpmSolve", "-withinError", "0.01")
        with h5py.File(self.case / "0.1" / "state.h5") as file:
            whole = file["particles/position"][()]
        for time in self.states()[2:]:
            shutil.rmtree(self.case / time)
        self.run_utility("mpmSolve")
        self.assertRegex(self.log, r"overridden +shape cpGIMP, .*by -withinError 0.01, with which this run began")
        with h5py.File(self.case / "0.1" / "state.h5") as file:
            self.assertTrue((file["particles/position"][()] == whole).all())
        self.run_utility("mpmSolve", "-withinError", "0.01", code=1)
        self.assertIn("found a run that has done", self.errors)

    def test_within_time_takes_the_most_accurate_that_fits(self):
        self.dry_run("-withinTime", "100")
        self.assertIn("picked         row followed", self.log)
        self.found(r"the most accurate of (4) rows with this seeding predicted to take at most 100 s: runOut 0.01, ")
        self.assertIn("better still   runOut 0.002", self.log)
        self.assertIn("system/gridDict cellSize 0.13333333333333333; system/seedParticlesDict particlesPerCell 2; "
                      "then seedParticles -overwrite", self.log)
        self.run_utility("mpmSolve", "-withinTime", "1e-6", code=1)
        self.assertRegex(self.errors, r"found no setting that fast .*the cheapest is predicted to take .*, row unresolved")

    def test_the_error_to_expect(self):
        self.no_splitting()
        self.dry_run()
        self.found(r"error +runOut about (0.05): measured with this setting, row plain")
        self.dry_run("-errorMeasure", "basePressure")
        self.found(r"error +basePressure about (0.3): measured")
        self.change("system/gridDict", "cellSize", "0.4")
        control = self.case / "system" / "controlDict"  # coarser particles have other ids
        control.write_text(re.sub(r"\nrecordStrain.*\Z", "\n", control.read_text(), flags=re.S))
        self.run_utility("seedParticles", "-overwrite")
        self.dry_run()
        # 0.05 and 0.002 on cells of 4/15 and 2/15 m: order log2(25)
        self.found(r"error +runOut about (0.33): extrapolated with order 4.6 from 2 cell sizes")

    def test_a_table_of_another_case(self):
        self.change("system/controlDict", "endTime", "0.2")
        self.assertRegex(self.dry_run(), r"error +not known: .*found row plain of a run to 0.1 s, endTime is 0.2 s")
        self.run_utility("mpmSolve", "-withinError", "0.1", code=1)
        self.assertIn("found row plain of a run to 0.1 s", self.errors)
        self.change("system/controlDict", "endTime", "0.1")
        copy = self.case / "accuracyCost" / "plain" / "constant"
        shutil.copytree(self.case / "constant", copy)
        self.run_utility("mpmSolve", "-dry-run", "-withinError", "0.1")
        text = (copy / "materialProperties").read_text()
        (copy / "materialProperties").write_text(text.replace("20e6", "30e6"))
        self.run_utility("mpmSolve", "-dry-run", "-withinError", "0.1", code=1)
        self.assertIn("found row plain with another constant/materialProperties", self.errors)


del Case  # a frame, no test of its own

if __name__ == "__main__":
    unittest.main()
