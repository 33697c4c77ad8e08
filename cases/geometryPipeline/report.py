#!/usr/bin/python3
"""Measures volume and mass at every stage from drawing to drawing (etc/sceneReport.py has the options)."""

import math
import os
import re
import shutil
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

DENSITY = 1600  # [kg/m^3]
LENGTH, WIDTH, HEIGHT, RADIUS = 0.24, 0.16, 0.12, 0.06  # geometry/body.geo [m]; profile.geo: a quarter of a circle, in 2D
CUT = {3: HEIGHT * math.pi * RADIUS**2 / 2, 2: math.pi * RADIUS**2 / 4}
DRAWN = {3: HEIGHT * LENGTH * WIDTH - CUT[3], 2: HEIGHT * LENGTH - CUT[2]}
CHORDS = {2: 180, 3: 130}  # of a full circle, at least (libmpm/geometry/gmshMesh.hpp)


def surface_files(case):
    """postProcessing/surface_<time>.msh and .stl of the last time."""
    files = sorted((case / "postProcessing").glob("surface_*.msh"), key=lambda p: float(p.stem[8:]))
    if not files:
        raise SystemExit(f"{case}: no surface; run Allrun")
    return files[-1], files[-1].with_suffix(".stl")


def make_variants(case):
    """plane: the same in plane strain; again, planeAgain: with the deformed bodies for geometry, once there are surfaces."""
    grid = {"dimension": "2", "min": "(-0.2 -0.008 0)", "max": "(0.44 0.144 0)", "cellSize": "0.008"}
    plane = {**{("system/gridDict", word): value for word, value in grid.items()}, ("constant/g", "value"): "(0 -9.81 0)",
             ("constant/boundaryConditions", "plane"): "{ normal (0 -1 0)", ("system/controlDict", "deltaT"): "1.25e-4"}
    report.variant(case, "plane", {**plane, ("system/seedParticlesDict", "geometry"): '"geometry/profile.geo"'})
    for name, source, more in (("again", case, {}), ("planeAgain", case / "variants" / "plane", plane)):
        if list((source / "postProcessing").glob("surface_*.msh")):
            again = report.variant(case, name, {**more, ("system/seedParticlesDict", "geometry"): '"geometry/deformed.msh"'})
            shutil.copy(surface_files(source)[0], again / "geometry" / "surface.msh")


# Meshes, read without libmpm ----------------------------------------------------------------------------------------

def read_msh(path):
    """Points (N, 3) and elements by gmsh's type (1 line, 2 triangle, 4 tetrahedron) of an ASCII mesh 4.1."""
    sections = dict(re.findall(r"\$(\w+)\n(.*?)\n\$End\1", Path(path).read_text(), re.S))
    assert sections["MeshFormat"].startswith("4.1 0")
    lines = iter(sections["Nodes"].split("\n"))
    tags, points = [], []
    for _ in range(int(next(lines).split()[0])):
        count = int(next(lines).split()[3])
        tags += [int(next(lines)) for _ in range(count)]
        points += [[float(x) for x in next(lines).split()] for _ in range(count)]
    number = {tag: i for i, tag in enumerate(tags)}
    elements = {}
    lines = iter(sections["Elements"].split("\n"))
    for _ in range(int(next(lines).split()[0])):
        _, _, kind, count = (int(word) for word in next(lines).split())
        for _ in range(count):
            elements.setdefault(kind, []).append([number[int(word)] for word in next(lines).split()[1:]])
    return np.array(points), {kind: np.array(rows) for kind, rows in elements.items()}


def read_stl(path):
    """Triangles (N, 3, 3) of a binary STL file."""
    data = Path(path).read_bytes()
    count = int.from_bytes(data[80:84], "little")
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    return np.frombuffer(data, record, count, 84)["corners"].astype(float)


def enclosed(corners):
    """Volume inside closed, outward triangles (N, 3, 3); area inside segments (N, 2, 3)."""
    p = corners - corners.mean(axis=(0, 1))
    normal = np.cross(p[:, -2], p[:, -1])
    return np.einsum("ni,ni->", p[:, 0], normal) / 6 if p.shape[1] == 3 else normal[:, 2].sum() / 2


def open_edges(elements):
    """What is not passed once in each direction, edges or (2D) points: 0 for a closed, oriented surface."""
    if elements.shape[1] == 2:
        return int((np.bincount(elements[:, 0]) != np.bincount(elements[:, 1])).sum())
    runs = {}
    for t in elements.tolist():
        for a, b in zip(t, t[1:] + t[:1]):
            runs[(a, b)] = runs.get((a, b), 0) + 1
    return sum(count != 1 or (b, a) not in runs for (a, b), count in runs.items())


def filled(points, elements):
    """Volume of tetrahedra, area of triangles."""
    p = points[elements]
    p = (p[:, 1:] - p[:, :1])[:, :, : elements.shape[1] - 1]
    return abs(np.linalg.det(p)).sum() / math.factorial(p.shape[1])


# Measures -----------------------------------------------------------------------------------------------------------

def seeded_volume(folder):
    """Of the region, as seedParticles prints it."""
    found = re.search(r"(?m)^\s*sand\s+sand\s+(\S+)", (folder / "log.seedParticles").read_text())
    return float(found[1])


def outline_volume(case):
    """Before it was matched, over the particles', as extractSurface prints it."""
    row = (case / "log.extractSurface").read_text().split("\n")[2].split()
    return float(row[2]) / float(row[1])


def spread(s):
    """Radii of gyration about the centre of mass along x, y, z, those of the domains in it."""
    r = s["x"] - report.centre(s)
    own = ((s["deformationGradient"] * s["length0"][:, None, :]) ** 2).sum(axis=2) / 12
    return np.sqrt((s["mass"][:, None] * (r**2 + own)).sum(axis=0) / s["mass"].sum())


def stages(numbers, case, again, dim):
    h = report.entry(case, "system/gridDict", "cellSize")
    first, last, new = report.state(case, 0), report.state(case), report.state(again, 0)
    v0, v1, v2 = (s["volume"].sum() for s in (first, last, new))
    m0, m1, m2 = (s["mass"].sum() for s in (first, last, new))
    points, elements = read_msh(surface_files(case)[0])
    elements = elements[dim - 1]  # gmsh's type 1: segments, 2: triangles
    surface = enclosed(points[elements])
    points2, elements2 = read_msh(again / "geometry" / "deformed.msh")
    solid = filled(points2, elements2[{2: 2, 3: 4}[dim]])
    region = seeded_volume(case)
    angle = 2 * math.pi / CHORDS[dim]
    chords = CUT[dim] * (1 - math.sin(angle) / angle) / DRAWN[dim]
    volume = {2: "area", 3: "volume"}[dim]

    def row(what, value, expected, source, least, most, form="+.1e"):
        numbers.add(f"{dim}D, {what}", value, form=form, expected=expected, source=source, least=least, most=most)

    numbers.add(f"{dim}D, 1 drawing: {volume} [m{dim}]", DRAWN[dim], form=".9g", source="closed form")
    row(f"2 .geo, gmsh, closed CGAL region: {volume} against 1", region / DRAWN[dim] - 1, "chords cut the bay",
        f"at least {CHORDS[dim]} chords a circle", 0, 1.05 * chords)
    row(f"3 particles: {volume} against 2", v0 / region - 1, "round-off", "boxes are cut exactly (region printed: 10 digits)", -2e-10, 2e-10)
    row("3 particles: mass over density against 2", m0 / DENSITY / region - 1, "round-off", "the same", -2e-10, 2e-10)
    row("4 collapse: mass against 3", m1 / m0 - 1, "round-off", "particles keep their mass, splits share it", -1e-12, 1e-12)
    row(f"4 collapse: {volume} of the particles against 3", v1 / v0 - 1, "little", "psi = 0; apex returns and open gaps loosen", -0.005, 0.03)
    row(f"5 outline: {volume} against 4", outline_volume(case) - 1, "up to a few per cent",
        "hollows under two alpha are closed, sheared domains overlap and gape", -0.01, 0.08)
    row(f"6 surface .msh: {volume} against 4", surface / v1 - 1, "round-off", "moved in until it is", -1e-8, 1e-8)
    row("6 surface .msh: open edges", open_edges(elements), "0", "closed and facing outward", 0, 0, "d")
    if dim == 3:
        row("6 surface .stl: volume against 4", enclosed(read_stl(surface_files(case)[1])) / v1 - 1, "", "single precision", -1e-5, 1e-5)
    row(f"7 gmsh's {'triangles' if dim == 2 else 'tetrahedra'}: {volume} against 6", solid / surface - 1, "round-off",
        "gmsh keeps the surface's elements", -1e-10, 1e-10)
    row(f"8 particles again: {volume} against 7", v2 / solid - 1, "round-off", "as 3", -1e-10, 1e-10)
    row("8 particles again: mass against 3", m2 / m0 - 1, f"as the {volume} at 4", "loosened soil is seeded with the density of the dictionary",
        v1 / v0 - 1 - 1e-8, v1 / v0 - 1 + 1e-8)
    row("8 centre of mass against 4 [cells]", np.linalg.norm(report.centre(new) - report.centre(last)) / h, "far below a cell",
        "the surface is within a fraction of a cell", 0, 0.1, ".3f")
    row("8 radii of gyration against 4, worst", abs(spread(new) / spread(last) - 1).max(), "in proportion to h", "the same",
        0, 0.02 * h / 0.016, ".4f")


def measure(case):
    numbers = report.Numbers()
    stages(numbers, case, case / "variants" / "again", 3)
    if (case / "variants" / "planeAgain").is_dir():
        stages(numbers, case / "variants" / "plane", case / "variants" / "planeAgain", 2)
    return numbers


def draw(case):
    sketch(case)
    plt = report.plotter()
    figure = plt.figure(figsize=(9, 8), layout="constrained")
    grid = figure.add_gridspec(3, 2, height_ratios=[1.5, 1.5, 1])
    points, elements = read_msh(surface_files(case)[0])
    stages = ((0, "3 particles", report.state(case, 0)), (1, "4 collapse", report.state(case)),
              (3, "8 particles again", report.state(case / "variants" / "again", 0)))
    axes = [figure.add_subplot(grid[k // 2, k % 2], projection="3d") for k in range(4)]
    for k, title, s in stages:
        axes[k].scatter(*s["x"].T, c=s["x"][:, 2], s=2, cmap="viridis", vmin=0, vmax=HEIGHT, rasterized=True, linewidths=0)
        axes[k].set_title(f"{title}: {len(s['x'])}")
    from matplotlib.colors import LightSource
    shaded = axes[2].plot_trisurf(points[:, 0], points[:, 1], points[:, 2], triangles=elements[2], color="#d9c9a3", linewidth=0.1,
                                  edgecolor="0.5", lightsource=LightSource(200, 50))
    shaded.set_rasterized(True)
    axes[2].set_title(f"6 surface: {len(elements[2])} triangles")
    for a in axes:
        a.set(xlim=(-0.1, 0.34), ylim=(-0.08, 0.26), zlim=(0, HEIGHT))
        a.set_box_aspect((0.44, 0.34, HEIGHT), zoom=1.3)
        a.view_init(35, -70)
        a.tick_params(labelsize=5, pad=-3)
    plane = case / "variants" / "plane"
    axes = figure.add_subplot(grid[2, 0])
    report.paint(axes, report.state(plane), "#d9c9a3")
    points, elements = read_msh(surface_files(plane)[0])
    for a, b in elements[1]:
        axes.plot(*points[[a, b], :2].T, "k-", linewidth=0.6)
    report.frame(axes, (-0.16, 0.34), (-0.01, 0.13), f"2D: domains at 4 and the loop at 6, {len(elements[1])} segments")
    axes = figure.add_subplot(grid[2, 1])
    points, elements = read_msh(case / "variants" / "planeAgain" / "geometry" / "deformed.msh")
    axes.triplot(points[:, 0], points[:, 1], elements[2], "k-", linewidth=0.3)
    axes.set_aspect("equal")
    report.frame(axes, (-0.16, 0.34), (-0.01, 0.13), f"2D: 7 gmsh's mesh, {len(elements[2])} triangles")
    report.save(figure, case / "stages.png", 90)


def sketch(case):
    figure, axes = report.sketch_axes((-0.05, 0.5), (-0.055, 0.215), 6)
    along, deep = np.array([1.0, 0.0]), np.array([0.45, 0.35])
    up = np.array([0.0, 1.0])

    def at(x, y, z):
        return x * along + y * deep + z * up

    turn = np.linspace(0, np.pi, 30)
    bay = [(LENGTH / 2 - RADIUS * math.cos(t), RADIUS * math.sin(t)) for t in turn]
    outline = [(0, 0), *bay, (LENGTH, 0), (LENGTH, WIDTH), (0, WIDTH)]
    top = np.array([at(x, y, HEIGHT) for x, y in outline])
    axes.fill(*top.T, color="#d9c9a3", alpha=0.9)
    axes.plot(*np.vstack([top, top[:1]]).T, "k-", linewidth=0.8)
    wall = [at(x, y, HEIGHT) for x, y in bay] + [at(x, y, 0) for x, y in bay[::-1]]
    axes.fill(*np.array(wall).T, color="#9c8b62", zorder=0.4)
    axes.plot(*np.array([at(x, y, 0) for x, y in bay]).T, "k-", linewidth=0.8, zorder=0.5)
    for x in (0, LENGTH / 2 - RADIUS, LENGTH / 2 + RADIUS, LENGTH):
        axes.plot(*np.array([at(x, 0, 0), at(x, 0, HEIGHT)]).T, "k-", linewidth=0.8)
    axes.plot(*np.array([at(LENGTH, WIDTH, 0), at(LENGTH, WIDTH, HEIGHT)]).T, "k-", linewidth=0.8)
    for x0, x1 in ((0, LENGTH / 2 - RADIUS), (LENGTH / 2 + RADIUS, LENGTH)):
        axes.plot(*np.array([at(x0, 0, 0), at(x1, 0, 0)]).T, "k-", linewidth=0.8)
        axes.fill(*np.array([at(x0, 0, 0), at(x1, 0, 0), at(x1, 0, HEIGHT), at(x0, 0, HEIGHT)]).T, color="#c7b588")
    axes.plot(*np.array([at(LENGTH, 0, 0), at(LENGTH, WIDTH, 0)]).T, "k-", linewidth=0.8)
    axes.fill(*np.array([at(LENGTH, 0, 0), at(LENGTH, WIDTH, 0), at(LENGTH, WIDTH, HEIGHT), at(LENGTH, 0, HEIGHT)]).T, color="#b3a277")
    report.arrow(axes, at(0, 0, -0.018), at(LENGTH, 0, -0.018), "0.24 m", (0, -0.012), both=True)
    report.arrow(axes, at(-0.012, 0, 0), at(-0.012, 0, HEIGHT), "0.12 m", (-0.022, 0), both=True)
    report.arrow(axes, at(LENGTH + 0.01, 0, 0), at(LENGTH + 0.01, WIDTH, 0), "0.16 m", (0.03, -0.005), both=True)
    axes.text(*at(LENGTH / 2, RADIUS + 0.045, HEIGHT), "r = 0.06 m", ha="center")
    axes.text(0.42, 0.15, "rough table,\nmu 0.6", ha="center")
    axes.plot([-0.05, 0.5], [-0.045, -0.045], color="0.6", linewidth=0)
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)
