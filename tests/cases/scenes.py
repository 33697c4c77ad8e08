"""The scenes of cases/ that have a report.py, scaled down to a second or two: coarse cells, one run each, judged by the
numbers of their READMEs in wider bands; and whether each README is what its script writes.

    scenes.py NAME      MPM_BUILD_DIR names the build (default: build/)
"""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from sceneCase import PROJECT, Run, SceneCase  # noqa: E402

GRID, CONTROL = "system/gridDict", "system/controlDict"


class Scene(SceneCase):
    KIND = "cases"

    def __init__(self, name):
        super().__init__(__file__, f"{name}, scaled down. Tests: the numbers of its README. Pass: bands of scenes.py.", "Tests", "tests")
        self.name, self.source = name, PROJECT / "cases" / name
        self.folder = self.folder.parent / f"scene-{name}"
        shutil.rmtree(self.folder, ignore_errors=True)
        os.environ["MPM_PROJECT_DIR"] = str(PROJECT)
        sys.dont_write_bytecode = True
        spec = importlib.util.spec_from_file_location("report", self.source / "report.py")
        self.report = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.report)

    def coarse(self, cells, *changes, variant="run"):
        """A run with cells so many times as large and steps as long."""
        import re
        here = {word: float(re.search(rf"(?m)^{word}\s+([^;]*);", (self.source / file).read_text())[1])
                for file, word in ((GRID, "cellSize"), (CONTROL, "deltaT"))}
        return self.solve(variant, (GRID, "cellSize", repr(cells * here["cellSize"])),
                          (CONTROL, "deltaT", repr(cells * here["deltaT"])), *changes, threads=1)

    def between(self, what, value, least, most, unit=""):
        self.check(what, value, ">=", least, unit)
        self.check(what, value, "<=", most, unit)

    def books(self, run, work="motionWork"):
        budget = run.series("energyBudget")
        self.check("energy residual over the work done", abs(budget["residual"]).max() / abs(budget[work]).max(), "<=", 1e-9)


def aluminiumRods(scene):
    run = scene.coarse(2)
    scene.between("run-out over L0", scene.report.run_out(run.folder), 0.6, 1.1)
    height = scene.report.profile(run.folder)[1]
    scene.between("height at the wall over H0", height[0] / scene.report.H0, 0.85, 1.02)
    scene.books(run, "gravityWork")


def granularColumn3D(scene):
    run = scene.coarse(1.6, (GRID, "min", "(0 0 -0.02)"), (GRID, "max", "(0.4 0.4 0.2)"))
    scene.between("run-out over R, 1.24 (Lube), 1 (Lajeunesse)", scene.report.run_out(run.folder), 0.7, 1.3 * scene.report.lube(1))
    scene.between("height over R, 0.88 (Lube)", scene.report.height(run.folder), 0.6, 1.1)
    scene.between("volume over that of the start", run.state()["volume"].sum() / run.state(0)["volume"].sum(), 0.98, 1.1)
    scene.books(run, "gravityWork")


def twoDiscs(scene):
    run = scene.coarse(2)
    found = scene.report.motion(run.folder)
    scene.check("momentum over that of one disc", found["momentum"], "<=", 1e-12)
    scene.between("they touch after 1.586 s", found["touch"], 1.5, 1.8, "s")
    scene.between("energy kept", found["kept"], 0.92, 1.005)
    scene.between("restitution", found["restitution"], 0.75, 0.99)
    scene.check("least kinetic energy", found["least"], "<=", 0.1)


def discOnIncline(scene):
    run = scene.coarse(2, (GRID, "max", "(3.125 1.25 0)"), (GRID, "min", "(-0.125 -0.25 0)"),
                       (GRID, "cellSize", 0.125), (CONTROL, "deltaT", 2e-4))
    t, path, turned = (column[-1] for column in scene.report.motion(run.folder))
    scene.between("path in 0.5 s over 0.895032 m", path / 0.895032, 0.95, 1.05)
    scene.between("angle turned over 0.75", turned / 0.75, 0.5, 1.1)
    scene.between("heat of friction over mu N times the slip, 613 J/m", run.series("energyBudget")["contactFriction"][-1] / 613, 0.85, 1.25)
    scene.books(run, "gravityWork")


def footingIntoClay(scene):
    run = scene.coarse(2)
    scene.between("N_c over 2 + pi", scene.report.bearing(run.folder) / scene.report.PRANDTL, 0.88, 1.1)
    scene.between("the surface rises up to x", scene.report.edge(run.folder), 2, 3.5, "m")
    scene.books(run)


def wallPushedIntoSand(scene):
    run = scene.coarse(2, (GRID, "min", "(-0.1 -0.1 0)"), (GRID, "max", "(3.1 1.5 0)"))
    scene.between("force over Rankine's", scene.report.plateau(run.folder) / scene.report.RANKINE, 0.9, 1.1)
    scene.between("angle of the wedge, 30 deg", scene.report.wedge(run.folder), 25, 38, "deg")
    scene.books(run)


def slopeUnderBaseMotion(scene):
    run = scene.coarse(2, (GRID, "min", "(-1 -1 0)"), (GRID, "max", "(29 9 0)"))
    estimate = scene.report.newmark(scene.report.spiral_yield())
    scene.between("slip over that of Newmark's block", scene.report.slip(run.folder)[1][-1] / estimate, 0.4, 2.5)
    still = scene.coarse(2, (GRID, "min", "(-1 -1 0)"), (GRID, "max", "(29 9 0)"), ("constant/boundaryConditions", "V", 0.1), variant="weak")
    scene.between("slip below the yield acceleration", scene.report.slip(still.folder)[1][-1], -0.01, 0.01, "m")
    scene.books(run)


def geometryPipeline(scene):
    """The whole way once, in 3D and in 2D."""
    run = scene.coarse(2, (GRID, "min", "(-0.128 -0.128 -0.032)"), (GRID, "max", "(0.384 0.32 0.16)"), (CONTROL, "endTime", 0.2))
    scene.report.make_variants(run.folder)
    plane = Run(run.folder / "variants" / "plane")
    scene.require(plane.utility("seedParticles"))
    scene.require(plane.utility("mpmSolve", threads=1))
    for body in (run, plane):
        scene.require(body.utility("extractSurface", "-latestTime"))
    scene.report.make_variants(run.folder)
    for name, dim, script in (("again", 3, "remesh.geo"), ("planeAgain", 2, "remeshPlane.geo")):
        again = Run(run.folder / "variants" / name)
        subprocess.run(["gmsh", f"-{dim}", script, "-o", "deformed.msh"], cwd=again.folder / "geometry", check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        scene.require(again.utility("seedParticles"))
    for row in scene.report.measure(run.folder).rows:
        if row["inside"]:
            scene.check(f"{row['what']} ({row['measured']}, {row['expected']}) outside its band", float(row["inside"] != "yes"), "==", 0)


SCENES = {function.__name__: function for function in (aluminiumRods, granularColumn3D, twoDiscs, discOnIncline, footingIntoClay,
                                                       wallPushedIntoSand, slopeUnderBaseMotion, geometryPipeline)}


def main(names):
    if len(names) != 1 or names[0] not in SCENES:
        sys.exit(f"scenes.py NAME, one of {', '.join(SCENES)}")
    scene = Scene(names[0])
    written = subprocess.run([scene.source / "report.py", "-check"], text=True, capture_output=True)
    scene.check("README.md is not what report.py writes", written.returncode, "==", 0)
    SCENES[names[0]](scene)
    scene.finish()


if __name__ == "__main__":
    main(sys.argv[1:])
