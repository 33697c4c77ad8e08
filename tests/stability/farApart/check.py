"""Two bodies two kilometres from each other.
Hard: the box of cells between them is empty; what one body does must not reach the other through sums, sorting or tiles.
Pass: each moves bitwise as it does alone, also with two threads; memory stays that of the bodies."""
import re

import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
FIELDS = ("position", "velocity", "stress", "deformationGradient", "mass", "volume")
alone = {}
for name in ("near", "far"):
    alone[name] = case.solve(name, ("system/seedParticlesDict", "geometry", f'"geometry/{name}.geo"'))
    case.common(alone[name])
for threads in (1, 2):
    both = case.solve(f"both{threads}", threads=threads)
    case.common(both)
    state = both.state()
    of = state.by_id("material")
    names = [name.decode() for name in state.attributes["materials"]]
    for name, run in alone.items():
        own = run.state()
        differ = sum(int((state.by_id(f)[of == names.index(name)] != own.by_id(f)).sum()) for f in FIELDS)
        case.check(f"numbers of '{name}' that differ ({threads} threads)", differ, "==", 0)
    case.check(f"contacts with the floor ({threads} threads)", float(state.ledger["wallContacts"]), ">", 100)
    memory = re.search(r"memory +([\d.]+) (\w+)", both.log)
    megabytes = float(memory.group(1)) * {"kB": 1e-3, "MB": 1, "GB": 1e3}[memory.group(2)]
    case.check(f"memory for a box of 130000 cells ({threads} threads)", megabytes, "<=", 200, "MB")
case.finish()
