#!/usr/bin/python3
"""A rigid wall is pushed into the left side of the collapsing column, and drawn with what it feels.

    cp -r <libmpm>/cases/collapsingSoilColumn column && seedParticles -case column
    . <libmpm>/etc/bashrc                       # puts the module libmpm on PYTHONPATH
    examples/python/pushedWall.py column 0.4    # writes column/pushedWall.png
"""

# %% The wall: a box that stands off the column by half a cell, a little above the ground.
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import libmpm

case = Path(sys.argv[1] if len(sys.argv) > 1 else "column")
end = float(sys.argv[2]) if len(sys.argv) > 2 else 0.4  # [s]
window, speed = 0.02, 0.5  # [s], [m/s]
corners = np.array([(-0.94, 0.3), (-0.14, 0.3), (-0.14, 6.0), (-0.94, 6.0)])  # [m]
sides = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])

# %% The soil. Any word of the case's dictionaries can be another one for this run.
soil = libmpm.Participant(case, settings={
    "constant/materialProperties": {"soil.cohesion": 2e3},
    "system/controlDict": {"recordStrain": None},  # for mpmSolve alone: taken away
})
soil.add_coupling_surface("wall", corners, sides, kind="Rigid", mu=0.3)
soil.initialize()
for field in soil.fields("wall"):
    print(f"{field.name:14s} [{field.unit}] {field.direction}, {field.support}")

# %% Windows. The wall is repeated with twice the speed where it meets little, to show that a window can be taken back.
centre = soil.reference("wall")  # the point a pose is the place of
force = np.empty(3)  # filled again and again
rows = []
while soil.time < end - window / 2:
    start = soil.save_state()
    for trial in (speed, 2 * speed):
        soil.restore_state(start)
        soil.write_field("wall", "RigidPose", [centre[0] + trial * window, centre[1], 0, 1, 0, 0, 0], window)
        reached = soil.advance(window)
        if not reached:
            sys.exit(reached.message)
        soil.window_average("wall", "Force", out=force)
        if abs(force[0]) > 10e3:  # [N/m]
            break
    centre[0] += trial * window
    soil.accept_window()
    rows.append((soil.time, centre[0], force[0], force[1], reached.substeps))
time, place, push, lift, substeps = np.array(rows).T
print(f"{len(rows)} windows, {int(substeps.sum())} steps, wall at {place[-1] + 0.4:.3f} m")
print(f"work of the wall on the soil: {soil.interface_work('wall'):.4g} J/m")
soil.finalize()

# %% The picture.
figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6, 5), layout="constrained")
above.plot(time, -push / 1e3, label="against the push")
above.plot(time, lift / 1e3, label="downwards" if lift.mean() < 0 else "upwards")
above.set_ylabel("force on the wall [kN/m]")
above.legend()
below.plot(time, place - place[0])
below.set_ylabel("way of the wall [m]")
below.set_xlabel("time [s]")
figure.savefig(case / "pushedWall.png", dpi=120)
