"""An FMU as a tool sees it: the unpacked archive, its description, and fmuImporter, a process that loads its library."""

import os
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve()
HERE = Path(__file__).resolve().parent
WORK = BUILD / "tests" / "coupling" / "fmi"
IMPORTER = BUILD / "tests" / "fmuImporter"
ENVIRONMENT = {**os.environ, "OMP_WAIT_POLICY": "passive", "TMPDIR": str(WORK / "tmp")}


def run(*command, **more):
    return subprocess.run([str(c) for c in command], text=True, capture_output=True, env=ENVIRONMENT, timeout=120, **more)


def fresh_case(name="sand"):
    """A seeded copy of the case."""
    (WORK / "tmp").mkdir(parents=True, exist_ok=True)
    folder = WORK / name
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(HERE / "case", folder)
    done = run(BUILD / "bin" / "seedParticles", "-case", folder)
    if done.returncode:
        raise RuntimeError(done.stderr)
    return folder


class Fmu:
    def __init__(self, file, folder):
        shutil.rmtree(folder, ignore_errors=True)
        with zipfile.ZipFile(file) as archive:
            self.entries = archive.infolist()
            archive.extractall(folder)
        self.folder = folder
        self.root = ElementTree.parse(folder / "modelDescription.xml").getroot()
        self.token = self.root.get("instantiationToken")
        self.identifier = self.root.find("CoSimulation").get("modelIdentifier")
        self.library = folder / "binaries" / "x86_64-linux" / f"{self.identifier}.so"
        self.variables = {v.get("name"): v for v in self.root.find("ModelVariables")}

    def reference(self, name):
        return int(self.variables[name].get("valueReference"))

    def size(self, name):
        size = 1
        for dimension in self.variables[name].findall("Dimension"):
            size *= int(dimension.get("start"))
        return size


class Importer:
    """Commands for one process; answers are (status, [words]); logs are kept."""

    def __init__(self, fmu, token=None, resources=None):
        self.fmu, self.logs = fmu, []
        resources = resources or f"{fmu.folder}/resources/"
        self.process = subprocess.Popen([IMPORTER, fmu.library, resources, token or fmu.token], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=ENVIRONMENT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.stdout.read()
        self.exit = self.process.wait(60)
        self.process.stdout.close()

    def answer(self):
        while True:
            words = self.process.stdout.readline().split()
            if not words:
                raise RuntimeError(f"the importer died: {self.process.wait(10)}; logs {self.logs[-3:]}")
            if words[1] != "log":
                return words
            self.logs.append((words[2], words[3], " ".join(words[4:])))

    def tell(self, *words):
        print(*words, file=self.process.stdin, flush=True)
        answer = self.answer()
        return answer[2], answer[3:]

    def ok(self, *words):
        status, values = self.tell(*words)
        assert status == "OK", (words, status, self.logs[-1:])
        return values

    def set(self, name, *values, who="A"):
        return self.tell(who, "set", self.fmu.reference(name), *(float(v).hex() for v in values))[0]

    def get(self, name, who="A"):
        values = self.ok(who, "get", self.fmu.reference(name), self.fmu.size(name))
        return [float.fromhex(v) for v in values]

    def step(self, start, length, who="A", keep=False):
        """keep: the importer may come back to the start."""
        status, values = self.tell(who, "step", float(start).hex(), float(length).hex(), *(["keep"] if keep else []))
        return status, values

    def begin(self, who="A", stop=None):
        self.ok(who, "instantiate")
        self.ok(who, "enter", 0, *([stop] if stop else []))
        self.ok(who, "exit")
