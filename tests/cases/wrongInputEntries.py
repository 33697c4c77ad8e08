"""Words for the wrong inputs of wrongInputList.py and wrongEffectList.py."""

import os
import re
from collections.abc import Callable
from dataclasses import dataclass

import h5py
import numpy as np

import errorTable
from wrongInputEdits import (append, attribute, both, compressed, cut, edit, linked, other_case, other_dimension, put,
                             remove, replaced, state, write)


@dataclass
class Entry:
    what: str
    command: str
    change: Callable | None = None
    seeded: bool = True


def law(name, words):
    """The column's material with another law."""
    return write("constant/materialProperties", f"soil\n{{\n    law {name}; density 1000; E 20e6; nu 0.42;\n    {words}\n}}\n")


def seed(what, change):
    return Entry(what, "seedParticles", change, seeded=False)


def solve(what, change):
    return Entry(what, "mpmSolve", change)


def load(what, text, *changes):
    """gravityLoading with this dictionary."""
    return Entry(what, "gravityLoading", both(write(LOADING, text + "\n"), *changes))


def cost(what, text):
    return Entry(what, "accuracyCost", None if text is None else write(COST, text + "\n"), seeded=False)


def plain(case):
    """Without strain paths, which a coupled case does not record."""
    path = case / "system" / "controlDict"
    path.write_text(re.sub(r"(?ms)^recordStrain.*?^}\n", "", path.read_text()))


def couple(what, words):
    """mpmCouple with two surfaces, and what preciceCoupling says of them (None: it is not there)."""
    walls = "".join(f"{name} {{ type Rigid; points (({x} 0.3) ({x + 1} 0.3) ({x + 1} 6) ({x} 6)); }}\n"
                    for name, x in (("wall", 4.2), ("other", 6.2)))
    text = f"surfaces\n{{\n{walls}}}\n"
    if words is not None:
        config = "" if "config " in words else "config \"precice-config.xml\"; "
        text += f"preciceCoupling\n{{\n{config}{words}\n}}\n"
    return Entry(what, "mpmCouple -dry-run",
                 both(plain, write("system/couplingDict", text), write("precice-config.xml", "<a/>")))


GRID, SCHEMES, CONTROL, SEED = "system/gridDict", "system/mpmSchemes", "system/controlDict", "system/seedParticlesDict"
SPLIT, CHECK = "system/splitParticlesDict", "system/checkIntegrationDict"
LOADING = "system/gravityLoadingDict"
MATERIAL, WALLS, GRAVITY = "constant/materialProperties", "constant/boundaryConditions", "constant/g"
COLUMN, COST = "geometry/column.geo", "system/accuracyCostDict"
MEASURE = " measures { runOut { history maxX; against finest; } }"
FORCE = "constant/bodyForce"
SQUARE = ("Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
          "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n")

def contact(what, words, change=None):
    """Two materials, and what constant/contactProperties says of them."""
    return Entry(what, "mpmSolve", both(attribute("materials", np.array([b"soil", b"plane"])),
                                        append(MATERIAL, "plane { law linearElastic; density 1000; E 20e6; nu 0.3; }\n"),
                                        write("constant/contactProperties", words + "\n"), *([change] if change else [])))


def measured(*rows):
    """postProcessing/accuracyCost.csv with these rows."""
    return lambda case: errorTable.write(case, rows)


SURFACE = "system/extractSurfaceDict"


def torn(file):
    """What is right of the middle goes two metres to the right."""
    x = file["particles/position"][()]
    x[x[:, 0] > 2, 0] += 2
    file["particles/position"][...] = x


def scattered(file):
    """The particles at their places, a tenth as wide."""
    file["particles/length0"][...] = file["particles/length0"][()] / 10


BODIES = "constant/rigidBodies"
ABSORBING = "side { type absorbing; material soil; plane { normal (-1 0 0); position 0; } }\n"


def moving(words):
    """The column's base with a motion."""
    return edit(WALLS, "    separation      on; ", f"    motion {{ {words} }}\n    separation      on; ")


def body(words):
    return write(BODIES, f"blade {{ {words} }}\n")


def treated(words, change=None):
    """More words for mpmSchemes."""
    return both(append(SCHEMES, words + "\n"), *([change] if change else []))


def remedy(words):
    return treated(f"stressTreatment {{ {words} }}")


dilating = edit(MATERIAL, "dilationAngle   0;", "dilationAngle   5;")
elastic = both(law("neoHookean", ""), state(lambda file: file["particles/stress"].write_direct(np.zeros((1800, 4)))))
