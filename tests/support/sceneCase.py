"""A scene that is a test: copies of it, runs of the utilities in them, criteria, a verdict.

A scene is a folder: geometry/, constant/ and system/ as in any case, and check.py, whose docstring says what it is. Two
kinds are made of what stands here: hard cases (tests/stability/hardCase.py) and verification with measured errors
(tests/verification/verification.py).

A scene needs nothing but a build (MPM_BUILD_DIR, default build/) and writes only below <build>/tests/<kind>/<name>/: one
copy of the scene a variant, and verdict.json. It exits with 1 if a criterion fails. `check.py --long` runs the long
version where there is one (label nightly).
"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve()
RELATIONS = {"<": lambda a, b: a < b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b, ">=": lambda a, b: a >= b,
             "==": lambda a, b: a == b}
LONG = "--long" in sys.argv


class State:
    """A state.h5: attributes, particles (x, v, stress, F, mass, volume, id, ... by their names there), ledger."""

    def __init__(self, path):
        self.path = Path(path)
        with h5py.File(path) as file:
            self.attributes = dict(file.attrs)
            self.particles = {name: item[()] for name, item in file["particles"].items()}
            self.ledger = {name: item[()] for name, item in file["ledger"].items()}
        self.time = float(self.attributes["time"])

    def __getitem__(self, name):
        return self.particles[name]

    def by_id(self, name):
        return self.particles[name][np.argsort(self.particles["id"])]


class Run:
    """One copy of the scene and what the last utility in it did."""

    def __init__(self, folder):
        self.folder, self.exit, self.log = folder, 0, ""

    def utility(self, name, *options, threads=None, environment=None):
        """Runs a utility in the folder; exit code and everything it printed are kept, nothing is raised."""
        command = [BUILD / "bin" / name, *options] + (["-threads", str(threads)] if threads else [])
        done = subprocess.run(command, cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, timeout=1800, env={**os.environ, **(environment or {})})
        self.exit, self.log = done.returncode, done.stdout
        (self.folder / f"log.{name}").write_text(done.stdout)
        return self

    def set(self, file, word, value):
        """Gives the entry that begins a line with this word another value; one in braces, "{ A 1; }", replaces a dictionary."""
        path = self.folder / file
        old, new = (r"\{[^}]*\}", value) if str(value).startswith("{") else ("[^;]*;", f"{value};")
        text, count = re.subn(rf"(?m)^(\s*{word}\s+){old}", lambda found: found.group(1) + new, path.read_text())
        if count != 1:
            raise SystemExit(f"{path}: {count} entries {word}, one is needed")
        path.write_text(text)

    def remove(self, file, word):
        """Takes an entry or dictionary out, if it is there."""
        path = self.folder / file
        text = path.read_text()
        found = re.search(rf"(?m)^[ \t]*{word}\s+[^;{{]*;|^[ \t]*{word}\s*\{{", text)
        if found:
            end = found.end()
            while text[found.start():end].count("{") > text[found.start():end].count("}"):
                end = text.index("}", end) + 1
            path.write_text(text[:found.start()] + text[end:])

    def edit(self, change, time=-1):
        """Lets change(particles) alter the arrays of a stored state in place (default: the last), before a run."""
        with h5py.File(self.state(time).path, "r+") as file:
            particles = {name: item[()] for name, item in file["particles"].items()}
            change(particles)
            for name, values in particles.items():
                file["particles"][name][...] = values
        return self

    def times(self):
        found = [p.parent.name for p in self.folder.glob("*/state.h5")]
        return sorted(found, key=float)

    def state(self, time=-1):
        """By index (-1 the last, 0 the first) or by folder name."""
        return State(self.folder / (self.times()[time] if isinstance(time, int) else time) / "state.h5")

    def series(self, name="history"):
        """Columns of postProcessing/<name>.csv by name."""
        return np.atleast_1d(np.genfromtxt(self.folder / "postProcessing" / f"{name}.csv", delimiter=",", names=True))


class SceneCase:
    """script: the check.py; text: its docstring, "Title. <Word>: ... Pass: ..."; the verdict tells the middle part under
    the name `label`. Subclasses say their KIND, which is their folder below tests/."""

    KIND = ""

    def __init__(self, script, text, word, label):
        self.scene = Path(script).resolve().parent
        self.source = self.scene  # the folder whose dictionaries are copied; a scene may take those of a case
        self.name = self.scene.name
        self.folder = BUILD / "tests" / self.KIND / (self.name + ("-long" if LONG else ""))
        title, rest = " ".join(text.split()).split(f" {word}: ")
        middle, criterion = rest.split(" Pass: ")
        self.about = {"case": self.name, "title": title, label: middle, "criterion": criterion}
        self.checks = []
        shutil.rmtree(self.folder, ignore_errors=True)

    def copy(self, variant, *changes):
        """A fresh copy of the scene; change = (file, word, value), or a function of the Run."""
        run = Run(self.folder / variant)
        for part in ("geometry", "constant", "system"):
            if (self.source / part).is_dir():
                shutil.copytree(self.source / part, run.folder / part)
        for change in changes:
            change(run) if callable(change) else run.set(*change)
        return run

    def seed(self, variant, *changes):
        """A copy with its 0/state.h5; seeding must succeed."""
        run = self.copy(variant, *changes).utility("seedParticles")
        if run.exit != 0:
            print(run.log)
            self.check(f"exit code of seedParticles ({variant})", run.exit, "==", 0)
            self.finish()
        return run

    def solve(self, variant, *changes, exits=0, threads=None):
        """A seeded copy, solved to its end; the exit code is a criterion of its own where it is not `exits`."""
        run = self.seed(variant, *changes).utility("mpmSolve", threads=threads)
        if run.exit != exits:
            print(run.log)
            self.check(f"exit code of mpmSolve ({variant})", run.exit, "==", exits)
        return run

    def require(self, run, exits=0):
        """Makes the exit code of the run's last utility a criterion, for runs not made by solve()."""
        if run.exit != exits:
            print(run.log)
        self.check(f"exit code ({run.folder.name})", run.exit, "==", exits)
        return run

    def check(self, what, measured, relation, bound, unit=""):
        """One criterion; numbers are compared as they are, a NaN fails all."""
        passed = bool(RELATIONS[relation](measured, bound))
        self.checks.append({"what": what, "measured": measured if isinstance(measured, str) else float(measured),
                            "relation": relation, "bound": bound if isinstance(bound, str) else float(bound),
                            "unit": unit, "passed": passed})
        text = measured if isinstance(measured, str) else f"{measured:.4g}"
        print(f"{'ok  ' if passed else 'FAIL'}  {what}: {text} {unit} ({relation} {bound})")
        return passed

    def common(self, run, energy=0.02, impulse=0.0):
        """What holds in every case: finite numbers, exact mass, momentum balance, yield condition, energy budget.
        energy: largest |residual| over the energy that was there or supplied; impulse [N s]: of forces that cancel in the
        ledger (walls that face each other), so that round-off is measured against them too."""
        first, last, history = run.state(0), run.state(-1), run.series()
        tag = f" ({run.folder.name})"
        numbers = [last[n] for n in last.particles] + [history[n] for n in history.dtype.names]
        self.check("numbers that are not finite" + tag, sum(int((~np.isfinite(n)).sum()) for n in numbers), "==", 0)
        mass = math.fsum(last["mass"]) / math.fsum(first["mass"]) - 1
        self.check("change of mass" + tag, abs(mass), "<=", 1e-14)
        ledger = last.ledger
        dim = last["velocity"].shape[1]
        sources = [ledger[n][:dim] for n in ("initialMomentum", "wallImpulse", "gravityImpulse", "tractionImpulse",
                                          "dampingImpulse", "restImpulse") if n in ledger]
        momentum = (last["mass"][:, None] * last["velocity"]).sum(axis=0)
        scale = (last["mass"][:, None] * np.abs(last["velocity"])).sum() + sum(np.abs(s).sum() for s in sources) + impulse
        if scale > 0:
            self.check("momentum that came from nowhere" + tag, np.abs(momentum - sum(sources)).max() / scale, "<=", 1e-12)
        self.check("yield violation" + tag, history["maxYieldViolation"].max(), "<=", 1e-9)
        supplied = sum(abs(float(ledger[n])) for n in ("initialKineticEnergy", "initialStrainEnergy", "tractionWork",
                                                      "motionSupply") if n in ledger)
        supplied += np.abs(history["gravityWork"]).max()  # what bounces gives it back
        if supplied > 0:
            self.check("energy residual" + tag, np.abs(history["residual"]).max() / supplied, "<=", energy)

    def finish(self):
        passed = bool(self.checks) and all(c["passed"] for c in self.checks)
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "verdict.json").write_text(json.dumps({**self.about, "passed": passed, "checks": self.checks},
                                                             indent=1))
        print(f"{self.name}: {'passed' if passed else 'FAILED'}")
        sys.exit(0 if passed else 1)


# What several scenes share --------------------------------------------------------------------------------------------

def set_fields(run, **fields):
    """Overwrites fields of the particles in 0/state.h5 (between seeding and solving): arrays, or functions of the
    positions (N, dim), as velocity=lambda x: 0 * x."""
    with h5py.File(run.folder / "0" / "state.h5", "r+") as file:
        position = file["particles/position"][()]
        for name, value in fields.items():
            item = file["particles"][name]
            item[...] = np.asarray(value(position) if callable(value) else value).reshape(item.shape)


def schemes(shape, update):
    """Changes of system/mpmSchemes."""
    return ("system/mpmSchemes", "shape", shape), ("system/mpmSchemes", "stressUpdate", update)


# stressTreatment of system/mpmSchemes, by the names that tables have.
TREATMENTS = {"automatic": "automatic;", "averaging": "{ volumetricAveraging { region patch; repeats 4; } }",
              "cell averaging": "{ volumetricAveraging { region cell; } }",
              "elastic averaging": "{ volumetricAveraging { region patch; repeats 4; of elastic; } }",
              "conjugate averaging": "{ volumetricAveraging { region cell; conjugate yes; } }",
              "relaxation": "{ stressRelaxation { target filtered; } }",
              "relaxation, least squares": "{ stressRelaxation { target leastSquares; } }",
              "relaxation, smoothed": "{ stressRelaxation { target smoothed; } }", "gap": "{ tensionGap yes; }"}


def treatment(name):
    """A change of system/mpmSchemes: one of TREATMENTS, or "plain", the scheme without."""
    def change(run):
        run.remove("system/mpmSchemes", "stressTreatment")
        if name != "plain":
            path = run.folder / "system/mpmSchemes"
            path.write_text(path.read_text() + f"stressTreatment {TREATMENTS[name]}\n")
    return change


def record(case, what, measured, unit=""):
    """A number for the table that no criterion bounds."""
    case.checks.append({"what": what, "measured": float(measured), "relation": "recorded", "bound": float(measured),
                        "unit": unit, "passed": True})
    print(f"      {what}: {measured:.4g} {unit} (recorded)")


def pressure(stress):
    """-(s_xx + s_yy + s_zz)/3, compression positive."""
    return -stress[:, :3].sum(axis=1) / 3


def log_number(run, pattern):
    """The number a regular expression's group finds in what the last utility printed; NaN if it is not there."""
    found = re.search(pattern, run.log)
    return float(found.group(1)) if found else math.nan


def checkerboard(position, value, spacing):
    """RMS amplitude of what alternates from one particle to the next: half of each value less the mean of its four
    neighbours on the lattice of seeding (2D; particles at its edges are left out)."""
    index = np.floor(position / spacing).astype(int)
    index -= index.min(axis=0)
    table = np.full(index.max(axis=0) + 1, np.nan)
    table[index[:, 0], index[:, 1]] = value
    mean = (table[:-2, 1:-1] + table[2:, 1:-1] + table[1:-1, :-2] + table[1:-1, 2:]) / 4
    return math.sqrt(np.nanmean((0.5 * (table[1:-1, 1:-1] - mean)) ** 2))
