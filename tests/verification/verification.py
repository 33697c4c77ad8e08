"""What the check.py of a verification scene is written with, on top of tests/support/sceneCase.py.

A scene is a folder with geometry/, constant/, system/ and

    theory.md   set-up (numbers, units), solution with its derivation or source, what is measured, a table of measured
                errors and orders, references. The check writes the table between two comments and fails when the one
                that stands there is stale: tests/verification/check NAME --write renews it.
    check.py    its docstring says what the scene is, what is measured and when it passes:

    \"\"\"A bar with a manufactured solution.
    Measured: the largest RMS displacement error over time, against the cell size.
    Pass: order 2 +- 0.05.\"\"\"
    from verification import Verification, rms
    case = Verification(__file__, __doc__)
    def error(N):
        run = case.solve(f"N{N}", ("system/gridDict", "cellSize", 1 / N))
        return {"displacement [m]": rms(...)}
    study = case.study("uGIMP", "N", (16, 32, 64), error)
    case.check_order(study, "displacement [m]", 1.95, 2.05)
    case.finish()

tests/verification/check NAME runs one, below <build>/tests/verification/<name>/. A scene takes 1 to 15 s: ctest runs them
side by side, so each run has one thread unless a scene says otherwise.
"""

import math
import re
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from sceneCase import (BUILD, LONG, PROJECT, Run, SceneCase, State, checkerboard, log_number, pressure, record, schemes, set_fields,
                       treatment)

WRITE = "--write" in sys.argv
BEGIN, END = "<!-- measured: written by check.py --write -->", "<!-- end of measured -->"


class Number:
    """A number of a table: what is printed, and how far a later one may be from it before the table is stale. Below
    `floor` numbers are round-off, and all alike."""

    def __init__(self, value, form=".2e", relative=0.03, absolute=0.0, floor=0.0):
        self.value, self.form, self.relative, self.absolute, self.floor = value, form, relative, absolute, floor

    def __str__(self):
        if abs(self.value) < self.floor:
            return f"< {self.floor:.0e}"
        return "-" if math.isnan(self.value) else format(self.value, self.form)

    def agrees(self, text):
        if str(self) == text:
            return True
        try:
            other = float(text)
        except ValueError:
            return text.startswith("<") and abs(self.value) < 3 * self.floor
        printed = 0.6 * 10.0 ** (-int(self.form[1:-1]) + (math.floor(math.log10(abs(other))) if other and "f" not in self.form else 0))
        return abs(self.value - other) <= max(self.relative * abs(other), self.absolute, printed)


def order_of(value):
    """An observed order: two digits; the second may differ by machine."""
    return Number(value, ".2f", 0, 0.05)


class Study:
    """Errors of one variant against cells (or a step): errors by measure, orders by halving and by a fit."""

    def __init__(self, label, parameter, values, loose):
        self.label, self.parameter, self.values, self.loose = label, parameter, list(values), loose
        self.errors, self.failed = {}, {}

    def sizes(self):
        """Proportional to the cell size or step: N (cells) and steps count."""
        values = np.asarray(self.values, float)
        return 1 / values if self.parameter in ("N", "steps") else values

    def orders(self, measure):
        """Between neighbours: log(e1/e2)/log(h1/h2)."""
        e, h = np.asarray(self.errors[measure], float), self.sizes()
        with np.errstate(all="ignore"):
            return np.log(e[:-1] / e[1:]) / np.log(h[:-1] / h[1:])

    def fit(self, measure):
        """Slope of the line through all points of the log-log diagram."""
        e, h = np.asarray(self.errors[measure], float), self.sizes()
        good = np.isfinite(e) & (e > 0)
        return float(np.polyfit(np.log(h[good]), np.log(e[good]), 1)[0]) if good.sum() > 1 else math.nan


class Verification(SceneCase):
    KIND = "verification"

    def __init__(self, script, text):
        super().__init__(script, text, "Measured", "measured")
        self.tables, self.studies, self.nightly = [], [], []

    def solve(self, variant, *changes, exits=0, threads=1):
        """As in SceneCase, but a run that ends otherwise than it should ends the check; exits=None allows all."""
        run = self.seed(variant, *changes).utility("mpmSolve", threads=threads)
        if exits is not None and run.exit != exits:
            print(run.log)
            self.check(f"exit code of mpmSolve ({variant})", run.exit, "==", exits)
            super().finish()
        return run

    def study(self, label, parameter, values, error, loose=False):
        """Calls error(value) for each value; it returns {measure: error}, or a text that says why there is none. A study
        whose scheme diverges is `loose`: its numbers are chaotic, and the table is not stale before they are twice off."""
        study = Study(label, parameter, values, loose)
        for index, value in enumerate(values):
            found = error(value)
            if isinstance(found, str):
                study.failed[value] = found
                found = {measure: math.nan for measure in study.errors}
            for measure, number in found.items():
                study.errors.setdefault(measure, [math.nan] * index).append(number)
        if not study.errors:
            print("".join(f"      {label}, {parameter} = {value:g}: {why}\n" for value, why in study.failed.items()))
            self.check(f"runs that can be measured ({label})", 0, ">", 0)
            super().finish()
        for measure, errors in study.errors.items():
            orders = ", ".join(f"{order:.2f}" for order in study.orders(measure))
            print(f"      {label}, {parameter} = {', '.join(f'{v:g}' for v in values)}: {measure} "
                  f"{', '.join(f'{e:.3e}' for e in errors)}; orders {orders}; fit {study.fit(measure):.2f}")
        for value, why in study.failed.items():
            print(f"      {label}, {parameter} = {value:g}: {why}")
        self.studies.append(study)
        return study

    def check_order(self, study, measure, least, most=math.inf, last=None):
        """Every observed order (or the last ones) within bounds."""
        orders = study.orders(measure)[-last if last else 0:]
        self.check(f"smallest order, {measure} ({study.label})", float(np.min(orders)), ">=", least)
        if most < math.inf:
            self.check(f"largest order, {measure} ({study.label})", float(np.max(orders)), "<=", most)

    def table(self, title, columns, rows, nightly=()):
        """Adds a table to theory.md; cells are texts, Numbers or lists of Numbers. nightly: first cells of rows that no
        criterion needs, and --long alone makes."""
        self.tables.append((title, columns, rows))
        self.nightly += [] if LONG else [list(cells) for cells in nightly]

    def study_tables(self):
        """One table for all studies over the same values."""
        groups = {}
        for study in self.studies:
            groups.setdefault((study.parameter, tuple(study.values)), []).append(study)
        for (parameter, values), studies in groups.items():
            rows = []
            for study in studies:
                for measure, errors in study.errors.items():
                    numbers = [Number(e, ".0e" if study.loose else ".2e", 1.5 if study.loose else 0.03) for e in errors]
                    orders = ["fails" if study.failed else "diverges"] if study.loose else [[order_of(o) for o in study.orders(measure)]]
                    fit = ["-"] if study.loose else [order_of(study.fit(measure))]
                    rows.append([study.label, measure, *numbers, *orders, *fit])
            columns = ["variant", "error"] + [f"{parameter} = {v:g}" for v in values] + ["orders", "fit"]
            yield "", columns, rows

    def compare_theory(self):
        """Renews the tables of theory.md (--write), or makes it a criterion that they still hold."""
        tables = list(self.study_tables()) + self.tables
        path = self.scene / "theory.md"
        text = path.read_text() if path.exists() else ""
        if text.count(BEGIN) != 1 or text.count(END) != 1:
            sys.exit(f"{path}: found no place for the table between '{BEGIN}' and '{END}'")
        head, rest = text.split(BEGIN)
        old, tail = rest.split(END)
        if WRITE:
            if self.nightly:
                sys.exit(f"{path}: found a table with rows of --long, allowed is --write --long")
            path.write_text(head + BEGIN + "\n" + markdown(tables) + END + tail)
            return
        stale = differences(tables, without(old, self.nightly))
        for line in stale[:10]:
            print(f"      theory.md is stale: {line}")
        self.check("numbers of theory.md that no longer hold (--write renews them)", len(stale), "==", 0)

    def finish(self):
        if self.studies or self.tables:  # not after a run that broke off
            self.compare_theory()
        super().finish()


def cell_text(cell):
    return ", ".join(str(c) for c in cell) if isinstance(cell, list) else str(cell)


def markdown(tables):
    lines = []
    for title, columns, rows in tables:
        lines += ["", *([title, ""] if title else [])]
        lines += ["| " + " | ".join(cells) + " |" for cells in
                  [columns, ["---"] * len(columns)] + [[cell_text(c) for c in row] for row in rows]]
    return "\n".join(lines + ["", ""])


def without(text, rows):
    """The text of tables without rows that begin with these cells."""
    def cells(line):
        return [cell.strip() for cell in line.strip().strip("|").split("|")]
    return "\n".join(line for line in text.split("\n") if not any(cells(line)[:len(row)] == row for row in rows))


def differences(tables, old):
    """What a printed table says otherwise than these; the fresh numbers know how far off is stale."""
    fresh = markdown(tables).split("\n")
    there = old.strip("\n").split("\n")
    fresh = [line for line in fresh if line.strip()]
    there = [line for line in there if line.strip()]
    if len(fresh) != len(there):
        return [f"{len(there)} lines, now {len(fresh)}"]
    # rows are compared cell by cell, everything else as text
    wrong, rows_there = [], []
    for index, (new, line) in enumerate(zip(fresh, there)):
        in_body = new.startswith("|") and not new.startswith("| ---") and not (
            index + 1 < len(fresh) and fresh[index + 1].startswith("| ---"))
        if in_body:
            rows_there.append(line)
        elif new != line:
            wrong.append(f"'{line}', now '{new}'")
    rows = [row for _, _, rows in tables for row in rows]
    for row, line in zip(rows, rows_there):
        for cell, text in zip(row, [t.strip() for t in line.strip().strip("|").split("|")]):
            parts, texts = (cell, text.split(", ")) if isinstance(cell, list) else ([cell], [text])
            same = len(parts) == len(texts) and all(p.agrees(t) if isinstance(p, Number) else str(p) == t
                                                    for p, t in zip(parts, texts))
            if not same:
                wrong.append(f"{row[0]}: '{text}', now '{cell_text(cell)}'")
    return wrong


# Measures and exact solutions ----------------------------------------------------------------------------------------

def rms(error):
    """Root mean square over particles of the error's length."""
    error = np.asarray(error)
    return float(np.sqrt(np.mean(error**2 if error.ndim == 1 else (error**2).sum(axis=1))))


def displacements(run):
    """(time, displacement (N, dim) by id) of all stored states after the first; and the reference positions by id."""
    first = run.state(0).by_id("position")
    states = (run.state(name) for name in run.times()[1:])
    return first, ((state.time, state.by_id("position") - first) for state in states)


def worst_rms(run, exact):
    """Largest RMS displacement error over the stored times; exact(X, t) gives displacements (N, dim)."""
    X, states = displacements(run)
    return max(rms(u - exact(X, t)) for t, u in states)


def expressions(path, word="value"):
    """The vector of expressions of a dictionary entry, value ("..." 0 "..."), as a function of names: the very text the
    solver reads is what a check compares with its theory. Names of `constants { A 0.05; R "sqrt(X^2 + Y^2)"; }` are known,
    in their order; what is given by name when it is called comes before them."""
    text = re.sub(r"//[^\n]*", "", Path(path).read_text())
    text = re.sub(r"\blambda\b", "lambda_", text)  # a word of Python
    entry = re.search(rf"(?m)^\s*{word}\s*\(([^;]*)\)\s*;", text)
    parts = [a or b for a, b in re.findall(r'"([^"]*)"|([^\s"]+)', entry.group(1))]
    known = {"pi": np.pi, **{name: getattr(np, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "abs")},
             "ln": np.log, "atan2": np.arctan2}
    block = re.search(r"constants\s*\{([^}]*)\}", text)
    entries = re.findall(r'(\w+)\s+"?([^;"]+)"?\s*;', block.group(1)) if block else []
    named = [(name, compile(part.strip().replace("^", "**"), str(path), "eval")) for name, part in entries]
    code = [compile(part.replace("^", "**"), str(path), "eval") for part in parts]

    def value(**names):
        shape = np.broadcast(*names.values()).shape
        scope = {**known, **names, "__builtins__": {}}
        for name, part in named:
            scope[name] = eval(part, scope) if name not in names else names[name]
        return np.stack([np.broadcast_to(eval(c, scope), shape) for c in code], axis=-1)
    return value


WEIGHTS = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}  # first derivative, order 8
SECOND = {0: -205 / 72, 1: 8 / 5, 2: -1 / 5, 3: 8 / 315, 4: -1 / 560}


def gradient(f, X, step):
    """df_i/dX_j of f(X) -> (N, ...) by central differences of order 8, appended as the last axis."""
    columns = []
    for j in range(X.shape[1]):
        e = np.zeros(X.shape[1], X.dtype)
        e[j] = step
        columns.append(sum(w * (f(X + k * e) - f(X - k * e)) for k, w in WEIGHTS.items()) / step)
    return np.stack(columns, axis=-1)


def neo_hookean(lame, shear):
    """First Piola-Kirchhoff stress P(F) = lambda ln J F^-T + mu (F - F^-T), plane strain in 2D."""
    def stress(F):
        inverse = np.swapaxes(inverse_of(F), -1, -2)
        J = determinant_of(F)
        return (lame * np.log(J))[..., None, None] * inverse + shear * (F - inverse)
    return stress


def determinant_of(F):
    return F[..., 0, 0] if F.shape[-1] == 1 else F[..., 0, 0] * F[..., 1, 1] - F[..., 0, 1] * F[..., 1, 0]


def inverse_of(F):
    """Of 1x1 and 2x2 matrices, in the precision they come in."""
    if F.shape[-1] == 1:
        return 1 / F
    J = determinant_of(F)[..., None, None]
    return np.stack([np.stack([F[..., 1, 1], -F[..., 0, 1]], -1), np.stack([-F[..., 1, 0], F[..., 0, 0]], -1)], -2) / J


def body_force_of(displacement, stress, density, X, t, step, time_step):
    """The body force per mass [m/s^2] that makes X + displacement(X, t) a motion of a body with Piola stress stress(F):
    b = u_tt - Div P / rho0, all derivatives by differences, in long doubles. What a check holds its formulas against."""
    X, t = np.asarray(X, np.longdouble), np.longdouble(t)
    step, time_step = np.longdouble(step), np.longdouble(time_step)
    identity = np.eye(X.shape[1], dtype=np.longdouble)

    def piola(Y):
        return stress(identity + gradient(lambda Z: displacement(Z, t), Y, step))

    divergence = np.trace(gradient(piola, X, step), axis1=-2, axis2=-1)
    acceleration = sum(w * ((displacement(X, t + k * time_step) + displacement(X, t - k * time_step)) / (1 if k else 2))
                       for k, w in SECOND.items()) / time_step**2
    return np.asarray(acceleration - divergence / density, float)
