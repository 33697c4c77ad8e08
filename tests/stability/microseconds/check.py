"""A steel bar in microseconds.
Hard: times of 1e-9 s and lengths of 1e-5 m meet absolute tolerances and folder names made for seconds.
Pass: ten states with distinct names; the impact wave runs at c within 1 %, is at c t within two cells and carries rho c v; the wall's impulse is rho c v A t within 1 %."""
import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
rho, E, v0, length, h = 7850, 210e9, 5, 5e-3, 5e-5
c = np.sqrt(E / rho)
run = case.solve("bar")
case.common(run)
case.check("stored times", len(run.times()), "==", 11)
names = np.array([float(name) for name in run.times()])
case.check("largest error of a folder's name", np.abs(names - np.arange(11) * 1e-7).max(), "<=", 1e-12, "s")
case.check("largest difference of a state's time to its name", max(abs(run.state(n).time - float(n)) for n in run.times()), "<=",
           1e-13, "s")

# a sensor is passed when its material has lost half of its velocity
first = run.state(0)
x0 = first.by_id("position")[:, 0]
arrivals = []
for name in run.times()[1:9]:
    state = run.state(name)
    v = state.by_id("velocity")[:, 0]
    order = np.argsort(x0)
    front = x0[order][np.argmax(v[order] < -v0 / 2)]
    arrivals.append(front)
state = run.state("8e-07")
behind = (x0 < 0.9 * c * state.time)
# dispersion makes a front as wide as cells passed to the power 1/3; its middle lags by a cell or so and runs at c
times = np.arange(1, 9) * 1e-7
case.check("largest |place of the front - c t| over the cell size", np.abs(arrivals - c * times).max() / h, "<=", 2)
case.check("speed of the front over c, - 1", abs(np.polyfit(times[2:], arrivals[2:], 1)[0] / c - 1), "<=", 0.01)
case.check("stress behind the front over rho c v, - 1", abs(state.by_id("stress")[behind, 0].mean() / (-rho * c * v0) - 1), "<=", 0.01)
history = run.series()
late = (history["time"] > 1e-7) & (history["time"] < 0.95 * length / c)
impulse = history["wallImpulseX"][late] / (rho * c * v0 * h * history["time"][late]) - 1
case.check("wall impulse over rho c v A t, largest error", np.abs(impulse).max(), "<=", 0.01)
case.finish()
