"""Bearing capacity of a strip load on weightless soil.
Measured: the load at which settlement begins to flow, over the cohesion, against Prandtl's N_c; its trend with the cell
size.
Pass: friction angle 0 (N_c = 2 + pi): a flexible strip within 5 % with 16 cells in half its width, in uGIMP, and nearer
with every halving of the cells; a rigid rough footing comes down on it from above; friction and dilation angle 30 degrees
(N_c = 30.14): within 4 % with 8 cells; without dilation not above that by more than 4 % and not below 90 % of it."""
import math

import numpy as np
from limitLoad import LimitLoad, at_rate_zero, mean_move, surface_group
from verification import Number, Verification, schemes

case = Verification(__file__, __doc__)
C, HALF = 10e3, 1.0  # cohesion [Pa], half width of the strip [m]


def prandtl(phi):
    if phi == 0:
        return 2 + math.pi
    t = math.tan(math.radians(phi))
    return (math.exp(math.pi * t) * math.tan(math.radians(45 + phi / 2)) ** 2 - 1) / t


rows = []


def limit(what, phi, psi, h, levels, shape="uGIMP", start=4.0, hold=0.3, courant=400, *changes):
    """courant: cells per time step [m/s]. The flow is steady within 5 relaxation times of 0.02 s."""
    run = case.seed(f"{what.replace(' ', '-')}-{phi}-{psi}-{shape}-{h:g}", *schemes(shape, "MUSL"),
                    ("system/gridDict", "cellSize", h), ("system/controlDict", "deltaT", repr(round(h / courant, 9))),
                    ("constant/materialProperties", "frictionAngle", phi),
                    ("constant/materialProperties", "dilationAngle", psi), *changes)
    under = surface_group(run, lambda X: (X[:, 0] < HALF) & (X[:, 1] > X[X[:, 0] < HALF, 1].max() - 1e-6))
    to = LimitLoad(case, run, ("constant/boundaryConditions", "value"), lambda q: repr(q * C), mean_move(under, 1, -1))
    rates = to.rest(start, 0.3).rates(levels, hold)
    found, off = at_rate_zero(levels, rates)
    exact, tag = prandtl(phi), f"({what}, phi {phi}, psi {psi}, {HALF / h:g} cells, {shape})"
    case.check(f"slowest rate of settlement {tag}", rates.min(), ">", 0, "m/s")
    print(f"      N_c {found:.3f}, {found / exact - 1:+.3f} of {exact:.3f}; rates {rates}; off a line {off:.3f} {tag}")
    rows.append([what, str(phi), str(psi), shape, f"{HALF / h:g}", f"{levels[0]:g} ... {levels[-1]:g}",
                 Number(found, ".2f", 0.01), Number(found / exact, ".3f", 0, 0.01), Number(off, ".2f", 0, 0.1)])
    return found / exact


strip = [limit("strip", 0, 0, h, levels) for h, levels in
         ((0.25, (6.0, 6.2, 6.4)), (0.125, (5.6, 5.7, 5.8)), (0.0625, (5.4, 5.5, 5.6)))]
case.check("N_c over 2 + pi (strip, 16 cells, uGIMP)", strip[-1], "<=", 1.05)
case.check("N_c over 2 + pi (strip, 16 cells, uGIMP)", strip[-1], ">=", 0.97)
case.check("largest ratio of errors of cells h/2 to cells h (strip, uGIMP)",
           max(abs(b - 1) / abs(a - 1) for a, b in zip(strip, strip[1:])), "<=", 0.8)
for shape, loads, least, most in (("cpGIMP", (5.6, 5.7, 5.8), 0.97, 1.08), ("linear", (5.6, 5.7, 5.8), 0.97, 1.08),
                                  ("quadraticBSpline", (5.2, 5.3, 5.4), 0.93, 1.08)):
    found = limit("strip", 0, 0, 0.125, loads, shape)
    case.check(f"N_c over 2 + pi (strip, 8 cells, {shape})", found, ">=", least)
    case.check(f"N_c over 2 + pi (strip, 8 cells, {shape})", found, "<=", most)

rough = [limit("rough footing", 0, 0, h, levels, "uGIMP", 4.0, 0.3, 1000, ("geometry/layer.geo", "footing", "= 0.5"))
         for h, levels in ((0.25, (6.6, 6.8, 7.0)), (0.125, (6.4, 6.6, 6.8)))]
case.check("N_c over 2 + pi (rough footing, 8 cells)", rough[-1], ">=", 0.97)
case.check("N_c over 2 + pi (rough footing, 8 cells), over that with 4 cells", rough[-1] / rough[0], "<", 1)

wide = (("geometry/layer.geo", "width", "= 10"), ("geometry/layer.geo", "depth", "= 4"),
        ("system/gridDict", "max", "(10 5 0)"), ("constant/materialProperties", "E", "100e6"),
        ("constant/materialProperties", "nu", 0.3))
for psi, least in ((30, 0.97), (0, 0.90)):
    for h in (0.25, 0.125):
        found = limit("strip", 30, psi, h, (34, 36, 38), "uGIMP", 20.0, 0.2, 700, *wide)
    case.check(f"N_c over 30.14 (strip, phi 30, psi {psi}, 8 cells)", found, ">=", least)
    case.check(f"N_c over 30.14 (strip, phi 30, psi {psi}, 8 cells)", found, "<=", 1.04)
case.table("", ["load", "phi [deg]", "psi [deg]", "shape", "cells in half the width", "loads over c", "N_c",
                "N_c over the exact one", "distance of rates from a line"], rows)
case.finish()
