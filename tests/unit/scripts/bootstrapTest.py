"""etc/bootstrap on machines made of stand-in tools: a Debian that lacks packages, other systems, users without rights."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[3]

# Stand-ins; each writes what it was asked to the file CALLS. `installed` holds the names of installed packages.
TOOLS = {
    "dpkg-query": 'for p in "${@:3}"; do grep -qx -- "$p" "$MACHINE/installed" && printf "installed=%s " "$p"; done; true',
    "apt-get": 'echo "apt-get $*" >> "$CALLS"; [ -z "${APT_FAILS:-}" ] || { echo "E: no network"; exit 100; }\n'
               'if [[ " $* " == *" install "* ]]; then printf "%s\\n" "$@" >> "$MACHINE/installed"; fi',
    "sudo": 'echo sudo >> "$CALLS"; [ -n "${SUDO_WORKS:-}" ] || exit 1; [ "$1" = -n ] && shift; exec "$@"',
    "id": 'echo "${USER_ID:-0}"',
    "cmake": 'echo "cmake $*" >> "$CALLS"\n'
             'if [[ " $* " == *" -S "* ]]; then [ -z "${CONFIGURE_FAILS:-}" ] || { seq 100; exit 1; }\n'
             'touch "$MACHINE/../build/build.ninja"; printf "CMAKE_HOME_DIRECTORY:INTERNAL=%s\\n" "${MACHINE%/*}" '
             '> "$MACHINE/../build/CMakeCache.txt"; else touch "$MACHINE/built"; fi',
    "ninja": '[ -e "$MACHINE/built" ] && echo "ninja: no work to do."; true',
}


class Bootstrap(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project = Path(folder.name).resolve()
        self.machine = self.project / "machine"
        self.machine.mkdir()
        (self.project / "etc").mkdir()
        shutil.copy(PROJECT / "etc" / "bootstrap", self.project / "etc")
        for name, text in TOOLS.items():
            self.tool(name, text)
        (self.machine / "os-release").write_text('ID=debian\nVERSION_ID="12"\nPRETTY_NAME="Debian GNU/Linux 12"\n')
        (self.machine / "installed").write_text("")

    def tool(self, name, text):
        path = self.machine / name
        path.write_text("#!/bin/bash\n" + text + "\n")
        path.chmod(0o755)

    def bootstrap(self, *options, **variables):
        environment = {**os.environ, "PATH": f"{self.machine}:/usr/bin:/bin", "MACHINE": str(self.machine),
                       "CALLS": str(self.machine / "calls"), "MPM_OS_RELEASE": str(self.machine / "os-release")}
        run = subprocess.run([self.project / "etc" / "bootstrap", *options], text=True, capture_output=True,
                             stdin=subprocess.DEVNULL, env={**environment, **variables})
        return run.returncode, run.stdout, run.stderr

    def calls(self):
        path = self.machine / "calls"
        text = path.read_text() if path.exists() else ""
        path.unlink(missing_ok=True)
        return text.splitlines()

    def install_everything(self):
        self.bootstrap("--packages-only", "--tests")
        self.calls()

    def test_installs_what_is_missing_and_says_which(self):
        code, out, _ = self.bootstrap("--packages-only")
        self.assertEqual(code, 0)
        count, names = re.fullmatch(r"Installing (\d+) packages: (.*)\n", out).groups()
        self.assertEqual(int(count), len(names.split()))
        self.assertTrue({"g++", "cmake", "libeigen3-dev", "libgmsh-dev"} <= set(names.split()))
        update, install = self.calls()
        self.assertTrue(update.endswith(" update"))
        self.assertIn(" install ", install)
        self.assertIn("--no-install-recommends", install)
        self.assertIn(" libcgal-dev ", install)

    def test_asks_for_the_missing_ones_only_and_for_nothing_when_all_are_there(self):
        self.install_everything()
        code, out, _ = self.bootstrap("--packages-only")
        self.assertEqual((code, out, self.calls()), (0, "", []))
        installed = self.machine / "installed"
        installed.write_text(installed.read_text().replace("catch2\n", ""))
        _, out, _ = self.bootstrap("--packages-only")
        self.assertEqual(out, "Installing 1 packages: catch2\n")
        self.assertEqual(len(self.calls()), 2)

    def test_the_audit_needs_more(self):
        self.install_everything()
        _, out, _ = self.bootstrap("--audit", "--packages-only")
        self.assertEqual(out, "Installing 4 packages: clang-14 libclang-rt-14-dev libomp-14-dev lld\n")
        self.calls()
        self.assertEqual(self.bootstrap("--audit", "--packages-only")[:2], (0, ""))

    def test_without_rights_prints_list_and_command(self):
        code, _, err = self.bootstrap(USER_ID="1000")
        self.assertEqual(code, 1)
        self.assertIn("needs root or sudo", err)
        self.assertIn("sudo apt-get install -y --no-install-recommends g++ make", err)
        self.assertEqual(self.calls(), ["sudo"])

    def test_uses_sudo_where_it_works(self):
        code, _, _ = self.bootstrap("--packages-only", USER_ID="1000", SUDO_WORKS="1")
        self.assertEqual(code, 0)
        self.assertTrue(self.calls()[-1].startswith("apt-get"))

    def test_another_distribution_is_left_alone(self):
        (self.machine / "os-release").write_text('ID=ubuntu\nVERSION_ID="22.04"\nPRETTY_NAME="Ubuntu 22.04"\n')
        code, _, err = self.bootstrap()
        self.assertEqual(code, 1)
        self.assertIn("Ubuntu 22.04, not Debian 12", err)
        self.assertIn("    libgmsh-dev\n", err)
        self.assertEqual(self.calls(), [])
        code, _, _ = self.bootstrap("--no-packages")
        self.assertEqual(code, 0)

    def test_a_failed_install_shows_why(self):
        code, _, err = self.bootstrap(APT_FAILS="1")
        self.assertEqual(code, 1)
        self.assertIn("E: no network", err)
        self.assertIn("log.bootstrap", err)

    def test_configures_once_and_builds_only_when_needed(self):
        self.install_everything()
        code, out, _ = self.bootstrap()
        self.assertEqual(code, 0)
        self.assertIn("Configuring (Release)", out)
        self.assertIn("-DCMAKE_BUILD_TYPE=Release", self.calls()[0])
        code, out, _ = self.bootstrap("--tests")
        self.assertEqual(code, 0)
        self.assertEqual(out, f"libmpm is ready in {self.project}/build/bin\n")
        self.assertEqual(self.calls(), [])

    def test_utilities_alone_or_with_tests(self):
        self.install_everything()
        self.bootstrap()
        self.assertIn("--target utilities ", self.calls()[-1] + " ")
        (self.machine / "built").unlink()
        self.bootstrap("--tests")
        self.assertIn("--target all ", self.calls()[-1] + " ")

    def test_a_copied_build_folder_is_configured_afresh(self):
        self.install_everything()
        (self.project / "build" / "build.ninja").write_text("")
        (self.project / "build" / "CMakeCache.txt").write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n")
        self.bootstrap()
        self.assertIn("--fresh", self.calls()[0])

    def test_a_failed_build_shows_the_last_30_lines_and_the_log(self):
        self.install_everything()
        code, _, err = self.bootstrap(CONFIGURE_FAILS="1")
        self.assertEqual(code, 1)
        self.assertIn("    71\n", err)
        self.assertNotIn("    70\n", err)
        self.assertIn(f"The whole log: {self.project}/build/log.bootstrap", err)

    def test_two_at_once_do_not_collide(self):
        self.install_everything()
        self.tool("cmake", 'echo begin >> "$CALLS"; sleep 0.5; echo end >> "$CALLS"\n' + TOOLS["cmake"].split("\n", 1)[1])
        environment = {**os.environ, "PATH": f"{self.machine}:/usr/bin:/bin", "MACHINE": str(self.machine),
                       "CALLS": str(self.machine / "calls"), "MPM_OS_RELEASE": str(self.machine / "os-release")}
        runs = [subprocess.Popen([self.project / "etc" / "bootstrap"], env=environment, text=True,
                                 stdout=subprocess.PIPE) for _ in range(2)]
        outputs = [run.communicate()[0] for run in runs]
        self.assertEqual([run.returncode for run in runs], [0, 0])
        self.assertEqual(self.calls(), ["begin", "end"] * 2)  # one configures and builds, the other finds it done
        self.assertEqual(sum("Waiting for another etc/bootstrap" in text for text in outputs), 1)

    def test_a_build_of_ones_own_is_left_alone(self):
        self.install_everything()
        code, out, _ = self.bootstrap(MPM_BUILD_DIR="/elsewhere/build-asan")
        self.assertEqual((code, self.calls()), (0, []))
        self.assertIn("/elsewhere/build-asan as it is", out)

    def test_unknown_option_is_an_error(self):
        code, _, err = self.bootstrap("--packges-only")
        self.assertEqual(code, 1)
        self.assertIn("unknown option --packges-only", err)
        self.assertEqual(self.calls(), [])


if __name__ == "__main__":
    unittest.main()
