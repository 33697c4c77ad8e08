"""An elastic column that vibrates for ten periods, with and without treatments of its stresses.
Measured: the share of the energy of vibration that is still there in the tenth period: under sudden gravity between smooth
walls and with free sides, and in the first and fourth mode of the column between walls; and where the rest went.
Pass: 99 % in the cases of sudden gravity, the first mode (32 cells) and the fourth (64 cells, 37 a wave), with every
treatment; with 18 cells a wave at most 1 % less than without treatment; energy never grows by more than 0.1 %."""
import numpy as np
from verification import Number, Verification, set_fields, treatment

NAMES = ("plain", "automatic", "cell averaging")
LAWS = ("elastic", "strong")

case = Verification(__file__, __doc__)
E, NU, RHO, G, H, V0 = 20e6, 0.42, 1000.0, 9.8, 8.0, 0.1
M = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
PLANE = E / (1 - NU**2)
FREE = "{ type traction; value (0 0 0); }"


class Column:
    """One way to vibrate: cells over the height, mode of the initial velocity (0: sudden gravity), sides."""

    def __init__(self, name, cells, mode=0, free=False):
        self.name, self.mode, self.free = name, mode, free
        self.h, self.width = H / cells, 4.0 if free else H / cells
        modulus = PLANE if free else M
        self.period = 4 * H / np.sqrt(modulus / RHO) / (2 * mode - 1 if mode else 1)
        self.vibration = self.width * (RHO * V0**2 / 2 * H / 2 if mode else (RHO * G) ** 2 * H**3 / (6 * modulus))

    def solve(self, law, word):
        end, limit = 10 * self.period, 0.4 * self.h / np.sqrt(M / RHO)
        changes = [("geometry/column.geo", "width", f"= {self.width!r}"), ("system/gridDict", "cellSize", repr(self.h)),
                   ("system/controlDict", "deltaT", repr(end / np.ceil(end / limit))),
                   *[("system/controlDict", time, repr(end)) for time in ("endTime", "writeInterval")],
                   ("system/seedParticlesDict", "soil", f"{{ material {law}; }}"), treatment(word)]
        if self.free:
            changes += [("constant/boundaryConditions", side, FREE) for side in ("left", "right")]
            changes += [("system/gridDict", "min", "(-1.6 0 0)"), ("system/gridDict", "max", "(5.6 9.6 0)")]
        else:
            changes += [("system/gridDict", "max", f"({self.h!r} 9 0)")]
        if self.mode:
            changes += [("constant/g", "value", "(0 0 0)")]
        run = case.seed(f"{self.name.replace(' ', '-')}-{law}-{len(rows)}", *changes)
        if self.mode:
            k = (2 * self.mode - 1) * np.pi / (2 * H)
            set_fields(run, velocity=lambda x: np.stack([0 * x[:, 0], V0 * np.sin(k * x[:, 1])], axis=1))
        return case.require(run.utility("mpmSolve", threads=1))

    def kept(self, law, word):
        """Share of the energy of vibration over time, which of it is the tenth period, and losses over that energy."""
        b = self.solve(law, word).series("energyBudget")
        def entry(name):
            return b[name] / self.vibration if name in b.dtype.names else np.zeros(len(b))
        energy = entry("kineticChange") + entry("strainChange") - entry("staggering") - entry("gravityWork")
        remedies = sum(entry(name) for name in ("relaxationLoss", "averagingLoss", "viscosityLoss", "gapWork"))
        losses = [entry("transferLoss"), entry("wallLoss"), -entry("finiteStrainWork"), remedies, entry("residual")]
        return 1 + energy, b["time"] > 9 * self.period, [float(loss[-1]) for loss in losses]


rows, plain = [], {}
COLUMNS = (Column("smooth walls", 32), Column("free sides", 20, free=True), Column("mode 1", 32, 1),
           Column("mode 4", 64, 4), Column("mode 4, coarse", 32, 4))
for column in COLUMNS:
    for law in LAWS:
        for word in NAMES:
            share, tenth, losses = column.kept(law, word)
            kept = share[tenth].max()
            tag = f"({column.name}, {law}, {word})"
            plain.setdefault((column.name, law), kept)
            if column.name.endswith("coarse"):
                if word != "automatic" or law != "strong":  # patches reach over a third of such a wave: theory.md
                    case.check(f"share of energy kept, less that of the plain scheme {tag}", kept - plain[column.name, law], ">=", -0.01)
            else:
                case.check(f"share of energy kept {tag}", kept, ">=", 0.99)
            case.check(f"largest share of energy at any time {tag}", share.max(), "<=", 1.001)
            case.check(f"residual over the energy of vibration {tag}", abs(losses[-1]), "<=", 1e-9)
            rows.append([column.name, law, word, Number(kept, ".4f", 0, 5e-4), Number(share[tenth].min(), ".4f", 0, 5e-4),
                         *[Number(loss, ".1e", 0.1, 2e-5, floor=1e-5) for loss in losses[:-1]]])
case.table("", ["column", "law", "treatment", "energy kept", "least in the tenth period", "transfer loss", "wall loss",
                "finite strain loss", "remedies"], rows)
case.finish()
