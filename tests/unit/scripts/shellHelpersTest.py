"""etc/bashrc, etc/completion and etc/RunFunctions, tried in a miniature project with a utility made for the purpose."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[3]

# Prints its options when asked for them; else says what it was given and leaves with the code in EXIT_CODE.
UTILITY = """#!/usr/bin/env bash
if [ "$1" = -completionWords ]; then printf '%s\\n' -case -help -latestTime -threads -time; exit; fi
echo "option: $*"; echo "the last words"; exit "${EXIT_CODE:-0}"
"""


class ShellHelpers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project = Path(folder.name).resolve() / "clone"
        self.case = self.project / "cases" / "small"
        (self.project / "etc").mkdir(parents=True)
        for name in ("bashrc", "completion", "RunFunctions"):
            shutil.copy(PROJECT / "etc" / name, self.project / "etc")
        (self.project / "utilities" / "doWork").mkdir(parents=True)
        (self.project / "build" / "bin").mkdir(parents=True)
        utility = self.project / "build" / "bin" / "doWork"
        utility.write_text(UTILITY)
        utility.chmod(0o755)
        for name in ("system", "constant", "0", "0.25", "1", "1e-05", "postProcessing", "2nd"):
            (self.case / name).mkdir(parents=True)
        (self.case / "system" / "controlDict").write_text("\n")

    def shell(self, script, program="bash", **variables):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("MPM_")}
        run = subprocess.run([program, "-c", script], cwd=self.case, text=True, capture_output=True,
                             env={**environment, **variables})
        return run.returncode, run.stdout, run.stderr

    def test_bashrc_finds_its_project_and_extends_the_path_once(self):
        for program in ("bash", "zsh"):
            if not shutil.which(program):
                continue
            with self.subTest(program):
                code, out, err = self.shell(
                    f"set -eu; cd /; source {self.project}/etc/bashrc; source {self.project}/etc/bashrc;"
                    ' printf "%s\\n" "$MPM_PROJECT_DIR" "$PATH"', program)
                self.assertEqual((code, err), (0, ""))
                home, path = out.splitlines()
                self.assertEqual(home, str(self.project))
                self.assertEqual(path.split(":")[:2], [f"{home}/build/bin", f"{home}/etc"])
                self.assertEqual(path.count(f"{home}/"), 2)

    def test_bashrc_puts_the_python_module_first_once(self):
        _, out, err = self.shell(f"for i in 1 2; do . {self.project}/etc/bashrc; done; echo $PYTHONPATH",
                                 PYTHONPATH="/of/the/user")
        self.assertEqual((out, err), (f"{self.project}/build/python:/of/the/user\n", ""))
        _, out, _ = self.shell(f"unset PYTHONPATH; set -u; . {self.project}/etc/bashrc; echo $PYTHONPATH")
        self.assertEqual(out, f"{self.project}/build/python\n")

    def test_the_clone_sourced_last_comes_first(self):
        other = self.project.parent / "other"
        shutil.copytree(self.project, other)
        _, out, _ = self.shell(f"for c in {self.project} {other} {self.project}; do . $c/etc/bashrc; done; echo $PATH")
        self.assertTrue(out.startswith(f"{self.project}/build/bin:"), out)
        self.assertEqual(out.count(f"{self.project}/build/bin"), 1)

    def test_a_build_of_ones_own(self):
        _, out, _ = self.shell(f". {self.project}/etc/bashrc; echo $PATH", MPM_BUILD_DIR="/elsewhere/build-asan")
        self.assertTrue(out.startswith(f"/elsewhere/build-asan/bin:{self.project}/etc:"), out)

    def test_an_instruction_set_hides_what_lies_above(self):
        def tunables(before, *wanted):
            lines = "; ".join(f"MPM_INSTRUCTION_SET={name}; . {self.project}/etc/bashrc" for name in wanted)
            return self.shell(f'{lines}; echo "${{GLIBC_TUNABLES-none}}"', GLIBC_TUNABLES=before)[1].strip()

        hidden2, hidden3 = "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F", "glibc.cpu.hwcaps=-AVX512F"
        self.assertEqual(tunables("", "x86-64-v2"), hidden2)
        self.assertEqual(tunables("", "x86-64-v3"), hidden3)
        self.assertEqual(tunables("", "x86-64-v2", "x86-64-v3"), hidden3)
        self.assertEqual(tunables("", "x86-64-v2", ""), "none")
        self.assertEqual(tunables("", "x86-64-v4"), "none")
        other = "glibc.malloc.check=0"
        self.assertEqual(tunables(other, ""), other)
        self.assertEqual(tunables(other, "x86-64-v3"), f"{other}:{hidden3}")
        self.assertEqual(tunables(other, "x86-64-v3", "x86-64-v4"), other)

    def test_an_instruction_set_nobody_knows_is_refused(self):
        code, _, err = self.shell(f". {self.project}/etc/bashrc", MPM_INSTRUCTION_SET="avx9")
        self.assertEqual(code, 1)
        self.assertIn("found 'avx9', allowed x86-64-v2, x86-64-v3, x86-64-v4", err)

    def test_an_installed_tree_has_its_utilities_elsewhere(self):
        (self.project / "etc" / "installed").write_text("../bin\n")
        shutil.copy(PROJECT / "etc" / "bootstrap", self.project / "etc")
        programs = self.project.parent / "bin"
        programs.mkdir()
        _, out, _ = self.shell(f". {self.project}/etc/bashrc; echo $PATH; {self.project}/etc/bootstrap && echo nothing to do")
        self.assertTrue(out.startswith(f"{programs}:"), out)
        self.assertIn("nothing to do", out)

    def complete(self, *words):
        quoted = " ".join(f"'{word}'" for word in words)
        code, out, err = self.shell(
            f". {self.project}/etc/bashrc; . {self.project}/etc/completion; complete -p doWork > /dev/null || exit 9;"
            f"COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _mpmComplete; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        self.assertEqual((code, err), (0, ""))
        return out.split()

    def test_completion_offers_options_times_and_folders(self):
        self.assertEqual(self.complete("doWork", "-t"), ["-threads", "-time"])
        self.assertEqual(self.complete("doWork", "-time", ""), ["0", "1e-05", "0.25", "1"])
        self.assertEqual(self.complete("doWork", "-time", "0"), ["0", "0.25"])
        self.assertEqual(self.complete("doWork", "-case", "sys"), ["system"])
        self.assertEqual(self.complete("doWork", "-case", "../small", "-time", "1"), ["1e-05", "1"])

    def test_run_application_writes_a_log_and_does_not_run_twice(self):
        script = f". {self.project}/etc/RunFunctions; runApplication doWork -time 1"
        code, out, _ = self.shell(script)
        self.assertEqual((code, out), (0, f"Running doWork -time 1 on {self.case}\n"))
        self.assertEqual((self.case / "log.doWork").read_text(), "option: -time 1\nthe last words\n")
        code, out, _ = self.shell(script.replace("-time 1", "-time 2"))
        self.assertEqual(code, 0)
        self.assertIn("already run", out)
        self.assertIn("option: -time 1\n", (self.case / "log.doWork").read_text())
        self.shell(f". {self.project}/etc/RunFunctions; runApplication -o doWork -time 3")
        self.assertIn("option: -time 3\n", (self.case / "log.doWork").read_text())
        self.shell(f". {self.project}/etc/RunFunctions; runApplication -s fine doWork")
        self.assertTrue((self.case / "log.doWork.fine").exists())

    def test_run_application_stops_the_script_on_failure_and_runs_a_failed_step_again(self):
        script = f". {self.project}/etc/RunFunctions; runApplication doWork; echo went on"
        code, out, err = self.shell(script, EXIT_CODE="3")
        self.assertEqual(code, 3)
        self.assertNotIn("went on", out)
        self.assertIn("doWork failed (exit 3)", err)
        self.assertIn("the last words", err)
        self.assertIn("log.doWork", err)
        code, out, _ = self.shell(script)
        self.assertEqual((code, out), (0, f"Running doWork on {self.case}\nwent on\n"))

    def test_an_interrupted_step_runs_again(self):
        script = f". {self.project}/etc/RunFunctions; runApplication doWork; echo went on"
        (self.project / "build" / "bin" / "doWork").write_text("#!/bin/bash\necho started; kill -INT $PPID; sleep 0.2\n")
        code, out, _ = self.shell(script)
        self.assertEqual(code, 130)
        self.assertNotIn("went on", out)
        (self.project / "build" / "bin" / "doWork").write_text(UTILITY)
        _, out, _ = self.shell(script)
        self.assertIn("Running doWork", out)

    def test_a_utility_that_is_not_there_is_a_failure(self):
        code, _, err = self.shell(f". {self.project}/etc/RunFunctions; runApplication noSuchThing")
        self.assertEqual(code, 127)
        self.assertIn("noSuchThing failed", err)

    def test_clean_case_removes_results_only(self):
        for name in ("log.doWork", "state.xdmf", "Allrun"):
            (self.case / name).write_text("\n")
        code, _, _ = self.shell(f". {self.project}/etc/RunFunctions; cleanCase")
        self.assertEqual(code, 0)
        self.assertEqual(sorted(path.name for path in self.case.iterdir()), ["2nd", "Allrun", "constant", "system"])

    def test_clean_case_refuses_a_folder_that_is_no_case(self):
        code, _, err = self.shell(f". {self.project}/etc/RunFunctions; cd postProcessing; mkdir 1; cleanCase")
        self.assertEqual(code, 1)
        self.assertIn("is no case", err)
        self.assertTrue((self.case / "postProcessing" / "1").exists())


if __name__ == "__main__":
    unittest.main()
