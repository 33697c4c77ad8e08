"""The collapsing soil column, to 4 s: whether the heap comes to rest.
Measured: kinetic energy at 4 s over its peak, of the particles and of what the grid sees of their velocities; how far
anything moves in the last half second, and what is still lost at the apex of the yield surface in it.
Pass: with splitting, picRate 3 and a treatment, kinetic energy below 1e-6 of its peak, nothing moves by more than 1 mm in the last
half second; the peak is that of the plain scheme within 5 %."""
import numpy as np
from verification import LONG, PROJECT, Number, Verification, treatment

NAMES = ("plain", "automatic")

case = Verification(__file__, __doc__)
case.source = PROJECT / "cases/collapsingSoilColumn"
CELL = 4 / 15


def hat(d, l):
    """uGIMP's weight at a distance d from a node, half-length l, both in cells."""
    return np.where(d < l, 1 - (d * d + l * l) / (2 * l), np.where(d < 1 - l, 1 - d, np.where(d < 1 + l, (1 + l - d) ** 2 / (4 * l), 0)))


def grid_energy(state):
    """1/2 sum m_i v_i^2 of the particles' velocities projected onto the nodes."""
    x, l = state["position"] / CELL, 0.5 * state["length0"] / CELL
    low = np.floor(x.min(axis=0)).astype(int) - 1
    size = np.floor(x.max(axis=0)).astype(int) - low + 3
    node, table = np.floor(x).astype(int), np.zeros((size.prod(), 3))
    momentum = state["mass"][:, None] * np.column_stack([np.ones(len(x)), state["velocity"]])
    for i in range(-1, 3):
        for j in range(-1, 3):
            at = node + (i, j)
            weight = hat(np.abs(x - at), l).prod(axis=1)
            np.add.at(table, (at - low) @ (size[1], 1), weight[:, None] * momentum)
    table = table[table[:, 0] > 0]
    return 0.5 * float((table[:, 1:] ** 2 / table[:, :1]).sum())


def rest(what, word):
    changes = [("system/controlDict", "endTime", 4), ("system/controlDict", "writeInterval", 0.5), treatment(word)]
    if what == "no splitting":
        changes.append(lambda run: run.remove("system/mpmSchemes", "splitting"))
    if what.startswith("picRate"):
        changes.append(("system/mpmSchemes", "picRate", int(what.split()[1])))
    run = case.solve(f"{what.replace(' ', '-')}-{len(rows)}", *changes)
    history, before, after = run.series(), run.state("3.5"), run.state("4")
    peak = history["kineticEnergy"].max()
    _, a, b = np.intersect1d(before["id"], after["id"], return_indices=True)
    late = np.searchsorted(history["time"], 3.5)
    return {"peak [J/m]": peak, "at 4 s": history["kineticEnergy"][-1] / peak, "on the grid": grid_energy(after) / peak,
            "moved [m]": np.linalg.norm(after["position"][b] - before["position"][a], axis=1).max(),
            "apex [m^2]": history["apexVolume"][-1] - history["apexVolume"][late]}


# what no criterion needs
NIGHTLY = [["splitting", "automatic"], ["no splitting", "plain"], ["no splitting", "automatic"], ["picRate 0", "automatic"]]
rows, plain = [], {}
for what, words in (("splitting", NAMES), ("picRate 3", NAMES), ("no splitting", NAMES), ("picRate 0", NAMES)):
    for word in words:
        if [what, word] in NIGHTLY and not LONG:
            continue
        found, tag = rest(what, word), f"({what}, {word})"
        plain.setdefault(what, found)
        rows.append([what, word, Number(found["peak [J/m]"] / 1e3, ".1f", 0.01)] +
                    [Number(found[name], ".0e", 2, floor=1e-9) for name in ("at 4 s", "on the grid", "moved [m]", "apex [m^2]")])
        print("      " + tag + ", ".join(f" {name} {value:.3g}" for name, value in found.items()))
        if what == "picRate 3" and word != "plain":
            case.check(f"kinetic energy at 4 s over its peak {tag}", found["at 4 s"], "<", 1e-6)
            case.check(f"largest move in the last half second {tag}", found["moved [m]"], "<=", 1e-3, "m")
            case.check(f"peak over that of the plain scheme, less 1 {tag}",
                       abs(found["peak [J/m]"] / plain[what]["peak [J/m]"] - 1), "<=", 0.05)
case.check("kinetic energy at 4 s over its peak (splitting, plain)", plain["splitting"]["at 4 s"], "<", 3e-6)
case.check("of it on the grid, without PIC (plain)", plain["picRate 0"]["on the grid"], "<", 1e-6)
case.table("", ["column", "treatment", "peak [kJ/m]", "at 4 s over peak", "on the grid over peak", "moved 3.5 to 4 s [m]",
                "volume dropped at the apex 3.5 to 4 s [m^2]"], rows, NIGHTLY)
case.finish()
