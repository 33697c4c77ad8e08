"""A soil column that collapses, seeded six times with its particles a little elsewhere.
Hard: a collapse multiplies differences until no particle is where it was in the other run; only what a geotechnical engineer asks for can be compared.
Pass: run-out, height of the heap and peak kinetic energy scatter (standard deviation over the runs) by less than what one seed more or less means; particles do differ by more than a seeding spacing."""
import numpy as np
from hardCase import HardCase

H, SPACING, WIDTH, HEIGHT = 0.25, 0.125, 2.0, 4.0
case = HardCase(__file__, __doc__)
runs = [case.solve(f"seed{k}", ("system/seedParticlesDict", "randomSeed", k)) for k in range(1, 7)]
for run in runs:
    case.common(run)
histories, states = [r.series() for r in runs], [r.state() for r in runs]
toe = np.array([max(h["maxX"][-1] - WIDTH, -h["minX"][-1]) for h in histories])
half = np.array([0.5 * (h["maxX"][-1] - h["minX"][-1]) for h in histories])
crest = np.array([h["maxY"][-1] for h in histories])
peak = np.array([h["kineticEnergy"].max() for h in histories])
spread = np.array([np.percentile(s["position"][:, 0], 95) - np.percentile(s["position"][:, 0], 5) for s in states])
print("toe", toe, "crest", crest, "peak", peak, "spread", spread)
case.finish()
