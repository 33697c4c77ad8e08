"""Collapse loads of verification scenes, from rates of flow.

A body under a prescribed load cannot be held at its collapse load: below it rests, above it flows. With damping in
proportion to mass (the body force -v/tau, libmpm/nodal/damping.hpp) the flow becomes steady. Let the mechanism move with
v w(x), v the rate of a point that is watched. The work equation of limit analysis then reads

    q int w_n dS = q_c int w_n dS + (v/tau) int rho |w|^2 dV,

so that the load less the collapse load q_c is in proportion to the rate. Rates at a few loads beyond collapse lie on a
line that meets rate 0 at q_c: a number, where two runs only give a bracket. The same holds for gravity as the load.

    limit = LimitLoad(case, run, ("constant/boundaryConditions", "value"), lambda q: repr(q * c), moved)
    limit.rest(4.0, 0.3)                         # from the start under 4 c, for 0.3 s
    rates = limit.rates((6.0, 6.3, 6.6), 0.3)    # each from there on, for 0.3 s; mean over the last third
    q_c, off = at_rate_zero((6.0, 6.3, 6.6), rates)
"""
import shutil

import numpy as np
from verification import Run


class LimitLoad:
    """run: seeded, with `writeControl runTime` in its controlDict. place: (file, word) of the load, text(level): what is
    written there; moved(before, after): the displacement that is watched, of two states."""

    def __init__(self, case, run, place, text, moved):
        self.case, self.run, self.place, self.text, self.moved = case, run, place, text, moved
        self.time = 0.0

    def rest(self, level, time):
        self.advance(self.run, level, time, 1)
        self.time = round(self.time + time, 9)
        return self

    def branch(self, level, time):
        """A copy of the run that goes on from its last state under another load."""
        copy = Run(self.run.folder.with_name(f"{self.run.folder.name}-at-{level:g}"))
        for part in ("geometry", "constant", "system", "0", self.run.times()[-1], "postProcessing"):
            if not (copy.folder / part).exists():
                shutil.copytree(self.run.folder / part, copy.folder / part)
        return self.advance(copy, level, time, 3)

    def rate(self, level, time):
        run = self.branch(level, time)
        before, after = run.state(-2), run.state(-1)
        return self.moved(before, after) / (after.time - before.time)

    def rates(self, levels, time):
        return np.array([self.rate(level, time) for level in levels])

    def advance(self, run, level, time, parts):
        run.set(*self.place, self.text(level))
        run.set("system/controlDict", "endTime", repr(round(self.time + time, 9)))
        run.set("system/controlDict", "writeInterval", repr(round(time / parts, 9)))
        run.utility("mpmSolve", threads=1)
        if run.exit != 0:
            self.case.require(run)
            self.case.finish()
        return run


def at_rate_zero(levels, rates):
    """Where the line through (level, rate) meets rate 0, and how straight it is: the largest distance of a point from it,
    over the largest rate."""
    levels, rates = np.asarray(levels, float), np.asarray(rates, float)
    slope, start = np.polyfit(levels, rates, 1)
    return -start / slope, np.abs(slope * levels + start - rates).max() / np.abs(rates).max()


def surface_group(run, chosen):
    """The particles, by id, that chosen(X) marks in the first state; X (N, dim)."""
    X = run.state(0).by_id("position")
    return chosen(X)


def mean_move(group, axis, sign=1):
    return lambda before, after: sign * (after.by_id("position") - before.by_id("position"))[group, axis].mean()
