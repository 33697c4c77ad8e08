"""What the reports of the cases share: states and histories, variants of a case, heaps, drawings, numbers beside what
they should be, and the generated part of a README.

A case's report.py is written with it:

    measure(folder) -> Numbers       reads the run(s) below a folder, no drawing; tests of scaled-down copies call it too
    draw(folder)                     figures beside README.md
    variants(folder)                 copies of the case with other words (variant), where there are some
    main(measure, draw, variants)    the command line

    report.py                        measured.csv, figures, README.md; every number beside its expectation; 1 if one is outside
    report.py -variants              makes variants/, whose runs Allrun does
    report.py -check                 1 if README.md is not what measured.csv says

The part of README.md that is written stands between `<!-- measured -->` and `<!-- end -->`.
"""

import csv
import math
import os
import re
import shutil
import sys
from pathlib import Path

import h5py
import numpy as np

TIME_NAME = re.compile(r"[0-9]+(\.[0-9]+)?(e-?[0-9]+)?")
PART = re.compile(r"(<!-- measured -->\n).*?(<!-- end -->)", re.S)


# Runs -----------------------------------------------------------------------------------------------------------------

class State:
    """A stored time: particle fields by name (x: position, v: velocity), ledger, attributes."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.attributes = dict(file.attrs)
            self.fields = {name: item[()] for name, item in file["particles"].items()}
            self.ledger = {name: item[()] for name, item in file["ledger"].items()}
        self.time = float(self.attributes["time"])
        names = self.attributes.get("materials", [])
        self.materials = [name.decode() if isinstance(name, bytes) else str(name) for name in np.atleast_1d(names)]

    def __getitem__(self, name):
        return self.fields[{"x": "position", "v": "velocity"}.get(name, name)]

    def of(self, material):
        """Which particles are of this material."""
        return self["material"] == self.materials.index(material)

    def by_id(self, name):
        return self[name][np.argsort(self["id"])]

    def corners(self):
        """(N, 4, 2): the deformed domains of a plane-strain state."""
        edges = self["deformationGradient"] * self["length0"][:, None, :] / 2
        signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        return self["x"][:, None, :] + np.einsum("ck,pak->pca", signs, edges)


def times(folder):
    """Time -> its folder, in order."""
    found = {float(p.parent.name): p.parent for p in Path(folder).glob("*/state.h5") if TIME_NAME.fullmatch(p.parent.name)}
    if not found:
        raise SystemExit(f"{folder}: no stored time; run Allrun")
    return dict(sorted(found.items()))


def state(folder, time=math.inf):
    """The stored state nearest to a time; the last one without."""
    stored = times(folder)
    return State(stored[max(stored) if time == math.inf else min(stored, key=lambda t: abs(t - time))] / "state.h5")


def states(folder):
    """One after the other, in order of time."""
    return (State(path / "state.h5") for path in times(folder).values())


def series(folder, name="history"):
    """Columns of postProcessing/<name>.csv."""
    return np.atleast_1d(np.genfromtxt(Path(folder) / "postProcessing" / f"{name}.csv", delimiter=",", names=True))


def entry(folder, file, word):
    """The number a dictionary entry that begins a line holds; the first number of a list."""
    found = re.search(rf"(?m)^\s*{word}\s+\(?\s*([-+.\deE]+)", (Path(folder) / file).read_text())
    if not found:
        raise SystemExit(f"{folder}/{file}: found no number {word}")
    return float(found[1])


def variant(folder, name, changes):
    """variants/<name>: a copy of the case with other words; changes: {(file, word): value}, in files that use `word value;`
    or, in geometry, `word = value;`; {(file, None): None} leaves a file out. The folder."""
    case = Path(folder) / "variants" / name
    for part in ("geometry", "constant", "system"):
        shutil.copytree(Path(folder) / part, case / part, dirs_exist_ok=True)
    for (file, word), value in changes.items():
        if word is None:
            (case / file).unlink()
            continue
        equals = "= " if file.startswith("geometry/") else ""
        text, count = re.subn(rf"(?m)^(\s*{word}\s+){equals}[^;]*;", rf"\g<1>{equals}{value};", (case / file).read_text())
        if count != 1:
            raise SystemExit(f"{case / file}: found {count} entries {word}, one is needed")
        (case / file).write_text(text)
    return case


# Measures -------------------------------------------------------------------------------------------------------------

def centre(s, part=slice(None), field="x"):
    """Mean of a field by mass: where a body is, or how fast it moves."""
    m = s["mass"][part]
    return (m[:, None] * s[field][part]).sum(axis=0) / m.sum()


def turned(first, last, part):
    """Angle [rad] by which a plane body has turned, counter-clockwise, as best fit; particles in the order of their ids."""
    r0, r1 = (s.by_id("x")[part] - s.by_id("x")[part].mean(axis=0) for s in (first, last))
    return math.atan2((r0[:, 0] * r1[:, 1] - r0[:, 1] * r1[:, 0]).sum(), (r0 * r1).sum())


def heap_profile(s, density, edges, radial=False):
    """Height of the heap as if it had its first density [m], between edges of x or (radial: a quarter of a circle) of the
    radius: mass/(density x ground). A particle counts over its width."""
    x = np.hypot(s["x"][:, 0], s["x"][:, 1]) if radial else s["x"][:, 0]
    dim = s["x"].shape[1]
    half = 0.5 * (s["volume"]) ** (1 / dim)
    share = np.zeros(len(edges) - 1)
    for k in range(len(edges) - 1):
        inside = np.minimum(x + half, edges[k + 1]) - np.maximum(x - half, edges[k])
        share[k] = (s["mass"] * np.clip(inside, 0, None) / (2 * half)).sum()
    ground = np.diff(np.pi / 4 * edges**2) if radial else np.diff(edges)
    return share / (density * ground)


def front(edges, height, least):
    """Where the height falls below `least` for good, linear between the middles of the bins."""
    middle = 0.5 * (edges[1:] + edges[:-1])
    above = np.flatnonzero(height >= least)
    if not len(above):
        return 0.0
    k = above[-1]
    if k + 1 == len(height):
        return float(edges[-1])
    return float(middle[k] + (middle[k + 1] - middle[k]) * (height[k] - least) / (height[k] - height[k + 1]))


def shear_strain(s):
    """Largest shear of the deformed particles: sqrt of the second invariant of the deviator of ln V, times 2 [-]."""
    F = s["deformationGradient"]
    values = 0.5 * np.log(np.linalg.eigvalsh(F @ np.swapaxes(F, 1, 2)))
    if F.shape[1] == 2:
        values = np.concatenate([values, np.zeros((len(values), 1))], axis=1)
    dev = values - values.mean(axis=1)[:, None]
    return 2 * np.sqrt(0.5 * (dev**2).sum(axis=1))


# Numbers and README ---------------------------------------------------------------------------------------------------

class Numbers:
    """Rows of what was measured, and what it should be. A row without bounds is told, not judged."""

    HEADS = ["what", "measured", "unit", "expected", "source", "least", "most", "inside"]

    def __init__(self):
        self.rows = []

    def add(self, what, measured, unit="", expected="", source="", least=-math.inf, most=math.inf, form=".3g"):
        judged = math.isfinite(least) or math.isfinite(most)
        inside = ("yes" if least <= measured <= most else "NO") if judged else ""
        self.rows.append(dict(zip(self.HEADS, (what, format(measured, form), unit, expected, source, least, most, inside))))
        return measured

    def failed(self):
        return [row for row in self.rows if row["inside"] == "NO"]

    def print(self):
        for row in self.rows:
            said = f"{row['what']}: {row['measured']} {row['unit']}"
            print(f"{({'yes': 'ok  ', 'NO': 'FAIL'}.get(row['inside'], '    '))}  {said}"
                  + (f"  ({band(row)}{'; ' if band(row) and row['expected'] else ''}{row['expected']})"
                     if band(row) or row["expected"] else ""))

    def write(self, path):
        with open(path, "w", newline="") as file:
            out = csv.DictWriter(file, self.HEADS, lineterminator="\n")
            out.writeheader()
            out.writerows(self.rows)


def band(row):
    """The bounds of a row in words."""
    least, most = float(row["least"]), float(row["most"])
    if math.isfinite(least) and math.isfinite(most):
        return f"{least:.3g} to {most:.3g}"
    return f">= {least:.3g}" if math.isfinite(least) else f"<= {most:.3g}" if math.isfinite(most) else ""


def table(rows):
    lines = ["| | measured | expected | band | inside | source |", "| --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        cells = (row["what"], f"{row['measured']} {row['unit']}".strip(), row["expected"], band(row), row["inside"], row["source"])
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def with_table(text, rows):
    if len(PART.findall(text)) != 1:
        raise SystemExit("README.md must have one place <!-- measured --> ... <!-- end -->")
    return PART.sub(lambda found: found[1] + table(rows) + found[2], text)


def main(measure, draw, variants=None):
    """The command line, for the folder of the script."""
    here = Path(sys.argv[0]).resolve().parent
    readme, numbers = here / "README.md", here / "measured.csv"
    if sys.argv[1:] == ["-check"]:
        with open(numbers, newline="") as file:
            same = with_table(readme.read_text(), list(csv.DictReader(file))) == readme.read_text()
        sys.exit(0 if same else "README.md is not what report.py writes: run it")
    if sys.argv[1:] == ["-variants"] and variants:
        return variants(here)
    if sys.argv[1:]:
        sys.exit("report.py [-check]" + (" [-variants]" if variants else ""))
    found = measure(here)
    found.write(numbers)
    draw(here)
    if readme.exists():
        readme.write_text(with_table(readme.read_text(), found.rows))
    found.print()
    failed = found.failed()
    print(f"{here.name}: " + (f"{len(failed)} numbers outside their band" if failed else "all numbers inside their bands"))
    sys.exit(1 if failed else 0)


# Drawing --------------------------------------------------------------------------------------------------------------

def plotter():
    """matplotlib.pyplot for files."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "libmpm", "font.size": 8, "axes.titlesize": 8, "legend.fontsize": 7})
    import matplotlib.pyplot as plt
    return plt


def save(figure, path, dpi=110):
    """Whole or not there."""
    path = Path(path)
    part = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    figure.savefig(part, dpi=dpi, metadata={"Date": None} if path.suffix == ".svg" else {"Software": None})
    part.replace(path)
    plotter().close(figure)
    print(f"wrote {path.name}")


def paint(axes, s, values, limits=None, cmap="viridis", part=slice(None)):
    """Deformed domains of a plane-strain state, coloured by a value each (or a colour for all)."""
    from matplotlib.collections import PolyCollection

    plain = isinstance(values, str)
    domains = PolyCollection(s.corners()[part], facecolors=values if plain else None, array=None if plain else np.asarray(values)[part],
                             cmap=cmap, edgecolors="none", rasterized=True)
    if not plain and limits:
        domains.set_clim(*limits)
    axes.add_collection(domains)
    axes.set_aspect("equal")
    return domains


def frame(axes, x, y, title=""):
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.set_title(title)


def bar(figure, domains, axes, label, **options):
    figure.colorbar(domains, ax=axes, **{"shrink": 0.8, "aspect": 30, "extend": "max", **options}).set_label(label)


def wall(axes, x, y, thick, colour="0.6"):
    """A hatched wall along the line from (x0, y0) to (x1, y1), as thick as said, on its right-hand side."""
    from matplotlib.patches import Polygon

    (x0, x1), (y0, y1) = x, y
    length = math.hypot(x1 - x0, y1 - y0)
    nx, ny = thick * (y1 - y0) / length, -thick * (x1 - x0) / length
    axes.add_patch(Polygon([(x0, y0), (x1, y1), (x1 + nx, y1 + ny), (x0 + nx, y0 + ny)], closed=True, facecolor="none",
                           edgecolor=colour, hatch="////", linewidth=0))
    axes.plot([x0, x1], [y0, y1], color="black", linewidth=1.2)


def arrow(axes, start, end, text="", at=(0, 0), both=False, colour="black"):
    """An arrow (both: a measure line), its text beside its middle."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": "<->" if both else "->", "linewidth": 1, "color": colour,
                                              "shrinkA": 0, "shrinkB": 0})
    if text:
        axes.text((start[0] + end[0]) / 2 + at[0], (start[1] + end[1]) / 2 + at[1], text, ha="center", va="center", color=colour)


def sketch_axes(x, y, width=5.5):
    """A drawing without axes of these limits."""
    plt = plotter()
    figure, axes = plt.subplots(figsize=(width, width * (y[1] - y[0]) / (x[1] - x[0])), layout="constrained")
    frame(axes, x, y)
    axes.set_aspect("equal")
    axes.axis("off")
    return figure, axes
