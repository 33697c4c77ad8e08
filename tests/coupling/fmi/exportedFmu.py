"""A case as an FMU, driven by another process as a tool would: the archive, its description, calculations to the last
bit as without FMU, states to go back to, calls in the wrong order, several instances, what stays on the disk.

    exportedFmu.py [ExportedFmu.test_name ...]      MPM_BUILD_DIR names the build (default: build/)
"""

import hashlib
import shutil
import subprocess
import unittest
from pathlib import Path

import descriptionRules
from importedFmu import BUILD, WORK, Fmu, Importer, fresh_case, run

LENGTHS = [0.004, 0.004, 0.002, 0.007, 0.003]  # of communication steps [s]: none like the one before
OUTPUTS = ["time", "wall.force.x", "wall.force.y", "wall.torque.z", "wall.contactArea", "wall.interfaceWork",
           "energy.kinetic", "energy.strain", None, "lid.atVertices.force", "marker.atVertices.displacement"]


def windows():
    """(start, length, x, y, angle, settlement) of the steps; the first has no length: how it begins."""
    at, out = 0.0, [(0.0, 0.0, 1.1, 0.35, 0.0, 0.0)]
    for length in LENGTHS:
        end = at + length
        out.append((at, length, 1.1 - 0.4 * end, 0.35, 0.5 * end, 6 * end))
        at = end
    return out


def content(folder):
    return {p.relative_to(folder): hashlib.sha1(p.read_bytes()).hexdigest() for p in Path(folder).rglob("*") if p.is_file()}


class ExportedFmu(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK / "tmp", ignore_errors=True)
        cls.case = fresh_case()
        done = run(BUILD / "bin" / "exportFMU", "-case", cls.case, "-output", WORK / "sand.fmu", "-overwrite")
        assert done.returncode == 0, done.stderr
        cls.fmu = Fmu(WORK / "sand.fmu", WORK / "unpacked")

    def drive(self, tool, window, who="A", keep=False):
        start, length, x, y, angle, settlement = window
        for name, value in (("wall.position.x", x), ("wall.position.y", y), ("wall.angle", angle)):
            self.assertEqual(tool.set(name, value, who=who), "OK")
        lid = [0.0, -settlement, 0.0] * (self.fmu.size("lid.atVertices.displacement") // 3)
        self.assertEqual(tool.set("lid.atVertices.displacement", *lid, who=who), "OK")
        if length == 0:
            return None
        status, values = tool.step(start, length, who=who, keep=keep)
        self.assertEqual(status, "OK", tool.logs[-1:])
        self.assertEqual(len(values), 1, "no flags")
        return self.row(tool, who)

    def row(self, tool, who="A"):
        out = []
        for name in OUTPUTS:
            if name is None:
                out.append(float(tool.ok(who, "getInt", self.fmu.reference("substeps"))[0]))
            else:
                out += tool.get(name, who=who)
        return out

    def start(self, tool, who="A", **parameters):
        tool.ok(who, "instantiate")
        for name, value in parameters.items():
            self.assertEqual(tool.set(name.replace("__", "."), value, who=who), "OK")
        self.drive(tool, windows()[0], who)
        tool.ok(who, "enter", 0)
        tool.ok(who, "exit")

    def native(self, *settings):
        lines = "\n".join(" ".join(float(v).hex() for v in w) for w in windows())
        case = WORK / "native"
        shutil.rmtree(case, ignore_errors=True)
        shutil.copytree(self.case, case)
        done = run(BUILD / "tests" / "runWithoutFmu", case, *settings, input=lines + "\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        return [[float.fromhex(v) for v in line.split()] for line in done.stdout.splitlines()]

    def whole(self, tool, who="A"):
        return [self.drive(tool, w, who) for w in windows()[1:]]

    def test_archive(self):
        names = {e.filename for e in self.fmu.entries}
        for name in ("modelDescription.xml", "documentation/index.html", "documentation/externalDependencies.txt",
                     "binaries/x86_64-linux/sand.so", "resources/case/system/couplingDict", "resources/case/0/state.h5"):
            self.assertIn(name, names)
        for entry in self.fmu.entries:
            self.assertIn(entry.compress_type, (0, 8))
            self.assertLessEqual(entry.extract_version, 20)
            self.assertNotIn("\\", entry.filename)

    def test_description(self):
        self.assertEqual(descriptionRules.violations(self.fmu.root), [])
        self.assertEqual(self.fmu.variables["materialProperties.sand.cohesion"].get("start"), "500")
        self.assertAlmostEqual(float(self.fmu.variables["wall.position.x"].get("start")), 1.1, places=12)
        co = self.fmu.root.find("CoSimulation")
        for flag in ("canGetAndSetFMUState", "canSerializeFMUState", "canHandleVariableCommunicationStepSize"):
            self.assertEqual(co.get(flag), "true")
        self.assertEqual(self.fmu.variables["boundaryConditions.'rough-base'.mu"].get("start"), "0.5")
        self.assertEqual(self.fmu.variables["g.value"].get("start"), "0 -9.8 0")
        stiffness = {u.get("name"): u.find("BaseUnit").attrib for u in self.fmu.root.find("UnitDefinitions")}[
            self.fmu.variables["materialProperties.sand.E"].get("unit")]
        self.assertEqual(stiffness, {"kg": "1", "m": "-1", "s": "-2"})
        self.assertNotIn("materialProperties.sand.density", self.fmu.variables)

    def test_only_the_standards_symbols(self):
        done = subprocess.run(["nm", "-D", "--defined-only", self.fmu.library], text=True, capture_output=True, check=True)
        shown = [line.split()[-1] for line in done.stdout.splitlines()]
        header = (Path(__file__).resolve().parents[3] / "libmpm/fmi/fmi3Functions.h").read_text()
        declared = {w.split("(")[0] for w in header.split() if w.startswith("fmi3") and "(" in w and "*" not in w.split("(")[0]}
        self.assertEqual(len(shown), 75)
        self.assertEqual(set(shown), {d for d in declared if not d.endswith("Callback)")})

    def test_as_without_fmu(self):
        with Importer(self.fmu) as tool:
            self.start(tool)
            found = self.whole(tool)
            tool.ok("A", "terminate")
            self.assertEqual(self.row(tool), found[-1])
            tool.ok("A", "free")
        native = self.native()
        self.assertEqual(found, native)
        self.assertNotEqual(native[-1][1], 0, "the wall touches the sand")
        self.assertGreater(max(abs(f) for f in native[-1][9:-9]), 0, "the lid does")

    def test_parameters(self):
        with Importer(self.fmu) as tool:
            self.start(tool, materialProperties__sand__E=4e6)
            found = self.whole(tool)
        self.assertEqual(found, self.native("constant/materialProperties", "sand.E", "4e6"))
        self.assertNotEqual(found, self.native())

    def test_going_back(self):
        straight = self.native()
        with Importer(self.fmu) as tool:
            self.start(tool)
            steps = windows()[1:]
            self.drive(tool, steps[0])
            tool.ok("A", "save", "s")
            self.drive(tool, (*steps[1][:2], 1.0, 0.35, -0.01, 0.2), keep=True)  # what is thrown away
            tool.ok("A", "restore", "s")
            self.assertEqual(self.row(tool), straight[0])
            self.assertEqual(self.drive(tool, steps[1], keep=True), straight[1])
            tool.ok("A", "restore", "s")  # as often as one likes
            self.assertEqual([self.drive(tool, s, keep=True) for s in steps[1:4]], straight[1:4])
            tool.ok("A", "save", "s")  # the same one anew, with inputs that wait
            tool.set("wall.position.x", steps[4][2])
            tool.ok("A", "save", "pending")
            tool.ok("A", "write", "s", WORK / "state.bytes")
            tool.ok("A", "drop", "s")
            self.assertEqual(tool.tell("A", "restore", "s")[0], "Error")
            for name, value in (("wall.position.x", 1.05), ("wall.angle", 0.0)):
                tool.set(name, value)
            tool.ok("A", "restore", "pending")
            self.assertEqual(tool.get("wall.position.x")[0], steps[4][2])
        with Importer(self.fmu) as tool:  # another process, nothing calculated before
            tool.ok("A", "instantiate")
            tool.ok("A", "read", "s", WORK / "state.bytes")
            tool.ok("A", "restore", "s")
            self.assertEqual(self.row(tool), straight[3])
            self.assertEqual(self.drive(tool, steps[4]), straight[4])
            damaged = bytearray((WORK / "state.bytes").read_bytes())
            damaged[len(damaged) // 2] ^= 1
            (WORK / "damaged.bytes").write_bytes(damaged)
            self.assertEqual(tool.tell("A", "read", "d", WORK / "damaged.bytes")[0], "Error")
            (WORK / "damaged.bytes").write_bytes(damaged[:100])
            self.assertEqual(tool.tell("A", "read", "d", WORK / "damaged.bytes")[0], "Error")
            self.assertIn("badState", tool.logs[-1][2])

    def refused(self, tool, text, *words, status="Error"):
        """The call is refused and the reason logged."""
        before = len(tool.logs)
        self.assertEqual(tool.tell(*words)[0], status, words)
        told = [m for s, c, m in tool.logs[before:] if (s, c) == (status, "logStatus" + status)]
        self.assertTrue(any(text in m for m in told), (words, tool.logs[before:]))

    def test_wrong_order(self):
        x = self.fmu.reference("wall.position.x")
        e = self.fmu.reference("materialProperties.sand.E")
        force = self.fmu.reference("wall.force.x")
        with Importer(self.fmu) as tool:
            tool.ok("A", "instantiate")
            self.refused(tool, "called in Instantiated, allowed in Step Mode", "A", "step", 0, 0.1)
            self.refused(tool, "called in Instantiated, allowed in Step Mode", "A", "terminate")
            self.refused(tool, "called in Instantiated", "A", "exit")
            self.refused(tool, "is calculated", "A", "get", force, 1)
            self.drive(tool, windows()[0])
            self.refused(tool, "startTime 3", "A", "enter", 3)
            tool.ok("A", "enter", 0, 1)
            self.refused(tool, "called in Initialization Mode", "A", "enter", 0)
            self.refused(tool, "called in Initialization Mode", "A", "step", 0, 0.1)
            tool.ok("A", "exit")
            self.refused(tool, "set in Step Mode", "A", "set", e, 1e6)
            self.refused(tool, "neither a parameter nor an input", "A", "set", force, 1)
            self.refused(tool, "finite", "A", "set", x, "nan")
            self.refused(tool, "found 2 values, allowed 1", "A", "set", x, 1, 2)
            self.refused(tool, "found room for 3 values", "A", "get", x, 3)
            self.refused(tool, "value reference 9999", "A", "get", 9999, 1)
            self.refused(tool, "is of type Float64", "A", "getInt", x)
            self.refused(tool, "communicationStepSize", "A", "step", 0, 0)
            self.refused(tool, "communicationStepSize", "A", "step", 0, "nan")
            self.refused(tool, "currentCommunicationPoint 0.5", "A", "step", 0.5, 0.1)
            self.refused(tool, "stopTime", "A", "step", 0, 1.5)
            for name in ("EnterEventMode", "EnterStepMode", "EnterConfigurationMode", "EvaluateDiscreteStates",
                         "EnterContinuousTimeMode"):
                self.refused(tool, "the FMU", "A", "call", "fmi3" + name)
            self.assertEqual(self.whole(tool), self.native(), "all that changed nothing")
            tool.ok("A", "terminate")
            self.refused(tool, "called in Terminated", "A", "step", 0.02, 0.01)
            tool.ok("A", "reset")
            self.drive(tool, windows()[0])
            tool.ok("A", "enter", 0)
            tool.ok("A", "exit")
            self.assertEqual(self.whole(tool), self.native(), "as new after a reset")

    def test_steps_that_cannot_be_taken(self):
        steps = windows()[1:]
        with Importer(self.fmu) as tool:
            self.start(tool)
            self.drive(tool, steps[0])
            tool.set("wall.position.x", 0.6)  # five cells at once, through the sand
            self.refused(tool, "wall", "A", "step", steps[1][0].hex(), "1e-9", status="Discard")
            self.assertEqual([self.drive(tool, s) for s in steps[1:]], self.native()[1:])

    def test_bad_parameters(self):
        with Importer(self.fmu) as tool:
            tool.ok("A", "instantiate")
            tool.set("materialProperties.sand.nu", 0.5)
            self.refused(tool, "nu", "A", "enter", 0)
            tool.set("materialProperties.sand.nu", 0.3)
            self.refused(tool, "threads", "A", "setInt", self.fmu.reference("threads"), -1)
            tool.ok("A", "enter", 0)
        with Importer(self.fmu, token="{0-0}") as tool:
            self.refused(tool, "instantiationToken", "A", "instantiate")
        with Importer(self.fmu, resources=str(WORK / "nowhere/")) as tool:
            self.refused(tool, "found no case", "A", "instantiate", "quiet")

    def test_several_instances(self):
        straight = self.native()
        with Importer(self.fmu) as tool:
            self.start(tool, "A")
            self.start(tool, "B", materialProperties__sand__E=4e6)
            a, b = [], []
            for window in windows()[1:4]:
                a.append(self.drive(tool, window, "A"))
                b.append(self.drive(tool, window, "B"))
            self.assertEqual(a, straight[:3])
            self.assertEqual(b, self.native("constant/materialProperties", "sand.E", "4e6")[:3])
            for window in windows()[4:]:
                for who in "AB":
                    start, length, *pose = window
                    self.drive(tool, (start, 0, *pose), who)
                print("A,B", "steps", start.hex(), length.hex(), file=tool.process.stdin, flush=True)
                self.assertEqual({tuple(tool.answer()[1:3]) for _ in "AB"}, {("step", "OK")})
                self.assertEqual(self.row(tool, "A"), straight[windows().index(window) - 1])
            tool.ok("B", "free")
            tool.ok("A", "terminate")

    def test_what_stays_on_the_disk(self):
        before = content(self.fmu.folder)
        folder = WORK / "results"
        shutil.rmtree(folder, ignore_errors=True)
        with Importer(self.fmu) as tool:
            self.start(tool)
            self.whole(tool)
            self.assertEqual(len(list((WORK / "tmp").iterdir())), 1)
            tool.ok("A", "terminate")
            tool.ok("A", "free")
            self.assertEqual(list((WORK / "tmp").iterdir()), [])
            tool.ok("B", "instantiate")
            tool.ok("B", "setText", self.fmu.reference("outputFolder"), folder)
            self.assertEqual(tool.ok("B", "getText", self.fmu.reference("outputFolder")), [str(folder)])
            self.drive(tool, windows()[0], "B")
            tool.ok("B", "enter", 0)
            tool.ok("B", "exit")
            self.whole(tool, "B")
            tool.ok("B", "terminate")
            tool.ok("B", "free")
            tool.ok("C", "instantiate")
            tool.ok("C", "setText", self.fmu.reference("outputFolder"), folder)
            self.refused(tool, "outputFolder", "C", "enter", 0)
            tool.ok("C", "free")
            tool.ok("D", "instantiate")
            tool.ok("D", "forget")
        self.assertEqual(tool.exit, 0)
        self.assertEqual(content(self.fmu.folder), before, "the unpacked FMU is as it was")
        self.assertEqual(list((WORK / "tmp").iterdir()), [])
        self.assertTrue((folder / "postProcessing/history.csv").exists())
        self.assertTrue((folder / "0.02/state.h5").exists(), "the last accepted state")

    def test_export_refuses(self):
        def refused(text, *options):
            done = run(BUILD / "bin" / "exportFMU", "-case", self.case, *options)
            self.assertEqual(done.returncode, 1)
            self.assertIn(text, done.stderr)

        refused("there already", "-output", WORK / "sand.fmu")
        refused("ends in .fmu", "-output", WORK / "sand.zip")
        refused("cannot write", "-output", WORK / "nowhere/sand.fmu")
        for file, old, new, text in (("system/couplingDict", "Rigid", "Stiff", "system/couplingDict:14"),
                                     ("constant/materialProperties", "nu  ", "nuu ", "constant/materialProperties:")):
            path = self.case / file
            before = path.read_text()
            path.write_text(before.replace(old, new))
            refused(f"{self.case}/{text}", "-output", WORK / "wrong.fmu")
            path.write_text(before)
        self.assertEqual(list((WORK / "tmp").iterdir()), [])
        done = run(BUILD / "bin" / "exportFMU", "-case", self.case, "-dry-run", "-output", WORK / "dry.fmu")
        self.assertEqual((done.returncode, (WORK / "dry.fmu").exists()), (0, False))


if __name__ == "__main__":
    unittest.main()
