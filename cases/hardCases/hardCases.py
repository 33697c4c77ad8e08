"""Runs the hard cases of tests/stability and writes one table of what they measured; called by Allrun.

    hardCases.py [NAME ...]     all cases, or these: postProcessing/hardCases.csv and hardCases.md
    hardCases.py --readme       all, and the table replaces that of README.md
    hardCases.py --check        runs nothing: does README's table list the cases there are?
"""
import ast
import csv
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
if not (PROJECT / "etc").is_dir() and os.environ.get("MPM_PROJECT_DIR"):  # a copy of the folder elsewhere
    PROJECT = Path(os.environ["MPM_PROJECT_DIR"]).resolve()
SCENES = PROJECT / "tests" / "stability"
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve()
OUT = HERE / "postProcessing"
README = HERE / "README.md"
COLUMNS = ["case", "whatIsHard", "criterion", "measured", "verdict"]
AT_ONCE = 2
BEGIN, END = "<!-- table: written by ./Allrun --readme -->", "<!-- end of table -->"
# what HardCase.common checks in every case; told where it failed, and the energy always
COMMON = ("numbers that are not finite", "change of mass", "momentum that came from nowhere", "yield violation", "energy residual")


def case_names():
    return sorted(path.parent.name for path in SCENES.glob("*/check.py"))


def about(name):
    """Title and criterion from the docstring, for a case that left no verdict."""
    text = " ".join((ast.get_docstring(ast.parse((SCENES / name / "check.py").read_text())) or "").split())
    title, _, rest = text.partition(" Hard: ")
    hard, _, criterion = rest.partition(" Pass: ")
    return {"case": name, "title": title, "whatIsHard": hard, "criterion": criterion}


def run(name):
    """The case's verdict, seconds; a script that broke off failed."""
    verdict = BUILD / "tests" / "stability" / name / "verdict.json"
    verdict.unlink(missing_ok=True)
    start = time.monotonic()
    with open(OUT / f"log.{name}", "w") as log:
        code = subprocess.run([SCENES / "check", name], stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                              env={**os.environ, "MPM_BUILD_DIR": str(BUILD)}).returncode
    seconds = time.monotonic() - start
    if verdict.exists():
        return json.loads(verdict.read_text()), seconds
    broken = {"passed": False, "checks": [], "broken": f"no verdict, exit code {code}: postProcessing/log.{name}"}
    return {**about(name), **broken}, seconds


def number(value):
    if isinstance(value, str):
        return value
    return f"{value:.0f}" if abs(value) < 1e6 and value == round(value) else f"{value:.2g}"


def slack(check):
    """How far a measured number is from its bound; 0 is on it, less than 0 beyond. A number that is only recorded has none."""
    if check["relation"] == "recorded":
        return float("inf")
    measured, bound = check["measured"], check["bound"]
    if not check["passed"] or isinstance(measured, str) or measured != measured:
        return -1.0
    return abs(bound - measured) / max(abs(bound), abs(measured), 1e-300)


def bound_text(check):
    return "(recorded)" if check["relation"] == "recorded" else f"({check['relation']} {number(check['bound'])})"


def decisive(checks, most=4):
    """Of all variants of a criterion the one nearest to its bound: those that failed, then the case's own, then energy."""
    groups = {}
    for check in checks:
        what = re.sub(r"\s*\([^()]*\)\s*$", "", check["what"])
        worst = groups.get(what)
        if worst is None or slack(check) < slack(worst):
            groups[what] = check
    failed = [what for what, check in groups.items() if not check["passed"]]
    own = [what for what in groups if what not in COMMON and what not in failed]
    own.sort(key=lambda what: (what.startswith("exit code"), groups[what]["relation"] == "recorded"))
    chosen = failed + own[:max(most - len(failed), 0)]
    chosen += [what for what in ("energy residual",) if what in groups and what not in chosen]
    text = [f"{what} {number(groups[what]['measured'])} {groups[what]['unit']} " + bound_text(groups[what]) +
            (" FAILED" if what in failed else "") for what in chosen]
    return "; ".join(" ".join(part.split()) for part in text)


def row(verdict):
    return {"case": verdict["case"], "whatIsHard": f"{verdict['title']} {verdict['whatIsHard']}", "criterion": verdict["criterion"],
            "measured": verdict.get("broken") or decisive(verdict["checks"]),
            "verdict": "passed" if verdict["passed"] else "FAILED"}


def markdown(rows):
    def cells(texts):
        return "| " + " | ".join(text.replace("|", "\\|").replace("<=", "≤").replace(">=", "≥") for text in texts) + " |"
    lines = [cells(COLUMNS), cells(["---"] * len(COLUMNS))]
    return "\n".join(lines + [cells(r[c] for c in COLUMNS) for r in rows]) + "\n"


def write_tables(rows):
    with open(OUT / "hardCases.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    (OUT / "hardCases.md").write_text(markdown(rows))


def readme_parts():
    head, begin, rest = README.read_text().partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not begin or not end:
        sys.exit(f"{README}: found no table between '{BEGIN}' and '{END}'")
    return head + BEGIN + "\n", rest.partition(END)[0], END + tail


def readme_ages():
    """What is wrong with README's list of cases; empty if nothing."""
    listed = [line.split("|")[1].strip() for line in readme_parts()[1].splitlines() if line.startswith("| ")][2:]
    there = case_names()
    wrong = [f"README.md lacks {name}" for name in there if name not in listed]
    wrong += [f"README.md lists {name}, which is not there" for name in listed if name not in there]
    return wrong + ([] if len(listed) == len(set(listed)) else ["README.md lists a case twice"])


def progress(done, total, start):
    elapsed = time.monotonic() - start
    left = elapsed / done * (total - done)
    return f"[{done}/{total}] {elapsed:4.0f} s, about {left:.0f} s left"


def main(arguments):
    options, names = [a for a in arguments if a.startswith("-")], [a for a in arguments if not a.startswith("-")]
    if not SCENES.is_dir():
        sys.exit("The scenes of the hard cases are in tests/stability of libmpm's source tree, which an installation does not "
                 "carry: run cases/hardCases/Allrun in a clone of libmpm.")
    there = case_names()
    for wrong in [o for o in options if o not in ("--readme", "--check")] + [n for n in names if n not in there]:
        sys.exit(f"hardCases.py: found '{wrong}'; allowed: --readme, --check or names among {', '.join(there)}")
    if "--check" in options:
        for line in readme_ages():
            print(line, flush=True)
        sys.exit("run cases/hardCases/Allrun --readme" if readme_ages() else 0)
    if names and "--readme" in options:
        sys.exit("hardCases.py: --readme needs all cases, not some by name")

    OUT.mkdir(exist_ok=True)
    start, verdicts, names = time.monotonic(), {}, names or there
    with ThreadPoolExecutor(AT_ONCE) as pool:
        jobs = {pool.submit(run, name): name for name in names}
        for job in as_completed(jobs):
            name = jobs[job]
            verdicts[name], seconds = job.result()
            print(f"{progress(len(verdicts), len(names), start)}  {'passed' if verdicts[name]['passed'] else 'FAILED'}  "
                  f"{name} ({seconds:.1f} s)", flush=True)
    rows = [row(verdicts[name]) for name in sorted(names)]
    write_tables(rows)
    if "--readme" in options:
        head, _, tail = readme_parts()
        README.write_text(head + markdown(rows) + tail)
    failed = [r["case"] for r in rows if r["verdict"] == "FAILED"]
    print(f"\n{len(rows) - len(failed)} of {len(rows)} hard cases passed in {time.monotonic() - start:.0f} s; the table: "
          f"{OUT / 'hardCases.md'}")
    for line in readme_ages():
        print(f"note: {line}; ./Allrun --readme refreshes it")
    for name in failed:
        print(f"FAILED: {name}: {OUT / ('log.' + name)}")
    sys.exit(1 if failed else 0)


main(sys.argv[1:])
