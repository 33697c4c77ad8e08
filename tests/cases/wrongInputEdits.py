"""How a copy of the column gets the wrong inputs of wrongInputList.py: functions that make a change of the case folder."""

import shutil

import h5py
import numpy as np


def edit(file, old, new):
    """Replaces the only occurrence of a text."""
    def change(case):
        text = (case / file).read_text()
        assert text.count(old) == 1, f"'{old}' in {file}: {text.count(old)} times"
        (case / file).write_text(text.replace(old, new))
    return change


def write(file, text):
    def change(case):
        (case / file).parent.mkdir(exist_ok=True)
        (case / file).write_bytes(text if isinstance(text, bytes) else text.encode())
    return change


def append(file, text):
    return lambda case: (case / file).write_text((case / file).read_text() + text)


def remove(file):
    return lambda case: (case / file).unlink()


def state(action):
    """Edits 0/state.h5 with h5py."""
    def change(case):
        with h5py.File(case / "0" / "state.h5", "r+") as file:
            action(file)
    return change


def both(*changes):
    return lambda case: [change(case) for change in changes]


def other_case(time):
    """A second case in `other`, whose only time is the seeded one by another name."""
    def change(case):
        for part in ("constant", "system"):
            shutil.copytree(case / part, case / "other" / part)
        shutil.copytree(case / "0", case / "other" / time)
    return change


def other_dimension(case):
    with h5py.File(case / "other" / "0" / "state.h5", "r+") as file:
        file.attrs["dimension"] = np.int64(3)


def put(name, index, value):
    def action(file):
        file[name][index] = value
    return state(action)


def attribute(name, value):
    def action(file):
        file.attrs[name] = value
    return state(action)


def replaced(name, values):
    def action(file):
        del file[name]
        file[name] = values
    return state(action)


def cut(part):
    def change(case):
        file = case / "0" / "state.h5"
        file.write_bytes(file.read_bytes()[: int(part * file.stat().st_size)])
    return change


def linked(name):
    def action(file):
        del file[name]
        file[name] = h5py.ExternalLink("/etc/hostname", "/")
    return state(action)


def compressed(name):
    def action(file):
        values = file[name][()]
        del file[name]
        file.create_dataset(name, data=np.zeros_like(values), compression="gzip")
    return state(action)
