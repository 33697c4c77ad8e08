"""A body that flies out of the grid, or was drawn outside it.
Hard: there are no nodes out there; particles must not be dropped, clamped or read from foreign memory.
Pass: exit 2, a message naming particle, place and remedy, and the last stored state unspoilt: on a wider grid it goes on bitwise as if that had been there from the start; a geometry outside the grid is refused with exit 1 and nothing written."""
import math

from hardCase import HardCase

case = HardCase(__file__, __doc__)
WIDE = ("system/gridDict", "max", "(16 16 0)")


def velocity(x, y):
    return ("constant/materialProperties", "initialVelocity", f"({x} {y} 0)")


# the block starts 3 m from every side: at 8 m/s it is out after 0.375 s
for name, v in (("right", (8, 0)), ("left", (-8, 0)), ("up", (0, 8)), ("down", (0, -8)), ("corner", (6, 7))):
    run = case.solve(name, velocity(*v), exits=2)
    case.common(run)
    last = run.state()
    leaves = 3 / max(abs(c) for c in v)
    case.check(f"last stored time ({name})", last.time, ">", math.floor(10 * leaves - 1.3) / 10, "s")
    case.check(f"message names particle, place, grid and remedy ({name})",
               str(all(word in run.log for word in ("particle", "outside the grid [0, 8] x [0, 8]", "enlarge", "system/gridDict"))),
               "==", "True")
    case.check(f"last stored time is named ({name})", str(f"the last stored time is {run.times()[-1]}" in run.log), "==", "True")

run = case.solve("wider", velocity(8, 0), WIDE)
case.common(run)
late = case.solve("widerLater", velocity(8, 0), exits=2)
late.set(*WIDE)
late.utility("mpmSolve")
case.check("exit code on the wider grid", late.exit, "==", 0)
a, b = run.state(), late.state()
case.check("numbers that differ after going on", sum(int((a[n] != b[n]).sum()) for n in a.particles), "==", 0)

outside = case.copy("drawnOutside", ("geometry/block.geo", r"Rectangle\(1\)", "= {7, 3, 0, 2, 2}")).utility("seedParticles")
case.check("exit code of seedParticles", outside.exit, "==", 1)
case.check("times written", len(outside.times()), "==", 0)
case.check("message names region and grid", str(all(word in outside.log for word in ("soil", "grid", "9"))), "==", "True")
case.finish()
