"""Runs variants of the column in copies of this case and prints what came out as one table; called by Allvariants."""
import csv
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys

import h5py

HERE = pathlib.Path(__file__).resolve().parent
coarse = {"system/gridDict": {"cellSize": "0.4"}, "system/seedParticlesDict": {"particlesPerCell": "3"}}


def schemes(**words):
    return {"system/mpmSchemes": words}


noSplitting = schemes(splitting=None)
# name: (changed words, threads)
VARIANTS = {
    "as it is": ({}, 1),
    "2 threads": ({}, 2),
    "3 threads": ({}, 3),
    "USF": (schemes(stressUpdate="USF"), 1),
    "USL, deltaT 0.4 ms": ({**schemes(stressUpdate="USL"), "system/controlDict": {"deltaT": "4e-4"}}, 1),
    "cpGIMP": (schemes(shape="cpGIMP"), 1),
    "quadraticBSpline": (schemes(shape="quadraticBSpline"), 1),
    "linear": (schemes(shape="linear"), 1),
    "picRate 0": (schemes(picRate="0"), 1),
    "no splitting": (noSplitting, 1),
    "no splitting, picRate 0": (schemes(splitting=None, picRate="0"), 1),
    "h = 0.4 m": (coarse, 1),
    "h = 0.4 m, USF": ({**coarse, **schemes(stressUpdate="USF")}, 1),
    "h = 0.4 m, USL, deltaT 0.625 ms": ({**coarse, **schemes(stressUpdate="USL"),
                                         "system/controlDict": {"deltaT": "6.25e-4"}}, 1),
}


def change(file, word, value):
    text = file.read_text()
    if value is None:  # a nested dictionary goes
        text, count = re.subn(rf"^{word}\s*\{{[^}}]*\}}", "", text, flags=re.M)
    else:
        text, count = re.subn(rf"^(\s*{word}\s+)[^;]*;", rf"\g<1>{value};", text, count=1, flags=re.M)
    if count != 1:
        sys.exit(f"{file}: found no {word}")
    file.write_text(text)


def run(folder, *command):
    with open(folder / f"log.{command[0]}", "w") as log:
        return subprocess.run(command, cwd=folder, stdout=log, stderr=subprocess.STDOUT).returncode == 0


def fingerprint(folder):
    """Of all particle fields of the last state, in file order."""
    last = max((p for p in folder.iterdir() if (p / "state.h5").exists()), key=lambda p: float(p.name))
    digest = hashlib.sha256()
    with h5py.File(last / "state.h5") as state:
        for name in sorted(state["particles"]):
            digest.update(state["particles"][name][()].tobytes())
    return digest.hexdigest()[:8]


def measure(name, changes, threads):
    folder = HERE / "variants" / re.sub(r"\W+", "_", name).strip("_")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for part in ("geometry", "constant", "system"):
        shutil.copytree(HERE / part, folder / part)
    for file, words in changes.items():
        for word, value in words.items():
            change(folder / file, word, value)
    run(folder, "seedParticles")
    if not run(folder, "mpmSolve", "-threads", str(threads)):
        message = (folder / "log.mpmSolve").read_text().strip().splitlines()
        error = next((line for line in message if line.startswith("-->")), message[-1])
        return [name] + ["-"] * 10 + [error.split("error: ")[-1].split(":")[0]]
    run(folder, "smoothStress", "-latestTime")
    rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(open(folder / "postProcessing/history.csv"))]
    quality = list(csv.DictReader(open(folder / "postProcessing/smoothStress.csv")))[-1]
    end, peak = rows[-1], max(rows, key=lambda row: row["kineticEnergy"])
    lost = next((row["time"] for row in rows if abs(row["minX"] + row["maxX"] - 4) > 1e-9), None)
    speed = re.search(r"speed\s+([\d.]+)", (folder / "log.mpmSolve").read_text()).group(1)
    seconds = re.search(r"steps to .* in (.*) \(", (folder / "log.mpmSolve").read_text()).group(1)
    return [name, f"{end['particles']:.0f}", f"{end['minX']:.2f}, {end['maxX']:.2f}", f"{end['maxY']:.2f}",
            f"{peak['kineticEnergy'] / 1e3:.1f} at {peak['time']:.2f}", f"{100 * end['kineticEnergy'] / peak['kineticEnergy']:.2f}",
            f"{100 * end['residual'] / end['gravityWork']:.2f}", f"{float(quality['noise']):.2f}",
            f"{float(quality['noiseByMass']):.2f}", "to the end" if lost is None else f"{lost:.2f} s", f"{speed}; {seconds}",
            fingerprint(folder)]


HEADS = ["variant", "particles", "toes x [m]", "crest [m]", "peak kinetic [kJ/m] at [s]", "kinetic at end [% of peak]",
         "residual [% of gravity work]", "N", "N by mass", "mirror-symmetric (1e-9 m)", "ns a particle and step; total",
         "fingerprint of the end"]
lines = ["| " + " | ".join(HEADS) + " |", "| " + " | ".join(["---"] * len(HEADS)) + " |"]
print("\n".join(lines), flush=True)
for name, (changes, threads) in VARIANTS.items():
    lines.append("| " + " | ".join(measure(name, changes, threads)) + " |")
    print(lines[-1], flush=True)
(HERE / "postProcessing").mkdir(exist_ok=True)
(HERE / "postProcessing" / "variants.md").write_text("\n".join(lines) + "\n")
