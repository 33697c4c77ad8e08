"""What the trade-off is made of, as data: its rows, and the words each of them changes in the dictionaries of this folder.

A change is file -> word -> value; None removes the entry. `stressTreatment` is a word of system/mpmSchemes.
"""

from dataclasses import dataclass, field

SCHEMES, GRID, SEED, CONTROL, SOIL = ("system/mpmSchemes", "system/gridDict", "system/seedParticlesDict",
                                      "system/controlDict", "constant/materialProperties")


def averaging(region="patch", repeats=4, of="total", conjugate="no", viscosity=0):
    extent = f"region patch; repeats {repeats};" if region == "patch" else "region cell;"
    viscous = f" viscosity {viscosity};" if viscosity else ""
    return f"volumetricAveraging {{ {extent} of {of}; conjugate {conjugate};{viscous} }}"


def relaxation(target="filtered", interval=5, **more):
    words = "".join(f" {word} {value};" for word, value in more.items())
    return f"stressRelaxation {{ target {target}; interval {interval};{words} }}"


GAP = "tensionGap yes;"


def treatment(*parts):
    return {SCHEMES: {"stressTreatment": "{ " + " ".join(parts) + " }"}}


def treated(word):
    return {SCHEMES: {"stressTreatment": word}}


def merged(*changes):
    out = {}
    for change in changes:
        for file, words in change.items():
            out.setdefault(file, {}).update(words)
    return out


@dataclass
class Row:
    name: str                       # folder, and key in tradeOff.csv
    label: str                      # in table and plot
    group: str                      # plain | single | combination | automatic | scene
    changes: dict = field(default_factory=dict)
    baseline: str = "plain"         # whose cost is 1
    reference: bool = True          # the finer runs solve the same problem
    filters: bool = False           # the remedy filters velocities: what transfers lose beyond the baseline's is its loss


PLAIN, AUTOMATIC = treated("none"), treated("automatic")
W = treatment(averaging(repeats=2), relaxation("smoothed", 5, rate=200, perStrain=0), GAP)
LONGER = {CONTROL: {"endTime": "4"}}     # to see the heap rest; so do the runs of the first figure
WHOLE = {SCHEMES: {"splitting": None}}
COARSE = {GRID: {"cellSize": "0.4"}, SEED: {"particlesPerCell": "3"}}
DILATANT = {SOIL: {"dilationAngle": "10"}}


def variant(repeats=6, interval=5, viscosity=0.01, of="total", gap=GAP, **more):
    """What `automatic` picks for this soil, with other numbers."""
    return treatment(averaging(repeats=repeats, viscosity=viscosity, of=of), relaxation(interval=interval, **more), gap)


FRONT = {"viscosity": 0.2, "interval": 3, "perStrain": 20000}


ROWS = [
    Row("plain", "plain", "plain", PLAIN),
    Row("cell", "cell average", "single", treatment(averaging("cell"))),
    Row("patch", "patch average", "single", treatment(averaging())),
    Row("patchElastic", "patch average of elastic", "single", treatment(averaging(of="elastic"))),
    Row("cellConjugate", "cell average, conjugate", "single", treatment(averaging("cell", conjugate="yes"))),
    Row("smoothed", "relaxation, smoothed", "single", treatment(relaxation("smoothed"))),
    Row("filtered", "relaxation, filtered", "single", treatment(relaxation("filtered"))),
    Row("leastSquares", "relaxation, least squares", "single", treatment(relaxation("leastSquares"))),
    Row("gap", "tension gap", "single", treatment(GAP)),
    Row("pic5", "PIC 5 1/s", "single", merged(PLAIN, {SCHEMES: {"picRate": "5"}}), filters=True),
    Row("xpic", "XPIC(3) 5 1/s", "single", merged(PLAIN, {SCHEMES: {"transfer": "XPIC; order 3; filterRate 5",
                                                                   "picRate": None}}), filters=True),
    Row("W", "W", "combination", W),
    Row("automatic", "automatic", "automatic", AUTOMATIC),
    Row("interval1", "every step", "automatic", variant(interval=1)),
    Row("interval2", "every 2 steps", "automatic", variant(interval=2)),
    Row("spelledOut", "every 5 steps, patch x 6, viscosity 0.01", "automatic", variant()),
    Row("interval10", "every 10 steps", "automatic", variant(interval=10)),
    Row("repeats2", "patch x 2", "automatic", variant(repeats=2)),
    Row("repeats4", "patch x 4", "automatic", variant(repeats=4)),
    Row("viscosity0", "viscosity 0", "automatic", variant(viscosity=0)),
    Row("viscosity05", "viscosity 0.05", "automatic", variant(viscosity=0.05)),
    Row("viscosity2", "viscosity 0.2", "automatic", variant(viscosity=0.2)),
    Row("front", "viscosity 0.2, every 3, perStrain 20000", "automatic", variant(**FRONT)),
    Row("automaticPic3", "automatic, PIC 3 1/s, to 4 s", "automatic", merged(AUTOMATIC, LONGER, {SCHEMES: {"picRate": "3"}})),
    Row("plainWhole", "plain, no splitting", "scene", merged(PLAIN, WHOLE), "plainWhole"),
    Row("automaticWhole", "automatic, no splitting", "scene", merged(AUTOMATIC, WHOLE), "plainWhole"),
    Row("frontWhole", "viscosity 0.2, every 3, perStrain 20000, no splitting", "scene", merged(variant(**FRONT), WHOLE),
        "plainWhole"),
    Row("plainCoarse", "plain, h = 0.4 m", "scene", merged(PLAIN, COARSE), "plainCoarse"),
    Row("automaticCoarse", "automatic, h = 0.4 m", "scene", merged(AUTOMATIC, COARSE), "plainCoarse"),
    Row("plainDilatant", "plain, psi = 10 deg", "scene", merged(PLAIN, DILATANT), "plainDilatant", False),
    Row("automaticDilatant", "automatic, psi = 10 deg", "scene", merged(AUTOMATIC, DILATANT), "plainDilatant", False),
    Row("frontDilatant", "viscosity 0.2, every 3, perStrain 20000, psi = 10 deg", "scene",
        merged(variant(of="elastic", gap="", **FRONT), DILATANT), "plainDilatant", False),
    Row("WDilatant", "W, psi = 10 deg", "scene", merged(W, DILATANT), "plainDilatant", False),
]

# The finer ones halve cells and spacing and quarter the step.
FINER = {GRID: {"cellSize": "0.13333333333333333"}, CONTROL: {"deltaT": "2.5e-4"}}
MAIN = {"plain": merged(PLAIN, LONGER), "cured": merged(AUTOMATIC, LONGER),
        "plainFine": merged(PLAIN, FINER), "curedFine": merged(AUTOMATIC, FINER)}
TIMES = (0.5, 1.0, 1.5, 2.5)        # of the paper's figure [s]
