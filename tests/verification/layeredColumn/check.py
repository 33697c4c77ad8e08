"""A column of rock, clay and sand, three laws in one scene, under its own weight.
Measured: vertical stress as mean of each cell, lateral over vertical stress of every particle, and settlement of the
surface, against the cell size; and the same column of one soil under one name and under three.
Pass: vertical stress of cells within 0.002 % of the base's of the weight above, lateral over vertical stress
nu/(1 - nu) of the particle's own material to round-off, settlement within 0.1 % with 56 cells and with order 1.8
or more; one soil by three names, with softening and plastic flow, is the same to the last bit."""
import numpy as np
from verification import Verification

case = Verification(__file__, __doc__)
G = 0.1  # strains stay below 1e-4 [m/s^2]
LAYERS = {"sand": (4, 6, 1600, 20e6, 0.3), "clay": (2, 4, 1900, 10e6, 0.45), "rock": (0, 2, 2400, 40e6, 0.25)}  # from, to, rho, E, nu


def weight(Y):
    """Of what lies above Y [Pa]."""
    return sum(rho * G * np.clip(top - np.maximum(Y, low), 0, None) for low, top, rho, _, _ in LAYERS.values())


def settlement():
    """Of the surface: sum of the mean stress of a layer over its oedometric modulus."""
    return sum((top - low) * 0.5 * (weight(low) + weight(top)) / (E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)))
               for low, top, _, E, nu in LAYERS.values())


def errors(N):
    h = 7 / N
    run = case.solve(f"N{N}", ("constant/g", "value", f"(0 {-G} 0)"), ("system/gridDict", "cellSize", repr(h)), ("system/controlDict", "deltaT", repr(h / 500)))
    first, last = run.state(0), run.state()
    Y, stress = first.by_id("position")[:, 1], last.by_id("stress")
    cell = np.floor(Y / h).astype(int)
    means = np.array([stress[cell == i, 1].mean() + weight(Y[cell == i]).mean() for i in range(cell.max() + 1)])
    nu = np.select([(Y > low) & (Y < top) for low, top, *_ in LAYERS.values()], [n for *_, n in LAYERS.values()])
    ratio = stress[:, 0] / stress[:, 1] / (nu / (1 - nu)) - 1
    top = Y > Y.max() - 1e-9
    sunk = (Y - last.by_id("position")[:, 1])[top].mean()
    case.check(f"mean vertical stress of a cell over that of the base, less the overburden ({N} cells)",
               np.abs(means).max() / weight(0), "<=", 2e-5)
    case.check(f"lateral over vertical stress over nu/(1 - nu), less 1 ({N} cells)", np.abs(ratio).max(), "<=", 1e-9)
    return {"settlement of the surface": abs(sunk / settlement() - 1),
            "vertical stress of particles": np.sqrt(np.mean((stress[:, 1] + weight(Y)) ** 2)) / weight(0)}


study = case.study("three laws", "N", (14, 28, 56), errors)
case.check("settlement (56 cells)", study.errors["settlement of the surface"][-1], "<=", 1e-3)
case.check_order(study, "settlement of the surface", 1.8)


def named(*names):
    """The column of these materials, from the bottom up, without damping: it swings and yields."""
    regions = "".join(f"    {region} {{ material {name}; }}\n" for region, name in zip(("below", "middle", "above"), names))

    def change(run):
        path = run.folder / "system/seedParticlesDict"
        path.write_text("particlesPerCell 2;\nregions\n{\n" + regions + "}\n")
        run.remove("system/mpmSchemes", "damping")
        run.set("system/controlDict", "endTime", 0.5)
        run.set("system/controlDict", "writeInterval", 0.25)
    return case.solve("-".join(names), change)


alike, apart = named("one", "one", "one"), named("one", "two", "three")
a, b = alike.state(), apart.state()
case.check("plastic strain of the one soil", a["plasticStrain"].max(), ">", 1e-3)
for name in a.particles:
    if name != "material":
        case.check(f"values of {name} that three names change", int((a.by_id(name) != b.by_id(name)).sum()), "==", 0)
case.check("materials", len(np.unique(b["material"])), "==", 3)
case.check("change of the dissipation", abs(a.ledger["plasticDissipation"] - b.ledger["plasticDissipation"]), "==", 0)
case.finish()
