#!/usr/bin/python3
"""Draws figure1.png (stresses, plain above and cured below), cut.png (what a cut reads), motion.png and tradeOff.png."""

import csv
import importlib.machinery
import importlib.util

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from measure import HERE, folder_of, table
from rows import TIMES

SCALE = (-80, 0)                    # [kPa], the same in all panels
COLOURS = "YlGnBu_r"               # lightness follows the value, also in grey and for the colour-blind
BLUE, RED, GREY = "#0072B2", "#D55E00", "#777777"
TITLES = {"plain": "plain scheme", "cured": "stressTreatment automatic"}
GROUPS = {"plain": ("s", "plain scheme"), "single": ("o", "one remedy alone"), "combination": ("^", "W, an earlier combination"),
          "automatic": ("D", "automatic, and with other settings")}
plt.rcParams |= {"font.size": 10, "axes.spines.top": False, "axes.spines.right": False}


def plot_case():
    """etc/plotCase as a module: it reads states and finds outlines."""
    path = str(HERE.parents[1] / "etc/plotCase")
    loader = importlib.machinery.SourceFileLoader("plotCase", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("plotCase", loader))
    loader.exec_module(module)
    return module


def save(figure, name):
    figure.savefig(HERE / name, dpi=160)
    plt.close(figure)
    print(f"wrote {name}")


def stress_panel(axes, snapshot, outline):
    domains = PolyCollection(snapshot.corners, array=snapshot.raw, cmap=COLOURS, edgecolors="face", linewidths=0.35, rasterized=True)
    domains.set_clim(*SCALE)
    axes.add_collection(domains)
    for row in outline.rows:
        axes.plot(*snapshot.places(row).T, color="black", linewidth=0.6)
    axes.axhline(0, color="black", linewidth=1.2)
    axes.set_yticks([])
    axes.spines[["left", "bottom"]].set_visible(False)
    return domains


def panels_to_scale(widths, height):
    """Two rows of panels as wide as what they show, all with one scale of length; and a place for the colour bar."""
    scale, left, gap, below, above, bar = 0.29, 0.75, 0.25, 0.75, 0.35, 1.15    # inches a metre, and inches
    size = left + sum(widths) * scale + gap * (len(widths) - 1) + bar, below + 2 * height * scale + 0.25 + above
    figure = plt.figure(figsize=size)

    def axes(x, y, width, high):
        return figure.add_axes((x / size[0], y / size[1], width / size[0], high / size[1]))

    rows = []
    for bottom in (below + height * scale + 0.25, below):
        starts = [left + sum(widths[:k]) * scale + gap * k for k in range(len(widths))]
        rows.append([axes(start, bottom, width * scale, height * scale) for start, width in zip(starts, widths)])
    return figure, rows, axes(size[0] - bar + 0.15, below + 0.3, 0.18, size[1] - below - above - 0.6)


def figure1(runs):
    plot = plot_case()
    shots = {name: [plot.Snapshot(HERE / name, folder_of(HERE / name, time).name, "yy") for time in TIMES] for name in TITLES}
    outline = plot.Outline(plot.Snapshot(HERE / "plain", folder_of(HERE / "plain", 0).name))
    ends = [max(3.2, 0.3 + max(abs(s[k].corners[:, :, 0] - 2).max() for s in shots.values())) for k in range(len(TIMES))]
    figure, panels, place = panels_to_scale([2 * end for end in ends], 8.5)
    for (name, title), row in zip(TITLES.items(), panels):
        for axes, shot, time, end in zip(row, shots[name], TIMES, ends):
            domains = stress_panel(axes, shot, outline)
            axes.set(xlim=(2 - end, 2 + end), ylim=(-0.1, 8.4))
            axes.set_xticks([] if name == "plain" else np.arange(-6, 11, 4) if end > 6 else [0, 4])
            noise = runs[name][f"noise{time:g}"]
            axes.text(2, 8.3, f"N = {noise:.1f}" if noise >= 1 else f"N = {noise:.2g}", ha="center", va="top", fontsize=12,
                      color=RED if name == "plain" else BLUE)
            axes.set(title=f"t = {time:g} s") if name == "plain" else axes.set_xlabel("x [m]")
        row[0].set_ylabel(title, fontsize=12, fontweight="bold")
    bar = figure.colorbar(domains, cax=place, extend="both")
    bar.set_label("vertical stress that particles carry [kPa]")
    save(figure, "figure1.png")


def cut(_):
    """Raw stresses of the particles on a vertical line through the middle of the heap at rest."""
    plot = plot_case()
    lowest = -105
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.6), sharey=True, sharex=True, layout="constrained")
    for axes, name, colour in zip(panels, TITLES, (RED, BLUE)):
        for run, shade, size in ((name + "Fine", GREY, 2), (name, colour, 5)):
            shot = plot.Snapshot(HERE / run, folder_of(HERE / run, 2.5).name, "yy")
            near = np.abs(shot.centre[:, 0] - 2) < 0.4
            if run == name or name == "cured":
                axes.plot(shot.raw[near], shot.centre[near, 1], ".", color=shade, markersize=size,
                          label="each particle" if run == name else "each particle, h/2")
        crest = shot.centre[near, 1].max()
        axes.plot([0, -9.8 * crest], [crest, 0], color="black", linewidth=1, label="weight of what lies above")
        outside = shot.raw[near] < lowest
        axes.set_title(TITLES[name], fontweight="bold")
        if outside.any():
            axes.text(lowest + 2, 0.1, f"{outside.sum()} of {near.sum()} lie further left, one at {shot.raw[near].min():.0f} kPa",
                      color=colour)
        axes.set_xlabel("vertical stress [kPa]")
        axes.legend(frameon=False, loc="upper left")
    panels[0].set(xlim=(lowest, 5), ylim=(0, 4.5), ylabel="y [m], at 2.5 s and |x - 2 m| < 0.4 m")
    save(figure, "cut.png")


def motion(_):
    figure, panels = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    styles = {"plain": (RED, "-", 1.8), "cured": (BLUE, "-", 1.8), "plainFine": (RED, "--", 1.1), "curedFine": (BLUE, "--", 1.1)}
    names = {"plain": "plain", "cured": "automatic", "plainFine": "plain, h/2", "curedFine": "automatic, h/2"}
    for name, (colour, dash, width) in styles.items():
        history = [row for row in table(HERE / name / "postProcessing/history.csv") if row["time"] <= 2.5]
        time = [row["time"] for row in history]
        panels[0].plot(time, [row["kineticEnergy"] / 1e3 for row in history], dash, color=colour, linewidth=width, label=names[name])
        panels[1].plot(time, [row["maxX"] for row in history], dash, color=colour, linewidth=width)
        panels[1].plot(time, [row["maxY"] for row in history], dash, color=colour, linewidth=width)
    panels[0].set_ylabel("kinetic energy [kJ/m]")
    panels[0].legend(frameon=False)
    panels[1].set_ylabel("[m]")
    panels[1].text(0.25, 8.1, "highest particle, y")
    panels[1].text(0.25, 3.2, "right toe, x")
    for axes in panels:
        axes.set_xlabel("time [s]")
        axes.set_xlim(0, 2.5)
        axes.set_ylim(0)
    save(figure, "motion.png")


def trade_off_rows():
    with open(HERE / "tradeOff.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["outcome"] == "end" and row["group"] != "scene"]
    return [{key: float(value) if key in ("noise", "energyLoss", "cost") else value for key, value in row.items()} for row in rows]


def place_labels(axes, points, labels):
    """Each label where it lies farthest from points and labels placed before, among places around its point."""
    figure = axes.figure
    figure.canvas.draw()
    pixels = axes.transData.transform(points)
    frame = axes.get_window_extent()
    boxes = []
    for k in np.argsort(pixels[:, 0]):
        text = axes.annotate(labels[k], points[k], fontsize=8.5, annotation_clip=False)
        size = text.get_window_extent()
        best = None
        for radius in (11, 20, 32, 46, 62, 80):
            for angle in np.arange(0, 360, 20):
                centre = pixels[k] + radius * figure.dpi / 72 * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
                side = np.cos(np.radians(angle))
                low = centre - np.array([(1 - side) / 2 * size.width, size.height / 2])
                box = np.array([low, low + (size.width, size.height)])
                hits = sum(box[0][0] < b[1][0] and b[0][0] < box[1][0] and box[0][1] < b[1][1] and b[0][1] < box[1][1] for b in boxes)
                gaps = np.maximum(0, np.maximum(box[0] - pixels, pixels - box[1]))
                hits += int((np.hypot(*gaps.T) < 9 * figure.dpi / 72).sum())
                hits += 5 * (box[0][0] < frame.x0 or box[1][0] > frame.x1 or box[0][1] < frame.y0 or box[1][1] > frame.y1)
                price = 100 * hits + radius
                if best is None or price < best[0]:
                    best = price, radius, low, box
        text.remove()
        boxes.append(best[3])
        axes.annotate(labels[k], points[k], xytext=(best[2] - pixels[k]) * 72 / figure.dpi, textcoords="offset points", fontsize=8.5,
                      arrowprops={"arrowstyle": "-", "color": GREY, "linewidth": 0.5, "shrinkB": 4} if best[1] > 15 else None)


def points_of(rows):
    return np.array([(row["noise"], 100 * max(row["energyLoss"], 1e-4)) for row in rows])     # 0.01 %: nothing


def scatter(axes, rows):
    points = points_of(rows)
    for group, (marker, label) in GROUPS.items():
        mine = [k for k, row in enumerate(rows) if row["group"] == group]
        shown = axes.scatter(*points[mine].T, c=[100 * (rows[k]["cost"] - 1) for k in mine], cmap="plasma_r", vmin=0, vmax=40,
                             marker=marker, s=80, edgecolors="black", linewidths=0.7, label=label, zorder=3)
    return shown


def all_remedies(axes, rows):
    axes.set(xscale="log", yscale="log", xlim=(0.02, 9), ylim=(0.006, 40))
    axes.fill([0.001, 0.03, 0.03, 0.001], [1e-9, 1e-9, 0.5, 0.5], color="#009E73", alpha=0.15)
    axes.text(0.0207, 0.0068, "goal", color="#007755", fontsize=11)
    scatter(axes, rows)
    axes.set_xlabel("noise N of particle stresses, the largest at 0.5, 1, 1.5, 2.5 s")
    axes.set_ylabel("energy the remedy takes [% of what gravity releases]")
    ticks = [0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30]
    axes.set_yticks(ticks, ["0", *(f"{tick:g}" for tick in ticks[1:])])
    axes.set_xticks([0.03, 0.1, 0.3, 1, 3], ["0.03", "0.1", "0.3", "1", "3"])
    axes.minorticks_off()
    axes.grid(True, color="#e5e5e5", zorder=0)
    axes.legend(loc=(0.1, 0.1), edgecolor="white")


def settings_of_automatic(axes, rows):
    points = points_of(rows)
    shown = scatter(axes, rows)
    low, high = np.minimum(points.min(axis=0), (0.029, 0.49)), points.max(axis=0)
    margin = 0.18 * (high - low)
    axes.set(xlim=(low[0] - margin[0], high[0] + margin[0]), ylim=(low[1] - margin[1], high[1] + margin[1]))
    axes.fill([0, 0.03, 0.03, 0], [0, 0, 0.5, 0.5], color="#009E73", alpha=0.15)
    axes.set_xlabel("N")
    axes.set_title("the settings of automatic, nearer", fontsize=11)
    return shown


def trade_off(_):
    rows = trade_off_rows()
    settings = [row for row in rows if row["group"] in ("automatic", "combination")]
    others = [row for row in rows if row not in settings]
    figure, (left, right) = plt.subplots(1, 2, figsize=(14, 6), layout="constrained", gridspec_kw={"width_ratios": [1.45, 1]})
    all_remedies(left, rows)
    shown = settings_of_automatic(right, settings)
    bar = figure.colorbar(shown, ax=right, extend="both", pad=0.02, shrink=0.9)
    bar.set_label("time a step takes beyond the plain scheme's [%]")
    near = points_of(settings)
    left.annotate("automatic, W", near[0], xytext=(0, 16), textcoords="offset points", ha="center", fontsize=8.5)
    place_labels(left, points_of(others), [row["label"] for row in others])
    place_labels(right, near, [row["label"] for row in settings])
    save(figure, "tradeOff.png")


def main():
    runs = {}
    with open(HERE / "runs.csv", newline="") as file:
        for row in csv.DictReader(file):
            runs[row["run"]] = {key: float(value) if value else float("nan") for key, value in row.items() if key != "run"}
    for draw in (figure1, cut, motion, trade_off):
        draw(runs)


if __name__ == "__main__":
    main()
