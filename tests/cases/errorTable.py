"""Tables as accuracyCost writes them, made up for tests: postProcessing/accuracyCost.csv of a copy of the column."""

import csv

COLUMNS = ["row", "method", "cellSize", "particlesPerCell", "shape", "transfer", "order", "picRate", "stressUpdate",
           "staggeredStart", "timeIntegration", "splitting", "courant", "deltaT", "status", "reason", "errorMeasure",
           "error", "errorScale", "against", "value", "reference", "referenceRow", "referenceError", "temporalError",
           "spatialError", "pareto", "cpuSeconds", "wallSeconds", "repeats", "threads", "sideBySide", "particles",
           "steps", "particleSteps", "cells", "nsPerParticleStep", "endTime", "machine", "version", "key"]
VERSION = "0.1.0 0123456789, native"


def row(name, **values):
    """The column of cases/collapsingSoilColumn with splitting, one cell named otherwise by `values`."""
    cells = {"row": name, "method": "uGIMP MUSL", "cellSize": "0.2666666666666667", "particlesPerCell": "2",
             "shape": "uGIMP", "transfer": "FLIP", "picRate": "2", "stressUpdate": "MUSL", "staggeredStart": "no",
             "timeIntegration": "symplecticEuler", "splitting": "off", "courant": "0.8474", "deltaT": "0.001",
             "status": "done", "errorMeasure": "runOut", "error": "0.02", "errorScale": "4", "against": "finest",
             "value": "8", "reference": "8.1", "referenceRow": "finest", "referenceError": "0.001", "pareto": "0",
             "cpuSeconds": "0.3", "wallSeconds": "0.4", "repeats": "1", "threads": "1", "sideBySide": "1",
             "particles": "1800", "steps": "2500", "particleSteps": "4500000", "cells": "4725",
             "nsPerParticleStep": "66.7", "endTime": "2.5", "machine": "a machine", "version": VERSION, "key": "0"}
    cells.update({key: str(value) for key, value in values.items()})
    return [cells.get(column, "") for column in COLUMNS]


def write(case, rows):
    folder = case / "postProcessing"
    folder.mkdir(exist_ok=True)
    with open(folder / "accuracyCost.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)
