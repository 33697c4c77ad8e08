"""A turning block that is pulled apart until its particles split again and again, up to both caps.
Hard: children are split in the step after their parents; each split must keep what the grid does not look after, and
the caps must hold in the middle of a cascade.
Pass: neither more particles nor finer ones than allowed; mass, momentum and angular momentum of every split exact to
round-off, and the kinetic energy it takes is what is booked as splitMergeLoss - in the solver and, for particles
stretched at random, in the utility."""
import math

import numpy as np
from hardCase import HardCase

CAP, GENERATIONS = 1500, 3


def spin_and_stretch(p):
    p["velocity"][...] = p["position"] @ np.array([[1.0, -1.0], [1.0, 0.5]]).T


def stretch_at_random(p):
    draw = np.random.default_rng(1)
    p["deformationGradient"][...] = np.eye(2) + draw.uniform(0, 7, (len(p["mass"]), 1, 1)) * np.eye(2) + \
        draw.uniform(-0.4, 0.4, (len(p["mass"]), 2, 2))
    p["volume"][...] = p["volume0"] * np.linalg.det(p["deformationGradient"])
    p["velocity"][...] = draw.uniform(-3, 3, p["velocity"].shape)


def sums(s):
    """Mass, momentum, first and angular moment, volume, kinetic energy: summed exactly, and the sum of their sizes."""
    m, x, v = s["mass"], s["position"], s["velocity"]
    terms = {"mass": m, "momentum x": m * v[:, 0], "momentum y": m * v[:, 1], "first moment x": m * x[:, 0],
             "first moment y": m * x[:, 1], "volume": s["volume"],
             "angular momentum": m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]),
             "kinetic energy": m * (v**2).sum(axis=1) / 2}
    return {name: (math.fsum(t), math.fsum(np.abs(t))) for name, t in terms.items()}


case = HardCase(__file__, __doc__)
run = case.seed("solver").edit(spin_and_stretch)
first = run.state(0)
case.require(run.utility("mpmSolve"))
case.common(run)
case.nothing_gained(run)
states = [run.state(time) for time in run.times()]
last, history = states[-1], run.series()
before, after = sums(first), sums(last)
case.check("splits", last.ledger["splits"], ">", 100)
case.check("splits refused by a cap at the end", last.ledger["splitsCapped"], ">", 0)
case.check("most particles", history["particles"].max(), "<=", CAP)
case.check("particles at the end: the cap is used", last["mass"].size, ">", CAP - 4)
case.check("most halvings", max(s["generation"].max() for s in states), "==", GENERATIONS)
case.check("change of mass at any time", np.ptp(history["mass"]) / history["mass"][0], "<=", 1e-13)
for name in ("mass", "momentum x", "momentum y"):
    case.check(f"change of {name}", abs(after[name][0] - before[name][0]) / before[name][1], "<=", 1e-12)
case.check("angular momentum changed by splits, summed over all",
           last.ledger["splitAngularMomentum"] / before["angular momentum"][1], "<=", 1e-12)
case.check("kinetic energy lost by splits",
           abs(last.ledger["splitMergeLoss"]) / before["kinetic energy"][1], "<=", 1e-12)
sizes = last["mass"] * 4.0 ** last["generation"]
case.check("masses are parents' masses halved", np.ptp(sizes) / sizes.max(), "<=", 1e-14)

run = case.seed("utility").edit(stretch_at_random)
before, loss = run.state(0), run.state(0).ledger["splitMergeLoss"]
case.require(run.utility("splitParticles", "-overwrite"))
after = run.state(0)
case.check("particles the utility makes", after["mass"].size, "<=", CAP)
case.check("of at least", after["mass"].size, ">", CAP - 4)
case.check("halvings by the utility", after["generation"].max(), "==", GENERATIONS)
case.check("ids used twice", after["id"].size - np.unique(after["id"]).size, "==", 0)
old, new = sums(before), sums(after)
for name in old:
    booked = after.ledger["splitMergeLoss"] - loss if name == "kinetic energy" else 0
    change = abs(new[name][0] + booked - old[name][0]) / old[name][1]
    case.check(f"change of {name} by the utility", change, "<=", 1e-13)
case.finish()
