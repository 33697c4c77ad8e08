"""Nothing is lost: runs that are killed, interrupted, or meet a full disk keep whole states, and going on from them ends
bitwise as the uninterrupted run, with the same files in the case folder.

    nothingLost.py [NothingLost[.test_name] | SmallDisk ...]     20 kills; with MPM_KILLS=200 the long version
    MPM_BUILD_DIR names the build (default: build/), MPM_SEED the random numbers (default: 1)

The scene is the collapsing column while it splits, from 0.5 s on, in several ways to step and to write.
"""

import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest
from collections import Counter
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cases"))
from columnCase import BINARIES, ColumnCase  # noqa: E402

START, END = 0.5, 0.56
KILLS = int(os.environ.get("MPM_KILLS") or 20)
CODES = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}
WAYS = {
    "fixedStep": dict(adjustTimeStep="no", writeControl="timeStep", writeInterval="3", historyInterval="2"),
    "adjusted": dict(adjustTimeStep="yes", writeControl="runTime", writeInterval="0.005", historyInterval="3",
                     timePrecision="3", maxCo="0.3", monitor="action stop;"),
    "landing": dict(adjustTimeStep="yes", writeControl="adjustableRunTime", writeInterval="0.006", purgeWrite="3",
                    historyInterval="7", maxCo="0.3"),
}


def content(path):
    """Everything in a state by name, as bytes."""
    held = {}
    with h5py.File(path) as file:
        for name, value in file.attrs.items():
            held[f"/{name}"] = np.asarray(value).tobytes()
        file.visititems(lambda name, item: held.update(
            {name: np.asarray(item[()]).tobytes()} if isinstance(item, h5py.Dataset) else {}))
    return held


def files(case):
    return {path.relative_to(case).as_posix(): path for path in sorted(case.rglob("*")) if path.is_file()}


def states(case):
    return {path.parent.name: path for path in case.glob("[0-9]*/state.h5")}


class StoppedColumn(ColumnCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # a shell that put us into the background may have had these ignored, and children inherit that
        for one in CODES:
            signal.signal(one, signal.default_int_handler)
        cls.random = random.Random(int(os.environ.get("MPM_SEED") or 1))
        cls.seed(endTime=("system/controlDict", START), threshold=("system/mpmSchemes", "1.2"),
                 cellSize=("system/gridDict", "0.4"), particles=("system/controlDict", "(15 400 700)"))
        cls.set(cls.seeded, "system/controlDict", "writeInterval", str(START))
        cls.run_utility(cls.seeded, "mpmSolve")
        shutil.rmtree(cls.seeded / "0")
        cls.set(cls.seeded, "system/controlDict", "endTime", str(END))
        cls.whole, cls.seconds = {}, {}
        for way in WAYS:
            cls.whole[way] = cls.column("whole", way)
            began = time.monotonic()
            cls.run_utility(cls.whole[way], "mpmSolve")
            cls.seconds[way] = time.monotonic() - began
        cls.expected = {way: {name: content(path) for name, path in states(case).items()}
                        for way, case in cls.whole.items()}

    @classmethod
    def column(cls, name, way, below=None):
        """A fresh case; all bear the same folder name, which names their files for ParaView."""
        case = (below or cls.folder) / f"{name}-{way}" / "column"
        shutil.copytree(cls.seeded, case)
        control = case / "system/controlDict"
        if way == "landing":  # a run that may go back records no strain paths
            control.write_text(re.sub(r"(?s)\nrecordStrain.*", "\n", control.read_text()))
            (case / "postProcessing/strainPaths.csv").unlink()
        for word, value in WAYS[way].items():
            if word == "monitor":
                control.write_text(control.read_text() + f"monitor {{ {value} }}\n")
            else:
                cls.set(case, "system/controlDict", word, value)
        return case

    # helpers

    COMPLAINT = r"(?s)^--> mpmSolve: error: .*(cannot be|could not be)"

    def start(self, case, *options, **how):
        return subprocess.Popen([BINARIES / "mpmSolve", *options], cwd=case, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, **how)

    def end(self, run):
        """Exit code and message."""
        _, message = run.communicate(timeout=120)
        return run.returncode, message

    def assert_whole(self, case, way):
        """Every state there is, is whole, and what it should be; the latest is accepted."""
        self.assertTrue(states(case))
        for name, path in states(case).items():
            held = content(path)
            self.assertTrue(held)
            if "provenance/outOfTurn" not in held and name in self.expected[way]:
                self.assert_same(held, self.expected[way][name], path)
        dry = subprocess.run([BINARIES / "mpmSolve", "-dry-run"], cwd=case, text=True, capture_output=True)
        self.assertEqual(dry.returncode, 0, dry.stderr)

    def assert_same(self, held, expected, where):
        self.assertEqual(set(held), set(expected), where)
        self.assertEqual([name for name in expected if held[name] != expected[name]], [], where)

    def assert_as_uninterrupted(self, case, way):
        """The same files with the same content: states, tables, ParaView's series; nothing left over."""
        found, expected = files(case), files(self.whole[way])
        self.assertEqual(set(found), set(expected))
        for name in expected:
            if name.endswith("state.h5"):
                self.assert_same(content(found[name]), self.expected[way][Path(name).parent.name], name)
            else:
                self.assertEqual(found[name].read_bytes(), expected[name].read_bytes(), name)

    def finish(self, case, way):
        code, message = self.end(self.start(case))
        self.assertEqual(code, 0, message)
        self.assert_as_uninterrupted(case, way)


class NothingLost(StoppedColumn):
    # what the tests stand on

    def test_the_scene_splits_and_writes(self):
        for way, held in self.expected.items():
            counts = {len(state["particles/id"]) for state in held.values()}
            self.assertGreater(len(counts), 2, way)
        self.assertGreater(len(self.expected["fixedStep"]), 15)
        self.assertEqual(len(self.expected["landing"]), 4)  # the start, and purgeWrite 3

    def test_steps_do_not_depend_on_where_a_run_ends(self):
        for way in WAYS:
            case = self.column("ended", way)
            for end in (0.5137, 0.53, END):
                self.set(case, "system/controlDict", "endTime", str(end))
                self.assertEqual(self.end(self.start(case))[0], 0)
                self.assertGreater(float(max(states(case), key=float)), end - 5e-4)
            for name in ("history.csv", "energyBudget.csv"):
                self.assertEqual((case / "postProcessing" / name).read_text(),
                                 (self.whole[way] / "postProcessing" / name).read_text(), f"{way}: {name}")
            last = max(self.expected[way], key=float)
            held, expected = content(states(case)[last]), dict(self.expected[way][last])
            for name in ("provenance/purgeWrite", "provenance/dictionaries"):  # other times, another endTime
                self.assertEqual(name in held, name in expected)
                expected[name] = held.get(name)
            self.assert_same(held, {name: value for name, value in expected.items() if value is not None}, way)

    # killed

    def test_killed_at_random_moments(self):
        kills, unfinished = 0, 0
        while kills < KILLS:
            way = self.random.choice(list(WAYS))
            case = self.column(f"killed{kills}", way)
            while kills < KILLS:
                run = self.start(case, "-threads", self.random.choice("12"))
                time.sleep(self.random.uniform(0, 0.8 * self.seconds[way]))
                run.kill()
                code, message = self.end(run)
                if code == 0:
                    break
                self.assertEqual(code, -signal.SIGKILL, message)
                kills += 1
                unfinished += any(case.rglob("*.partial"))
                self.assert_whole(case, way)
            self.finish(case, way)
            shutil.rmtree(case.parent)
        print(f"{kills} kills, {unfinished} of them in the middle of a file; every continued run bitwise")

    # interrupted

    def test_interrupted_at_random_moments(self):
        stopped, rounds = {one: 0 for one in CODES}, 0
        while min(stopped.values()) < max(2, KILLS // 20):
            way = list(WAYS)[rounds % len(WAYS)]
            case = self.column(f"interrupted{rounds}", way)
            rounds += 1
            self.assertLess(rounds, 100, "runs end before they can be interrupted")
            for _ in range(4):
                one = min(CODES, key=lambda one: (stopped[one], self.random.random()))
                run = self.start(case)
                self.wait_for_handlers(run)
                time.sleep(self.random.uniform(0, 0.5) * self.seconds[way])
                run.send_signal(one)
                code, message = self.end(run)
                if code in (0, -one):  # endTime was reached before
                    break
                self.assertEqual(code, CODES[one], message)
                stopped[one] += 1
                self.assertRegex(message, rf"^--> mpmSolve: stopped by {one.name} at [0-9.]+ s, after step \d+; "
                                          r"the state is in [0-9.]+/state\.h5\.\n    Run mpmSolve again: "
                                          r"startFrom latestTime goes on bitwise to endTime 0\.56 s\.\n$")
                named = re.search(r"the state is in ([0-9.]+)/", message)[1]
                self.assertEqual(named, max(states(case), key=float))
                self.assert_whole(case, way)
                self.assertFalse(list(case.rglob("*.partial")) + list(case.rglob(".caseLock")))
            self.finish(case, way)

    def wait_for_handlers(self, run):
        """Before, signals kill at once: nothing has been written."""
        status, mask = Path(f"/proc/{run.pid}/status"), 1 << (signal.SIGTERM - 1)
        while run.poll() is None and not int(re.search(r"SigCgt:\s*(\S+)", status.read_text())[1], 16) & mask:
            time.sleep(0.0005)

    def stopped_half_way(self, case):
        """mpmSolve, halted by SIGSTOP after its first state in turn."""
        before = set(states(case))
        run = self.start(case)
        while set(states(case)) == before and run.poll() is None:
            time.sleep(0.0005)
        run.send_signal(signal.SIGSTOP)
        self.assertIsNone(run.poll())
        return run

    def test_a_state_out_of_turn_stays_when_it_was_worked_on(self):
        for worked in (False, True):
            step = tries = 0
            while step % 25 == 0:  # until the signal comes at a step that is not written anyway
                tries += 1
                case = self.column(f"worked{worked}{tries}", "fixedStep")
                self.set(case, "system/controlDict", "writeInterval", "25")
                history = case / "postProcessing/history.csv"
                length = history.stat().st_size
                run = self.start(case)
                while history.stat().st_size <= length:
                    time.sleep(0.0005)
                run.send_signal(signal.SIGTERM)
                self.assertEqual(self.end(run)[0], 143)
                extra = max(states(case), key=float)
                self.assertNotEqual(float(extra), START, "stopped before the first step")
                with h5py.File(case / extra / "state.h5") as file:
                    step = int(file.attrs["step"])
            if worked:
                if not (BINARIES / "smoothStress").exists():
                    self.skipTest("no smoothStress in this build")
                self.run_utility(case, "smoothStress", "-latestTime")
            self.assertEqual(self.end(self.start(case))[0], 0)
            self.assertEqual(extra in states(case), worked)

    def test_the_message_says_what_to_change(self):
        case = self.column("given", "fixedStep")
        self.set(case, "system/controlDict", "startFrom", "firstTime")
        run = self.stopped_half_way(case)
        run.send_signal(signal.SIGHUP)
        run.send_signal(signal.SIGCONT)
        code, message = self.end(run)
        self.assertEqual(code, 129, message)
        self.assertIn("Run mpmSolve again with startFrom latestTime in system/controlDict: ", message)

    def test_the_second_signal_kills(self):
        case = self.column("twice", "fixedStep")
        run = self.stopped_half_way(case)
        for one in (signal.SIGINT, signal.SIGTERM, signal.SIGCONT):
            run.send_signal(one)
        code, message = self.end(run)
        self.assertEqual(code, -signal.SIGTERM, message)
        self.assert_whole(case, "fixedStep")
        self.finish(case, "fixedStep")

    # two at a time

    def test_a_case_in_use_is_refused(self):
        case = self.column("used", "fixedStep")
        shutil.copytree(self.seeded / str(START), case / "0")
        elsewhere = self.column("elsewhere", "fixedStep")
        run = self.stopped_half_way(case)
        time.sleep(0.05)  # SIGSTOP reaches every thread
        held = {name: path.read_bytes() for name, path in files(case).items()}
        holder = rf"this case is in use by mpmSolve, process {run.pid} on \S+ since 20"
        for folder, name, *options in ((case, "mpmSolve"), (case, "mpmSolve", "-overwrite"),
                                       (case, "seedParticles", "-overwrite"), (case, "smoothStress", "-latestTime"),
                                       (case, "splitParticles", "-overwrite"),
                                       (elsewhere, "splitParticles", "-overwrite", "-target", case)):
            with self.subTest(name, options=options):
                if not (BINARIES / name).exists():
                    self.skipTest(f"no {name} in this build")
                second = subprocess.run([BINARIES / name, *options], cwd=folder, text=True, capture_output=True)
                self.assertEqual(second.returncode, 1, second.stdout + second.stderr)
                self.assertRegex(second.stderr, holder)
                self.assertEqual({name: path.read_bytes() for name, path in files(case).items()}, held)
        self.assertEqual(subprocess.run([BINARIES / "seedParticles", "-overwrite", "-dry-run"], cwd=case,
                                        capture_output=True).returncode, 0)
        run.kill()
        self.end(run)
        self.assertTrue((case / ".caseLock").exists())
        shutil.rmtree(case / "0")
        self.finish(case, "fixedStep")

    # no room

    def test_files_that_may_not_grow(self):
        """RLIMIT_FSIZE: every file ends at a random length."""
        size = max(path.stat().st_size for path in states(self.whole["fixedStep"]).values())
        for way in WAYS:
            case = self.column("limited", way)
            failed = 0
            for _ in range(max(4, KILLS // 10)):
                most = int(size * self.random.choice((self.random.random(), 0.01 * self.random.random())))
                code, message = self.end(self.start(
                    case, preexec_fn=lambda most=most: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))))
                self.assertEqual(code, 1, message)
                self.assertRegex(message, self.COMPLAINT)
                self.assert_whole(case, way)
                failed += 1
            self.finish(case, way)

    def test_a_full_disk_below_the_standard_output(self):
        case = self.column("devFull", "fixedStep")
        with open("/dev/full", "w") as full:
            run = subprocess.run([BINARIES / "mpmSolve"], cwd=case, text=True, stdout=full, stderr=subprocess.PIPE)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("the standard output could not be written", run.stderr)
        self.assert_whole(case, "fixedStep")
        self.finish(case, "fixedStep")


class SmallDisk(StoppedColumn):
    """Disks of our own that are full or read-only; skipped without the right to mount them."""

    def mounted(self, name, kibibytes):
        """A small disk; needs the right to mount one."""
        folder = self.folder / name
        folder.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "tmpfs", folder],
                               capture_output=True, text=True)
        if mount.returncode != 0:
            self.skipTest(f"no right to mount a small disk: {mount.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", "-l", folder], check=True)
        return folder

    def test_full_disk(self):
        """The disk is filled up to a random rest before every try."""
        complaints = Counter()
        for way in WAYS:
            disk = self.mounted(f"disk-{way}", 65536)
            case = self.column("full", way, below=disk)
            ballast, failed = disk / "ballast", 0
            run_size = sum(path.stat().st_size for path in files(self.whole[way]).values())
            for _ in range(max(4, KILLS // 10)):
                free = shutil.disk_usage(disk).free
                rest = int(run_size * self.random.choice((0.02, 0.3, 0.9)) * self.random.random())
                ballast.write_bytes(bytes(max(0, free - rest)))
                code, message = self.end(self.start(case))
                if code == 0:
                    break
                failed += 1
                self.assertEqual(code, 1, message)
                self.assertRegex(message, self.COMPLAINT)
                complaints[Path(re.search(r"error: (\S+?):", message)[1]).name] += 1
                if "No space" not in message:  # while stepping; not at the start
                    self.assertRegex(message, r"the last stored time is [0-9.]+; once this is mended, mpmSolve goes on")
                self.assert_whole(case, way)
                ballast.unlink()
            ballast.unlink(missing_ok=True)
            self.assertGreater(failed, 1)
            self.finish(case, way)
        print(f"no room for {dict(complaints)}; every continued run bitwise")

    def test_read_only_folder(self):
        disk = self.mounted("readOnly", 65536)
        case = self.column("readOnly", "fixedStep", below=disk)
        shutil.copytree(self.seeded / str(START), case / "0")
        subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
        for name, *options in (("mpmSolve",), ("seedParticles", "-overwrite"), ("smoothStress",),
                               ("splitParticles", "-overwrite")):
            with self.subTest(name):
                if not (BINARIES / name).exists():
                    self.skipTest(f"no {name} in this build")
                for dry in ((), ("-dry-run",)):
                    run = subprocess.run([BINARIES / name, *options, *dry], cwd=case, text=True, capture_output=True)
                    self.assertEqual(run.returncode, 0 if dry else 1, run.stderr)
                    if not dry:
                        self.assertRegex(run.stderr, r"this folder cannot be written to: .*Read-only")


if __name__ == "__main__":
    unittest.main()
