#!/usr/bin/python3
"""usage: detected_cup.py PICTURE.png [CLOUD.pcd]
What the detector finds in a cloud, of a file or simulated: the cloud from the side and from above, cups in colour."""
import sys

import matplotlib.pyplot as plt
import numpy as np

import fathom

if len(sys.argv) not in (2, 3):
    sys.exit(__doc__)

if len(sys.argv) > 2:
    cloud, intensity = fathom.read_cloud(sys.argv[2])
else:
    shot = fathom.capture(fathom.scene("paper_water"))
    cloud, intensity = shot.cloud, shot.intensity
found = fathom.detect(cloud, intensity)
if found.plane is None:
    sys.exit(found.why)


def on_desk(points):
    """In mm: x to the right, y away from the camera, z up from the desk."""
    points = points.reshape(-1, 3)
    turn = found.desk_from_camera
    return 1000 * (points[np.isfinite(points[:, 2])] @ turn[:3, :3].T + turn[:3, 3])


figure, (above, side) = plt.subplots(1, 2, figsize=(12, 5), layout="constrained")
for axes, first, second, names in ((above, 0, 1, ("x", "y")), (side, 1, 2, ("y", "z"))):
    desk = on_desk(cloud)[::7]
    axes.plot(desk[:, first], desk[:, second], ".", color="silver", markersize=1)
    for number, cup in enumerate(found.cups):
        points = on_desk(cup.points)
        fill = "" if cup.fill_mm is None else f", {cup.fill_mm:.0f} mm"
        axes.plot(points[:, first], points[:, second], ".", markersize=2,
                  label=f"cup {number}: radius {cup.radius_mm:.0f} mm, liquid {cup.liquid}{fill}")
    middle = on_desk(np.concatenate([cup.points for cup in found.cups])).mean(axis=0) if found.cups else desk.mean(axis=0)
    axes.set_xlim(middle[first] - 150, middle[first] + 150)
    axes.set_ylim(*((-10, 150) if second == 2 else (middle[1] - 150, middle[1] + 150)))
    axes.set_xlabel(f"{names[0]} [mm]")
    axes.set_ylabel(f"{names[1]} [mm]")
    axes.set_aspect("equal")
if found.cups:
    above.legend(loc="upper right", markerscale=5)
figure.savefig(sys.argv[1], dpi=100)
