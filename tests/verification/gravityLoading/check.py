"""A column and a slope seeded without stress, loaded by gravityLoading, and then left to themselves.
Measured: stresses against the closed form, the steps it takes, and how far anything moves in one second of mpmSolve afterwards.
Pass: cell means of sigma_yy within 1e-4 of rho g H of rho g z and sigma_xx of nu/(1 - nu) times it in soil that does not yield; all of it
rests afterwards (velocities below 1e-6 c_p, displacements below 1e-6 H); a slope with a factor of safety over 1 does, one under 1 is
refused with exit code 2 and its state left alone."""
import numpy as np
from verification import Number, Verification

case = Verification(__file__, __doc__)
G, RHO, NU, E = 9.8, 1800.0, 0.3, 20e6
K0 = NU / (1 - NU)
rows = []


def slope(run):
    run.set("system/seedParticlesDict", "geometry", '"geometry/slope.geo"')
    run.set("system/gridDict", "max", "(12 6 0)")
    run.set("constant/boundaryConditions", "base", "{ type fixed; }")


def loaded(label, material, *changes):
    run = case.seed(label, ("system/seedParticlesDict", "soil", f"{{ material {material}; }}"), *changes)
    seeded = run.state(0)
    case.require(run.utility("gravityLoading"))
    return run, seeded, run.state(0)


def rests(label, run, height, speed, kept=True):
    """One second of mpmSolve from the loaded state."""
    start = run.state(0)
    steps = next(line for line in run.log.splitlines() if line.startswith("At rest")).split()
    case.require(run.utility("mpmSolve"))
    end = run.state()
    moved = np.abs(end.by_id("position") - start.by_id("position")).max() / height
    fastest = max(np.abs(end["velocity"]).max(), np.sqrt(2 * run.series()["kineticEnergy"].max() / end["mass"].sum())) / speed
    case.check(f"displacement over the height ({label})", moved, "<=", 1e-6)
    case.check(f"velocity over that of the wave ({label})", fastest, "<=", 1e-6)
    case.check(f"plastic work afterwards over elastic energy ({label})",
               abs(float(end.ledger["plasticDissipation"])) / float(start.particles["mass"].sum()), "<=", 1e-6)
    return int(steps[3]), int(steps[6]), moved, fastest


def column(label, material, *changes, height=5.0):
    run, seeded, state = loaded(label, material, *changes)
    for name in ("position", "deformationGradient", "volume", "velocity"):
        case.check(f"changes of {name} ({label})", np.abs(state.by_id(name) - seeded.by_id(name)).max(), "==", 0)
    y, s = state.by_id("position")[:, 1], state.by_id("stress")
    scale = RHO * G * height
    off = (s[:, 1] + RHO * G * (height - y)) / scale
    cell = np.floor(y / 0.5).astype(int)
    vertical = max(abs(off[cell == c].mean()) for c in set(cell))
    ratio = float((s[:, 0] * s[:, 1]).sum() / (s[:, 1] ** 2).sum())
    side = np.abs(s[:, 0] - K0 * s[:, 1]).max() / scale
    case.check(f"mean sigma_yy of cells against rho g z, over rho g H ({label})", vertical, "<=", 1e-4)
    case.check(f"sigma_yy of particles against rho g z, over rho g h/4 ({label})", np.abs(off).max() * height / 0.125, "<=", 1.05)
    if material != "weakSoil":
        case.check(f"sigma_xx against nu/(1 - nu) sigma_yy, over rho g H ({label})", side, "<=", 1e-4)
    else:  # active limit to elastic unloading from it
        active = np.tan(np.radians(45 - 7.5)) ** 2
        depth = y < 4
        case.check(f"sigma_xx over sigma_yy, smallest ({label})", (s[depth, 0] / s[depth, 1]).min(), ">=", 0.9 * active)
        case.check(f"sigma_xx over sigma_yy, largest ({label})", (s[depth, 0] / s[depth, 1]).max(), "<=", 1)
    steps, passes, moved, fastest = rests(label, run, height, np.sqrt(E * (1 - NU) / (1 + NU) / (1 - 2 * NU) / RHO))
    rows.append([label, str(steps), str(passes), Number(vertical, ".1e", 0.5, floor=1e-6), f"{ratio:.3f}", Number(moved, ".1e", 1, floor=1e-7),
                 Number(fastest, ".1e", 1, floor=1e-7)])
    return run


kinetic = ("system/gravityLoadingDict", "dynamicRelaxation", "{ damping kinetic; tolerance 1e-6; kineticTolerance 1e-9; }")
column("elastic", "elastic")
column("elastic, kinetic damping", "elastic", kinetic)
column("soil", "soil")
run = column("soil that yields", "weakSoil")
case.check("exit code of a second loading without -overwrite", run.utility("gravityLoading").exit, "==", 1)

# A law of F: the deformed body is kept, and carries its weight.
run, seeded, state = loaded("neo-Hookean, positions not kept", "rubber", ("system/gravityLoadingDict", "keepPositions", "no"))
depth = 5 - seeded.by_id("position")[:, 1]
off = (state.by_id("stress")[:, 1] + RHO * G * depth) / (RHO * G * 5)
case.check("mean sigma_yy of four particles against the weight above, over rho g H (neo-Hookean)",
           max(abs(off[np.floor(depth / 0.5) == c].mean()) for c in range(10)), "<=", 2e-2)
case.check("settlement of the top over the height (neo-Hookean)",
           (seeded.by_id("position") - state.by_id("position"))[:, 1].max() / 5, ">=", 0.02)
rests("neo-Hookean", run, 5, 30)

run, seeded, state = loaded("slope", "slopeSoil", slope)
steps, passes, moved, fastest = rests("slope", run, 4, 120)
rows.append(["slope, c 5 kPa, phi 30 deg", str(steps), str(passes), "-", "-", Number(moved, ".1e", 1, floor=1e-7),
             Number(fastest, ".1e", 1, floor=1e-7)])

run = case.seed("slope that fails", ("system/seedParticlesDict", "soil", "{ material weakSlopeSoil; }"), slope,
                ("system/gravityLoadingDict", "maxSteps", 4000))
before = (run.folder / "0" / "state.h5").read_bytes()
case.check("exit code (slope that fails)", run.utility("gravityLoading").exit, "==", 2)
case.check("its message names no equilibrium", int("no equilibrium" in run.log), "==", 1)
case.check("bytes of its state that changed", int((run.folder / "0" / "state.h5").read_bytes() != before), "==", 0)

case.table("", ["scene", "steps", "passes", "error of the cells' sigma_yy over rho g H", "sigma_xx over sigma_yy", "displacement afterwards over H",
                "velocity afterwards over c_p"], rows)
case.finish()
