"""The wrong inputs of docs/wrongInputs.md: what is wrong, how a copy of the column gets it, which program meets it."""

import os
from collections.abc import Callable
from dataclasses import dataclass

import h5py
import numpy as np

import errorTable
from wrongInputEdits import (append, attribute, both, compressed, cut, edit, linked, other_case, other_dimension, put,
                             remove, replaced, state, write)


@dataclass
class Entry:
    what: str
    command: str
    change: Callable | None = None
    seeded: bool = True


def law(name, words):
    """The column's material with another law."""
    return write("constant/materialProperties", f"soil\n{{\n    law {name}; density 1000; E 20e6; nu 0.42;\n    {words}\n}}\n")


def seed(what, change):
    return Entry(what, "seedParticles", change, seeded=False)


def solve(what, change):
    return Entry(what, "mpmSolve", change)


def load(what, text, *changes):
    """gravityLoading with this dictionary."""
    return Entry(what, "gravityLoading", both(write(LOADING, text + "\n"), *changes))


def cost(what, text):
    return Entry(what, "accuracyCost", None if text is None else write(COST, text + "\n"), seeded=False)


GRID, SCHEMES, CONTROL, SEED = "system/gridDict", "system/mpmSchemes", "system/controlDict", "system/seedParticlesDict"
SPLIT, CHECK = "system/splitParticlesDict", "system/checkIntegrationDict"
LOADING = "system/gravityLoadingDict"
MATERIAL, WALLS, GRAVITY = "constant/materialProperties", "constant/boundaryConditions", "constant/g"
COLUMN, COST = "geometry/column.geo", "system/accuracyCostDict"
MEASURE = " measures { runOut { history maxX; against finest; } }"
FORCE = "constant/bodyForce"
COLUMN = "geometry/column.geo"
SQUARE = ("Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
          "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n")

def contact(what, words, change=None):
    """Two materials, and what constant/contactProperties says of them."""
    return Entry(what, "mpmSolve", both(attribute("materials", ["soil", "plane"]),
                                        append(MATERIAL, "plane { law linearElastic; density 1000; E 20e6; nu 0.3; }\n"),
                                        write("constant/contactProperties", words + "\n"), *([change] if change else [])))


def measured(*rows):
    """postProcessing/accuracyCost.csv with these rows."""
    return lambda case: errorTable.write(case, rows)


BODIES = "constant/rigidBodies"
ABSORBING = "side { type absorbing; material soil; plane { normal (-1 0 0); position 0; } }\n"


def moving(words):
    """The column's base with a motion."""
    return edit(WALLS, "    separation      on; ", f"    motion {{ {words} }}\n    separation      on; ")


def body(words):
    return write(BODIES, f"blade {{ {words} }}\n")


def treated(words, change=None):
    """More words for mpmSchemes."""
    return both(append(SCHEMES, words + "\n"), *([change] if change else []))


def remedy(words):
    return treated(f"stressTreatment {{ {words} }}")


dilating = edit(MATERIAL, "dilationAngle   0;", "dilationAngle   5;")
elastic = both(law("neoHookean", ""), state(lambda file: file["particles/stress"].write_direct(np.zeros((1800, 4)))))


GROUPS = [
    ("Options", [
        Entry("an option that does not exist", "mpmSolve -fast"),
        Entry("an option misspelt", "smoothStress -latesTime"),
        Entry("an option of another program", "seedParticles -threads 2"),
        Entry("two dashes", "mpmSolve --dry-run"),
        Entry("a word that is no option", "mpmSolve column"),
        Entry("an option without its argument", "mpmSolve -threads"),
        Entry("an option where an argument belongs", "mpmSolve -case -dry-run"),
        Entry("an option given twice", "mpmSolve -dry-run -dry-run"),
        Entry("no threads", "mpmSolve -threads 0"),
        Entry("threads that are no number", "mpmSolve -threads two"),
        Entry("threads of the environment", "OMP_NUM_THREADS=many mpmSolve"),
        Entry("a case that is not there", "mpmSolve -case nowhere"),
        Entry("a case that is a file", "mpmSolve -case system/gridDict"),
        Entry("a case that is another folder", "seedParticles -case geometry"),
        Entry("a time that is not stored", "smoothStress -time 7"),
        Entry("a time that is none", "smoothStress -time now"),
        Entry("a range that runs backwards", "smoothStress -time 2:1"),
        Entry("two ways to choose the time", "smoothStress -time 0 -latestTime"),
        Entry("another case that is not there", "stressQuality -against nowhere"),
        Entry("another case that is no case", "stressQuality -against geometry"),
        Entry("another case without a time of ours", "stressQuality -against other", other_case("1")),
        Entry("another case of another dimension", "stressQuality -against other",
              both(other_case("0"), other_dimension)),
        Entry("a time within which nothing runs", "mpmSolve -withinTime 0"),
        Entry("an error that is no number", "mpmSolve -withinError small"),
        Entry("two wishes at once", "mpmSolve -withinTime 60 -withinError 0.01"),
        Entry("a wish without a table to choose from", "mpmSolve -withinError 0.01"),
        Entry("a measure without a table", "mpmSolve -dry-run -errorMeasure runOut"),
        Entry("a measure that is not in the table", "mpmSolve -withinError 0.01 -errorMeasure runout",
              measured(errorTable.row("a"))),
        Entry("an error no row has", "mpmSolve -withinError 1e-6", measured(errorTable.row("a"))),
        Entry("an error only another seeding has", "mpmSolve -withinError 0.01",
              measured(errorTable.row("a"), errorTable.row("b", cellSize="0.1333333333333333", error=0.009))),
        Entry("a table of other seedings", "mpmSolve -withinError 0.1",
              measured(errorTable.row("a", particlesPerCell=3))),
        Entry("a table in which nothing was done", "mpmSolve -withinError 0.1",
              measured(errorTable.row("a", status="failed", error=""))),
        Entry("a table of another run", "mpmSolve -withinError 0.1", measured(errorTable.row("a", endTime=1))),
        Entry("a table of another version", "mpmSolve -withinError 0.1",
              measured(errorTable.row("a", version="0.0.1 0123456789, native"))),
        Entry("a table that is none", "mpmSolve -withinError 0.1",
              write("postProcessing/accuracyCost.csv", "a table\n")),
        Entry("a row that is no row", "mpmSolve -withinError 0.1", measured(errorTable.row("a", cellSize="fine"))),
        Entry("a target that is the case", "splitParticles -target ."),
        Entry("a law nobody wrote", "driveLaw -law constant/none -path oedometer"),
        Entry("a path that is none", "driveLaw -law constant/materialProperties -path biaxial"),
        Entry("too few options", "driveLaw -law constant/materialProperties"),
        Entry("a material that is not there", "driveLaw -law constant/materialProperties -material sand -path oedometer"),
        Entry("more steps than anyone waits for", "driveLaw -law constant/law -path oedometer",
              write("constant/law", "law linearElastic; E 1e6; nu 0.3; test { steps 1000000000000; }\n")),
        Entry("nothing to check", "checkIntegration"),
        Entry("two things to check at once", "checkIntegration -law -time"),
        Entry("a time to check that is none", "checkIntegration -time soon"),
        Entry("a shape that does not exist", "benchmarkStep -shape cubic"),
        Entry("a number of particles that is none", "benchmarkStep -particles few"),
    ]),
    ("Dictionaries, how they are written", [
        seed("a missing semicolon", edit(GRID, "dimension       2;", "dimension       2 ")),
        seed("a brace that is not closed", edit(MATERIAL, "        type        K0;\n    }\n}", "        type        K0;\n    }\n")),
        seed("a brace too many", append(GRID, "}\n")),
        seed("a word given twice", append(GRID, "cellSize 0.4;\n")),
        seed("a word misspelt", edit(GRID, "cellSize  ", "celSize  ")),
        seed("a word too many", append(GRID, "colour red;\n")),
        seed("a word that is missing", edit(MATERIAL, "    density         1000; ", "    // ")),
        seed("a text where a number belongs", edit(GRID, "0.2666666666666667;", "small;")),
        seed("a decimal comma", edit(GRID, "0.2666666666666667;", "0,2666;")),
        seed("a number with its unit", edit(GRID, "0.2666666666666667;", "0.2666m;")),
        seed("a number beyond double precision", edit(MATERIAL, "20e6;", "20e600;")),
        seed("two numbers where three belong", edit(GRID, "(16 12 0)", "(16 12)")),
        seed("dimensions of another quantity", edit(MATERIAL, "density         1000;", "density [1 -2 0 0 0 0 0] 1000;")),
        seed("a macro nobody wrote", edit(MATERIAL, "20e6;", "$stiffness;")),
        seed("a calculation", edit(MATERIAL, "20e6;", '#calc "2*10e6";')),
        seed("a condition", append(GRID, "#if 1\n#endif\n")),
        seed("an include that is missing", append(GRID, '#include "common"\n')),
        seed("an include outside the case", append(GRID, '#include "../../../etc/passwd"\n')),
        seed("an include of itself", append(GRID, '#include "gridDict"\n')),
        seed("a byte that is no text", append(GRID, "\x01\n")),
        seed("a dictionary that is missing", remove(GRID)),
        seed("a dictionary that is a folder", both(remove(GRAVITY), lambda case: (case / GRAVITY).mkdir())),
        Entry("a word misspelt in a dictionary of a dictionary", "mpmSolve", edit(SCHEMES, "threshold ", "treshold ")),
    ]),
    ("Grid, materials, seeding", [
        seed("a dimension nobody lives in", edit(GRID, "dimension       2;", "dimension       4;")),
        seed("a cell of no size", edit(GRID, "0.2666666666666667;", "0;")),
        seed("a box that is no whole number of cells", edit(GRID, "(16 12 0)", "(16.1 12 0)")),
        seed("a box turned inside out", edit(GRID, "(16 12 0)", "(-16 12 0)")),
        seed("a 2D box with a height in z", edit(GRID, "(16 12 0)", "(16 12 1)")),
        seed("more nodes than any machine holds", edit(GRID, "0.2666666666666667;", "1e-6;")),
        seed("a box that is too small for the soil", edit(GRID, "(16 12 0)", "(16 4 0)")),
        seed("an incompressible material", edit(MATERIAL, "0.42;", "0.5;")),
        seed("a negative density", edit(MATERIAL, "1000;", "-1000;")),
        seed("a law misspelt", edit(MATERIAL, "mohrCoulomb;", "mohrColomb;")),
        seed("a law that does not exist", edit(MATERIAL, "mohrCoulomb;", "vonKarman;")),
        seed("a yield stress of nothing", law("vonMises", "yieldStress 0;")),
        seed("a word of another law", law("neoHookean", "cohesion 1e3;")),
        seed("a stress at the start in a law that follows the deformation", law("hencky", "initialStress { type K0; }")),
        seed("a velocity of an unknown name", law("neoHookean", 'initialVelocity ("v0*sin(X)" 0);')),
        seed("a velocity of a place that is not yet known", law("neoHookean", 'initialVelocity ("x" 0);')),
        seed("a velocity out of the plane", law("neoHookean", "initialVelocity (0 0 1);")),
        seed("a velocity that is infinite at a particle", law("neoHookean", 'initialVelocity ("1/(X - 2.066666666666667 > 0)" 0);')),
        seed("a velocity of four components", law("neoHookean", "initialVelocity (0 0 0 0);")),
        seed("a friction angle of a right angle", edit(MATERIAL, "frictionAngle   42;", "frictionAngle   90;")),
        seed("dilation beyond friction", edit(MATERIAL, "dilationAngle   0;", "dilationAngle   50;")),
        seed("an initial stress that does not exist", edit(MATERIAL, "        type        K0;", "        type        K1;")),
        seed("a stress of four numbers", edit(MATERIAL, "        type        K0;", "        type uniform; value (1 2 3 4);")),
        seed("K0 stress with slanted gravity", edit(GRAVITY, "(0 -9.8 0)", "(1 -9.8 0)")),
        seed("gravity out of the plane", edit(GRAVITY, "(0 -9.8 0)", "(0 -9.8 1)")),
        seed("a soil above its own surface", edit(MATERIAL, "        type        K0;", "        type K0; surfaceLevel 4;")),
        seed("no particles in a cell", edit(SEED, "particlesPerCell    2;", "particlesPerCell    0;")),
        seed("more particles than the machine holds", both(edit(SEED, "particlesPerCell    2;", "particlesPerCell 100;"),
                                                         edit(GRID, "0.2666666666666667;", "0.0001;"))),
        seed("jitter on a lattice", append(SEED, "jitter 0.1;\n")),
        seed("a region that is not in the geometry", edit(SEED, "    soil       ", "    clay       ")),
        seed("a region of a material that is not there", edit(SEED, "material    soil;", "material    sand;")),
        Entry("a state that is there already", "seedParticles"),
        seed("a file where the time folder belongs", write("0", "here\n")),
    ]),
    ("Geometry", [
        seed("a file that is missing", remove(COLUMN)),
        seed("a file of another kind", edit(SEED, '"geometry/column.geo"', '"system/gridDict"')),
        seed("two files and no choice", both(write("geometry/other.geo", SQUARE),
                                           edit(SEED, 'geometry            "geometry/column.geo";', ""))),
        seed("a mistake in gmsh's language", edit(COLUMN, "width = 4;", "width = four;")),
        seed("a last line without its end", write(COLUMN, SQUARE + "a = 1;")),
        seed("no surfaces", write(COLUMN, SQUARE)),
        seed("a plane geometry for a 3D grid", both(edit(GRID, "dimension       2;", "dimension       3;"),
                                                   edit(GRID, "(16 12 0)", "(16 12 4)"))),
        seed("an outline that crosses itself", edit(COLUMN, "Curve Loop(1) = {1, 2, 3, 4};",
                                                    "Line(5) = {1, 3}; Line(6) = {3, 2}; Line(7) = {2, 4}; Line(8) = {4, 1};\n"
                                                    "Curve Loop(1) = {5, 6, 7, 8};")),
        seed("a command that starts a program", append(COLUMN, 'SystemCall "rm -r constant";\n')),
        seed("a command that writes a file", append(COLUMN, 'Save "column.msh";\n')),
        seed("text sent to a file", append(COLUMN, 'Printf("x") > "log";\n')),
        seed("a file outside the case", append(COLUMN, 'Include "../../../etc/passwd";\n')),
        seed("a file name that is calculated", append(COLUMN, 'Merge StrCat("a", ".geo");\n')),
        seed("a loop that never ends", both(append(COLUMN, "For i In {0:1e12}\n  a = i;\nEndFor\n"),
                                          append(SEED, "meshingTime 1;\n"))),
        seed("a script that is called a mesh", both(write("geometry/a.msh", SQUARE),
                                                  edit(SEED, "geometry/column.geo", "geometry/a.msh"))),
        seed("a mesh cut short", both(write("geometry/a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n9 9"),
                                    edit(SEED, "geometry/column.geo", "geometry/a.msh"))),
        seed("an open surface", both(write("geometry/a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                           "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"),
                                   edit(SEED, "geometry/column.geo", "geometry/a.stl"),
                                   edit(GRID, "dimension       2;", "dimension       3;"),
                                   edit(GRID, "(16 12 0)", "(16 12 4)"))),
    ]),
    ("Walls, schemes, time", [
        solve("a wall named after no boundary", write(WALLS, "bsae { type roller; }\n")),
        solve("a wall of no known type", edit(WALLS, "friction;", "frction; ")),
        solve("friction without its coefficient", edit(WALLS, "    mu              0.6; ", "    // ")),
        solve("a negative coefficient of friction", edit(WALLS, "0.6;", "-0.6;")),
        solve("a wall with an edge of its own", edit(WALLS, "(0 -1 0);", "(1 -1 0);")),
        solve("a shape that does not exist", edit(SCHEMES, "uGIMP;          //", "GIMP;          //")),
        solve("a stress update misspelt", edit(SCHEMES, "MUSL;           //", "MULS;           //")),
        solve("a negative rate", edit(SCHEMES, "picRate         2;", "picRate         -2;")),
        solve("a rate of PIC with a transfer that has none", edit(SCHEMES, "FLIP;           //", "APIC;           //")),
        solve("an order without a filter", append(SCHEMES, "order 3;\n")),
        solve("Runge-Kutta steps of a scene that is not smooth", append(SCHEMES, "timeIntegration RK4;\n")),
        solve("a staggered start with USF", both(edit(SCHEMES, "MUSL;           //", "USF;            //"),
                                                 append(SCHEMES, "staggeredStart on;\n"))),
        solve("particles moved by strainVelocity with USL", both(edit(SCHEMES, "MUSL;           //", "USL;            //"),
                                                                 append(SCHEMES, "particleMotion strainVelocity;\n"))),
        seed("a periodic axis that is none", append(GRID, "periodic (z);\n")),
        solve("a wall across a periodic axis", append(GRID, "periodic (y);\n")),
        solve("splitting at once", edit(SCHEMES, "threshold   2.5;", "threshold   0.5;")),
        solve("a body force of an unknown name", write(FORCE, 'value ("A*sin(pi*X)" 0 0);\n')),
        solve("a body force with a function misspelt", write(FORCE, 'value (0 "sine(x)");\n')),
        solve("a body force cut short", write(FORCE, 'value ("2*(x" 0 0);\n')),
        solve("a body force that assigns", write(FORCE, 'value ("t = 0" 0 0);\n')),
        solve("a body force of two values in one", write(FORCE, 'value ("x, y" 0 0);\n')),
        solve("a body force out of the plane", write(FORCE, 'value (0 0 "x");\n')),
        solve("a body force without its value", write(FORCE, "constants { A 1; }\n")),
        solve("a constant that is a variable", write(FORCE, 'value ("t" 0); constants { t 1; }\n')),
        solve("a constant of a later one", write(FORCE, 'value ("A" 0); constants { A "2*B"; B 1; }\n')),
        solve("a field that does not exist", append(CONTROL, "fields (referencePositon);\n")),
        solve("a treatment that does not exist", treated("stressTreatment automatc;")),
        solve("a remedy that does not exist", treated("stressTreatment { volumeAveraging { region cell; } }")),
        solve("a region that does not exist", remedy("volumetricAveraging { region cells; }")),
        solve("repeats of an average over cells", remedy("volumetricAveraging { region cell; repeats 2; }")),
        solve("hats that are none", remedy("volumetricAveraging { repeats 0; }")),
        solve("a viscosity that outruns the step", remedy("volumetricAveraging { viscosity 2; }")),
        solve("an average of no such part", remedy("volumetricAveraging { of plastic; }")),
        solve("a target that does not exist", remedy("stressRelaxation { target filterd; }")),
        solve("a rate that takes nothing", remedy("stressRelaxation { rate 0; }")),
        solve("a bound below zero", remedy("stressRelaxation { perStrain -1; }")),
        solve("no steps between relaxations", remedy("stressRelaxation { interval 0; }")),
        solve("a gap that is neither", remedy("tensionGap open;")),
        solve("a treatment within a Runge-Kutta step", treated("stressTreatment automatic; timeIntegration RK4;",
                                                              edit(SCHEMES, "picRate         2;", "picRate 0;"))),
        solve("a share of the filter with FLIP", treated("filterRate 5;")),
        solve("filters at intervals without a rate",
              treated("order 2; filterInterval 10;",
                      both(edit(SCHEMES, "transfer        FLIP;", "transfer XPIC;"),
                           edit(SCHEMES, "picRate         2; ", "//")))),
        solve("a time step beyond the stability limit", edit(CONTROL, "1e-3;", "4e-3;")),
        solve("stress last at this time step", edit(SCHEMES, "MUSL;           //", "USL;           //")),
        solve("a time step of zero", edit(CONTROL, "1e-3;", "0;")),
        solve("a yes that is no", edit(CONTROL, "adjustTimeStep  no;", "adjustTimeStep  perhaps;")),
        solve("an end that is no time", edit(CONTROL, "endTime         2.5;", "endTime         never;")),
        solve("a way to start that does not exist", edit(CONTROL, "latestTime;     //", "lastTime;     //")),
        solve("a start that is not stored", both(edit(CONTROL, "latestTime;     //", "startTime;     //"),
                                               edit(CONTROL, "startTime       0;", "startTime       0.5;"))),
        solve("another program's dictionary", edit(CONTROL, "application     mpmSolve;", "application     icoFoam;")),
        solve("states that are never written", edit(CONTROL, "writeInterval   0.25;", "writeInterval   0;")),
        solve("a particle nobody seeded", edit(CONTROL, "(15 400 900 1700)", "(15 400 900 170000)")),
        Entry("a mode of splitting that does not exist", "splitParticles -target refined",
              edit(SPLIT, "fourWay; ", "eightWay; ")),
        Entry("splitting in place without being told to", "splitParticles"),
        cost("nothing to try accuracy on", None),
        cost("an axis misspelt", "axes { stressupdate (USL MUSL); }" + MEASURE),
        cost("a shape misspelt among others", "axes { shape (uGIMP cpGMIP); }" + MEASURE),
        cost("a value twice on an axis", "axes { courant (0.2 0.4 0.2); }" + MEASURE),
        cost("half a particle in a cell", "axes { particlesPerCell (2 2.5); }" + MEASURE),
        cost("Courant number and time step at once", "axes { courant (0.2); deltaT (1e-3); }" + MEASURE),
        cost("two methods that are one", "methods { a { shape linear; } b { shape linear; } }" + MEASURE),
        cost("no measure of error", "axes { shape (uGIMP cpGIMP); }"),
        cost("an empty list of measures", "measures { }"),
        cost("a column of no history", "measures { runOut { history maxx; against finest; } }"),
        cost("a measure of two things", "measures { both { history maxX; field stress; against finest; } }"),
        cost("an exact solution nobody gave", "measures { way { field displacement; against exact; } }"),
        cost("a stress of two components", "exact { stress (0 0); } measures { s { field stress; against exact; } }"),
        cost("a formula with an unknown name", 'exact { velocity ("A*X" 0 0); } measures { v { field velocity; against exact; } }'),
        cost("a profile without its component", "measures { p { profile stress; low (0 0 0); high (1 1 0); bins 4; against finest; } }"),
        cost("boxes turned inside out",
             "measures { p { profile stress; component yy; low (0 1 0); high (1 0 0); bins 4; against finest; } }"),
        cost("a mean over no time", "measures { m { history maxX; take mean; against finest; } }"),
        cost("all times of what is known at the end", "measures { m { field stress; over storedTimes; against finest; } }"),
        Entry("an accuracy that is none", "accuracyCost -within 0", write(COST, MEASURE), seeded=False),
        Entry("half a row at a time", "accuracyCost -threads 0.5", write(COST, MEASURE), seeded=False),
        Entry("steps that are none", "checkIntegration -law", edit(CHECK, "(1 2 4 8 16 32 64 128 256 512)", "(1 2 0)")),
        Entry("time steps that grow", "checkIntegration -time", edit(CHECK, "(0.4 0.2 0.1)", "(0.1 0.2)")),
        Entry("a scheme of time that does not exist", "checkIntegration -time",
              edit(CHECK, "// schemes  (USL MUSL);", "schemes (USL RK5);")),
        Entry("a scheme of time the case cannot run", "checkIntegration -time",
              edit(CHECK, "// schemes  (USL MUSL);", "schemes (RK4);")),
        Entry("an exact solution with a name nobody knows", "checkIntegration -time",
              edit(CHECK, "// schemes  (USL MUSL);", 'exact { displacement ("A*sin(X)" 0); }')),
        Entry("a window of no length", "checkIntegration -time", edit(CHECK, "window      0.05;", "window 0;")),
        Entry("a spin that is no number", "checkIntegration -law", edit(CHECK, "spin        1.2;", "spin fast;")),
        Entry("a tolerance of sub-steps beyond its bounds", "checkIntegration -law",
              edit(CHECK, "{ tolerance 1e-4; } ", "{ tolerance 2; } ")),
        Entry("a path without its stress", "checkIntegration -law",
              edit(CHECK, "startStress (-40e3 -60e3 -48e3 0 0 0);", "")),
    ]),
    ("Contact between bodies", [
        contact("bodies nobody named", "mu 0.3;"),
        contact("one body alone", "bodies ((soil plane)); mu 0.3;"),
        contact("a body of a material that is not there", "bodies (soil plain); mu 0.3;"),
        contact("a material in two bodies", "bodies (soil (plane soil)); mu 0.3;"),
        contact("a body of nothing", "bodies (soil ()); mu 0.3;"),
        contact("a friction coefficient below nothing", "bodies (soil); mu -0.3;"),
        contact("friction of a body with itself", "bodies (soil plane); mu 0.3; pairs ((soil soil 0.2));"),
        contact("friction of a pair given twice", "bodies (soil plane); mu 0.3; pairs ((soil plane 0.2) (plane soil 0.1));"),
        contact("friction of a body that is not there", "bodies (soil plane); mu 0.3; pairs ((soil plan 0.2));"),
        contact("a pair without its friction", "bodies (soil plane); mu 0.3; pairs ((soil plane));"),
        contact("a pair below nothing", "bodies (soil plane); mu 0.3; pairs ((soil plane -1));"),
        contact("a way to touch that does not exist", "bodies (soil plane); mu 0.3; detection domain;"),
        contact("a word too many for contact", "bodies (soil plane); mu 0.3; cohesion 1e3;"),
        Entry("a rigid material nobody touches", "mpmSolve",
              edit(MATERIAL, "\nsoil\n{", "\nsoil\n{ law rigid; density 1000; }\nother\n{")),
        Entry("bodies where there is one material", "mpmSolve", write("constant/contactProperties", "bodies (soil); mu 0.3;\n")),
        contact("contact in a method of smooth equations", "bodies (soil plane); mu 0.3;",
                write(SCHEMES, "shape uGIMP; transfer FLIP; timeIntegration RK4;\n")),
    ]),
    ("Damping, shocks, merging, gravity loading", [
        solve("a kind of damping that does not exist", append(SCHEMES, "damping { type rayleigh; }\n")),
        solve("local damping of the whole force", append(SCHEMES, "damping { type local; coefficient 1; }\n")),
        solve("a relaxation time of local damping", append(SCHEMES, "damping { type local; relaxationTime 1; coefficient 0.5; }\n")),
        solve("local damping without its coefficient", append(SCHEMES, "damping { type local; }\n")),
        solve("a bulk viscosity below zero", append(SCHEMES, "bulkViscosity { linear -0.06; }\n")),
        solve("a bulk viscosity misspelt", append(SCHEMES, "bulkViscosity { quadratik 1.2; }\n")),
        solve("merging what splitting makes", append(SCHEMES, "merging { threshold 1.5; }\n")),
        solve("merging at a negative size", append(SCHEMES, "merging { threshold -1; }\n")),
        solve("merging over a distance", append(SCHEMES, "merging { closeness 2; }\n")),
        solve("merging every no steps", append(SCHEMES, "merging { interval 0; }\n")),
        load("a damping of the loading that does not exist", "dynamicRelaxation { damping viscous; }"),
        load("a coefficient of kinetic damping", "dynamicRelaxation { damping kinetic; coefficient 0.5; }"),
        load("a loading that is never at rest", "dynamicRelaxation { tolerance 0; }"),
        load("a loading of no steps", "maxSteps 0;"),
        load("a loading of negative time", "maxTime -1;"),
        load("a word of the loading misspelt", "keepPosition yes;"),
        load("positions kept with a law that follows the deformation", "keepPositions yes;", elastic),
        load("nothing to load with", "keepPositions yes;", remove(GRAVITY)),
        load("a loading by gravity that comes on later", "keepPositions yes;", append(GRAVITY, "ramp { duration 1; }\n")),
        Entry("a loading of a state of a run", "gravityLoading", attribute("step", 5)),
        Entry("a loading of no state", "gravityLoading", seeded=False),
    ]),
    ("States", [
        Entry("no state at all", "mpmSolve", seeded=False),
        solve("an empty file", cut(0)),
        solve("a file cut in half", cut(0.5)),
        solve("a text", write("0/state.h5", "particles\n")),
        solve("a file of another program", lambda case: h5py.File(case / "0" / "state.h5", "w").close()),
        solve("a folder of that name", both(remove("0/state.h5"), lambda case: (case / "0" / "state.h5").mkdir())),
        solve("an earlier format", attribute("formatVersion", 1)),
        solve("a later format", attribute("formatVersion", 1000)),
        solve("a dimension nobody lives in", attribute("dimension", 7)),
        solve("an array that is missing", state(lambda file: file.pop("particles/mass"))),
        solve("an array of another type", replaced("particles/mass", np.ones(1800, np.float32))),
        solve("an array of another length", replaced("particles/mass", np.ones(1799))),
        solve("an array of another shape", replaced("particles/mass", np.ones((1800, 2)))),
        solve("a link to another file", linked("particles/mass")),
        solve("a compressed array", compressed("particles/mass")),
        solve("a velocity that is not a number", put("particles/velocity", (7, 0), float("nan"))),
        solve("a particle without mass", put("particles/mass", 7, 0)),
        solve("a particle turned inside out", put("particles/deformationGradient", (7, 0, 0), -1)),
        solve("two particles of one id", put("particles/id", 7, 8)),
        solve("an id that was never given", put("particles/id", 7, 10**12)),
        solve("a material that is not in the list", put("particles/material", 7, 3)),
        solve("a ledger that is infinite", replaced("ledger/gravityWork", float("inf"))),
        Entry("the same of another program", "smoothStress", put("particles/volume", 7, -1)),
        Entry("the same of a third", "stressQuality", put("particles/volume", 7, -1)),
        Entry("the same of a fourth", "splitParticles -target refined", put("particles/length0", (7, 1), 0)),
    ]),
    ("Dictionaries that do not fit the state or each other", [
        solve("other cells than the particles were seeded on", edit(GRID, "0.2666666666666667;", "0.4;")),
        solve("another dimension", both(edit(GRID, "dimension       2;", "dimension       3;"),
                                      edit(GRID, "(16 12 0)", "(16 12 4)"))),
        solve("a material the state is made of and nobody describes", edit(MATERIAL, "\nsoil\n", "\nclay\n")),
        solve("a law that follows the deformation, and stress without one", law("neoHookean", "")),
        solve("the whole volume change averaged where soil dilates",
              both(remedy("volumetricAveraging { of total; }"), dilating)),
        solve("averages of the elastic part with conjugate forces",
              remedy("volumetricAveraging { of elastic; conjugate yes; }")),
        solve("a tension gap where no volume is dropped", both(remedy("tensionGap yes;"), dilating)),
        solve("a stress to relax that follows the deformation", both(remedy("stressRelaxation { }"), elastic)),
        solve("a place at the start that is not known any more", both(write(FORCE, 'value (0 "X*t");\n'),
                                                                     attribute("step", 5))),
        solve("a grid the particles have left", edit(GRID, "(-12 0 0)", "(2.4 0 0)")),
        solve("a wall that is not on a node's line", edit(WALLS, "position    0;", "position    0.1;")),
        solve("two folders of one time", lambda case: (os.mkdir(case / "0.0"),
                                                      (case / "0.0" / "state.h5").write_bytes(b"x"))),
    ]),
    ("Laws that soften, crack or are cones", [
        seed("a limit of tension below nothing", law("mohrCoulomb", "cohesion 1e3; frictionAngle 30; tensionCutOff -1;")),
        seed("a limit of tension as a word", law("druckerPrager", "cohesion 1e3; frictionAngle 30; tensionCutOff none;")),
        seed("a match misspelt", law("druckerPrager", "cohesion 1e3; frictionAngle 30; match planestrain;")),
        seed("a cone that dilates more than it rubs", law("druckerPrager", "cohesion 1e3; frictionAngle 30; dilationAngle 31;")),
        seed("softening of a cone", law("druckerPrager", "cohesion 1e3; frictionAngle 30; softening { over 0.1; referenceLength 1; }")),
        seed("friction of undrained clay", law("tresca", "cohesion 1e3; frictionAngle 30;")),
        seed("softening that makes stronger",
             law("tresca", "cohesion 1e3; softening { over 0.1; cohesion 2e3; referenceLength 0.1; }")),
        seed("softening at once", law("tresca", "cohesion 1e3; softening { over 0; cohesion 200; referenceLength 0.1; }")),
        seed("softening in a band of no known width", law("tresca", "cohesion 1e3; softening { over 0.1; cohesion 200; }")),
        seed("a residual angle in clay", law("tresca", "cohesion 1e3; softening { over 0.1; frictionAngle 5; referenceLength 0.1; }")),
        seed("a residual dilation beyond the residual friction",
             law("mohrCoulomb", "cohesion 1e3; frictionAngle 30; dilationAngle 10; "
                 "softening { over 0.1; frictionAngle 5; dilationAngle 8; referenceLength 0.1; }")),
        seed("softening and sub-steps at once",
             law("tresca", "cohesion 1e3; softening { over 0.1; cohesion 200; referenceLength 0.1; } substep { }")),
        Entry("rate equations of a law that softens", "checkIntegration -law",
              write(CHECK, "paths { a { law tresca; E 1e6; nu 0.3; cohesion 1e3; endTime 1; rate { } "
                                  "softening { over 0.1; cohesion 200; referenceLength 0.1; } } }\n")),
    ]),
    ("Walls that move, rigid bodies, absorbing boundaries, gravity by a ramp", [
        solve("a motion that is none", moving("")),
        solve("two motions at once", moving("velocity (1 0 0); displacement (0 0 0);")),
        solve("a motion misspelt", moving("velocty (1 0 0);")),
        solve("a motion out of the plane", moving("velocity (0 0 1);")),
        solve("a motion by a name nobody knows", moving('velocity ("A*sin(w*t)" 0 0); constants { A 1; }')),
        solve("a motion that is not finite at the start", moving('velocity ("1/t" 0 0);')),
        solve("a table whose times fall", moving("velocity table ((0 (0 0 0)) (2 (1 0 0)) (1 (0 0 0)));")),
        solve("a table with a row of one number", moving("velocity table ((0 (0 0 0)) (1 1));")),
        solve("a table without rows", moving("velocity table ();")),
        solve("a record that is not there", moving('acceleration { file "constant/quake.csv"; direction (1 0 0); }')),
        solve("a record of one column without a direction",
              both(write("constant/quake.csv", "t,a\n0,0\n1,1\n"), moving('acceleration { file "constant/quake.csv"; }'))),
        solve("a record with a word in it",
              both(write("constant/quake.csv", "t,a\n0,0\n1,one\n"),
                   moving('acceleration { file "constant/quake.csv"; direction (1 0 0); }'))),
        solve("a record of another case", moving('velocity { file "../quake.csv"; }')),
        solve("a motion of a load", append(WALLS, "top { type pressure; value 1e3; motion { velocity (0 1 0); } }\n")),
        solve("a wall that slides along itself between nodes",
              both(edit(WALLS, "position    0;", "position    0.1;"), moving("velocity (1 0 0);"))),
        solve("an absorbing boundary of no known material", append(WALLS, ABSORBING.replace("soil", "rock"))),
        solve("an absorbing boundary without a material", append(WALLS, ABSORBING.replace("material soil;", ""))),
        solve("an absorbing boundary that gives energy", append(WALLS, ABSORBING.replace("soil;", "soil; normal -1;"))),
        solve("an absorbing boundary with soil behind it", append(WALLS, ABSORBING.replace("position 0", "position 2.4"))),
        solve("a body of neither points nor a file", body("mu 0.3;")),
        solve("a body of two points", body("points ((-2 1) (-1 1));")),
        solve("a body that cuts itself", body("points ((-3 1) (-1 3) (-1 1) (-3 2));")),
        solve("a body inside the soil", body("points ((-1 1) (0.5 1) (0.5 3) (-1 3));")),
        solve("a body thinner than a cell", body("points ((-3 1) (-1 1) (-1 1.1) (-3 1.1));")),
        solve("a body outside the grid", body("points ((20 1) (22 1) (22 3));")),
        solve("a body with negative friction", body("points ((-3 1) (-1 1) (-1 3)); mu -0.1;")),
        solve("a body whose axis lies in the plane",
              body("points ((-3 1) (-1 1) (-1 3)); motion { rotation { axis (1 0 0); angularVelocity 1; } }")),
        solve("a body from a file nobody reads", both(write("geometry/blade.obj", "v 0 0 0\n"), body('geometry "geometry/blade.obj";'))),
        solve("a body from a script of gmsh", body('geometry "geometry/column.geo";')),
        solve("a body called like a table of the run", write(BODIES, "history { points ((-3 1) (-1 1) (-1 3)); }\n")),
        solve("a word nobody knows in a body", body("points ((-3 1) (-1 1) (-1 3)); frction 0.3;")),
        solve("a ramp of negative time", append(GRAVITY, "ramp { duration -1; }\n")),
        solve("a ramp of no known shape", append(GRAVITY, "ramp { duration 1; shape sine; }\n")),
        solve("a ramp without its time", append(GRAVITY, "ramp { shape smooth; }\n")),
    ]),
]
