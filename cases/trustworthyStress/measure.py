"""Case folders with changed words, their runs, and the numbers a run leaves."""

import csv
import re
import shutil
import subprocess
from pathlib import Path

import h5py
import numpy as np

from rows import TIMES

HERE = Path(__file__).resolve().parent


def change(case, file, word, value):
    """Gives an entry that begins a line another value, which may be a dictionary; None removes it."""
    path = case / file
    entry = rf"^([ \t]*){word}\b[ \t]*(?:[^;{{]*;|\s*\{{(?:[^{{}}]|\{{[^{{}}]*\}})*\}})"
    if value is None:
        new = ""
    else:
        new = rf"\g<1>{word} {value}" + ("" if value.endswith("}") else ";")
    text, count = re.subn(entry, new, path.read_text(), flags=re.M)
    if count != 1:
        raise SystemExit(f"{path}: found the entry {word} {count} times")
    path.write_text(text)


def make_case(case, changes):
    """A copy of this folder's dictionaries with other words."""
    shutil.rmtree(case, ignore_errors=True)
    case.mkdir(parents=True)
    for part in ("geometry", "constant", "system"):
        shutil.copytree(HERE / part, case / part)
    for file, words in changes.items():
        for word, value in words.items():
            change(case, file, word, value)


def run(case, *command, log=None):
    """The exit code; output goes to log.<utility>."""
    with open(case / f"log.{log or command[0]}", "w") as file:
        return subprocess.run(command, cwd=case, stdout=file, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode


def must(case, *command, log=None):
    if run(case, *command, log=log):
        raise SystemExit(f"{command[0]} failed: see {case / ('log.' + (log or command[0]))}")


def complaint(case, log="mpmSolve"):
    """Why a run ended, from its log: the message behind 'error:', with files as seen from the case."""
    lines = (case / f"log.{log}").read_text().replace(f"{case}/", "").strip().splitlines() or ["no message"]
    return next((line.split(" error: ")[-1] for line in lines if line.startswith("-->") and " error: " in line), lines[-1]).strip()


def table(path):
    """Rows of numbers."""
    with open(path, newline="") as file:
        return [{word: float(value) if value else float("nan") for word, value in row.items()} for row in csv.DictReader(file)]


def nearest(rows, time):
    return min(rows, key=lambda row: abs(row["time"] - time))


def cost(case):
    """Processor time in ns per particle and step, from the profile mpmSolve prints."""
    found = re.search(r"^\s*processor\s.*?([\d.]+)\s*$", (case / "log.mpmSolve").read_text(), re.M)
    return float(found.group(1))


class Smoothing:
    """S: Eq. 11 and 12 of the paper with the weights of uGIMP, for the particles of a stored state."""

    def __init__(self, path):
        with h5py.File(path) as file:
            particles = file["particles"]
            self.stress, self.mass, volume = (particles[name][:] for name in ("stress", "mass", "volume"))
            position, length = particles["position"][:], particles["length0"][:]
            self.h, origin = read_grid(path.parent.parent)
        axes = [self.weights_along((position[:, k] - origin[k]) / self.h, length[:, k] / self.h) for k in range(2)]
        width = axes[0][0].max() + 3
        self.nodes = np.stack([axes[0][0] + i + width * (axes[1][0] + j) for j in range(3) for i in range(3)])
        self.weights = np.stack([axes[0][1][i] * axes[1][1][j] for j in range(3) for i in range(3)])
        full = np.bincount(self.nodes.ravel(), (self.weights * volume).ravel()) > 0.95 * self.h**2
        self.inside = (self.weights * full[self.nodes]).sum(axis=0) > 0.99     # all nodes of a particle lie in soil

    @staticmethod
    def weights_along(x, length):
        """First node and the three weights of a domain of half-length l <= h/2 (x and length in cells)."""
        l = np.minimum(0.5, length / 2)
        first = np.floor(x - l).astype(int)
        d = np.abs(x - (first + np.arange(3)[:, None]))
        w = np.where(d < l, 1 - (d * d + l * l) / (2 * l),
                     np.where(d < 1 - l, 1 - d, np.where(d < 1 + l, (1 + l - d) ** 2 / (4 * l), 0)))
        return first + 1, w

    def __call__(self, field):
        size = self.nodes.max() + 1
        mass = np.bincount(self.nodes.ravel(), (self.weights * self.mass).ravel(), size)
        moment = np.bincount(self.nodes.ravel(), (self.weights * (self.mass * field)).ravel(), size)
        nodal = np.divide(moment, mass, out=np.zeros(size), where=mass > 0)
        return (self.weights * nodal[self.nodes]).sum(axis=0)


def read_grid(case):
    text = (case / "system/gridDict").read_text()
    corner = re.search(r"^min\s+\(([^)]*)\)", text, re.M).group(1).split()
    return float(re.search(r"^\s*cellSize\s+([^;]*);", text, re.M).group(1)), [float(x) for x in corner]


def rms(x):
    return float(np.sqrt(np.mean(x * x)))


def noise_inside(path):
    """N of sigma_yy, and N of the particles inside: faces, the base and layers of one cell are left out."""
    smooth = Smoothing(path)
    raw = smooth.stress[:, 1]
    once = smooth(raw)
    return rms(raw - once) / rms(once), rms((raw - once)[smooth.inside]) / rms(once[smooth.inside])


def folder_of(case, time):
    return next(p for p in case.iterdir() if (p / "state.h5").is_file() and abs(float(p.name) - time) < 1e-6)


def quality(case, references):
    """Rows of stressQuality at the figure's times; with RMS errors against each of `references` (names beside ours)."""
    must(case, "smoothStress")
    smoothed = table(case / "postProcessing/smoothStress.csv")
    rows = {}
    for name in references or (None,):
        must(case, "stressQuality", *(("-against", str(HERE / name)) if name else ()), log=f"stressQuality.{name or 'alone'}")
        for row in table(case / "postProcessing/stressQuality.csv"):
            kept = rows.setdefault(row["time"], row)
            if name:
                kept |= {"error " + name: row["errorAgainstRaw"], "smoothed " + name: row["errorAgainstSmoothed"],
                         "size " + name: row["errorAgainstRaw"] / row["relativeErrorAgainstRaw"]}
    found = [nearest(list(rows.values()), time) for time in TIMES]
    return [row | {"correlationSmoothed": nearest(smoothed, row["time"])["correlationSmoothed"]} for row in found]


def viscosity_loss(path):
    """[J] of the ledger: what the viscosity of volumetricAveraging took."""
    with h5py.File(path) as file:
        return float(file["ledger/viscosityLoss"][()]) if "ledger/viscosityLoss" in file else 0.0


def measure(case, references=()):
    """All numbers of one run, by the columns of tradeOff.csv."""
    rows, history = quality(case, references), table(case / "postProcessing/history.csv")
    out = {}
    for time, row in zip(TIMES, rows):
        again, inside = noise_inside(folder_of(case, time) / "state.h5")
        if abs(again - row["noiseYY"]) > 1e-3 * row["noiseYY"] + 1e-6:
            raise SystemExit(f"{case}: N at {time} s is {again} here and {row['noiseYY']} by stressQuality")
        out |= {f"noise{time:g}": row["noiseYY"], f"floor{time:g}": row["noiseFloorOfField"], f"inside{time:g}": inside}
        for name in references:
            out |= {f"{name}Error{time:g}": row[f"error {name}"], f"{name}ErrorSmoothed{time:g}": row[f"smoothed {name}"],
                    f"{name}Stress{time:g}": row[f"size {name}"]}
    end, peak = rows[-1], max(history, key=lambda row: row["kineticEnergy"])
    last = nearest(history, TIMES[-1])
    out |= {"correlation": end["overburdenCorrelation"], "correlationSmoothed": end["correlationSmoothed"],
            "volumeError": end["volumeError"], "transferLoss": end["transferLoss"]}
    out |= {word: end[word] for word in ("relaxationLoss", "averagingLoss", "gapWork")}
    viscous = end.get("viscosityLoss", viscosity_loss(folder_of(case, TIMES[-1]) / "state.h5") / end["releasedEnergy"])
    out |= {"viscosityLoss": viscous, "remedyLoss": end["remedyEnergyLoss"] + (0 if "viscosityLoss" in end else abs(viscous))}
    out |= {"toe": last["minX"], "crest": last["maxY"], "kineticPeak": peak["kineticEnergy"], "kineticPeakTime": peak["time"],
            "kineticAtEnd": history[-1]["kineticEnergy"] / peak["kineticEnergy"], "endTime": history[-1]["time"],
            "particles": last["particles"]}
    return out
