#!/usr/bin/python3
"""usage: raised_bottom.py PICTURE.png
The bottom of a cup with more and more water, by simulated shots without noise and by the paper's Eq. 7."""
import sys

import matplotlib.pyplot as plt
import numpy as np

import fathom

if len(sys.argv) != 2:
    sys.exit(__doc__)

DISTANCE_MM, BOTTOM_MM, HEIGHT_MM, NEAR_MM = 400, 6, 650, 10
SHAPE = {"height_mm": 70, "inner_radius_mm": 50, "outer_radius_mm": 53, "bottom_mm": BOTTOM_MM}


def rise_mm(fill_mm):
    """Mean height of the pixels that see the middle of the cup's bottom."""
    camera = fathom.Camera({
        "sensor": {"model": "xtion_pro_live", "height_mm": HEIGHT_MM, "aim_mm": [0, DISTANCE_MM, 0], "quantization": "off"},
        "cups": [{"shape": SHAPE, "position_mm": [0, DISTANCE_MM], "liquid": "water", "fill_mm": fill_mm}],
    }, mode="geometric")
    shot = camera.shoot()
    there = 1000 * camera.truth.position - [0, DISTANCE_MM, BOTTOM_MM]
    seen = (np.linalg.norm(there, axis=2) < NEAR_MM) & (shot.depth > 0)
    world = shot.cloud[seen] @ shot.world_from_camera[:3, :3].T + shot.world_from_camera[:3, 3]
    return 1000 * world[:, 2].mean() - BOTTOM_MM


fill_mm = np.arange(5, 46, 5)
theory = fathom.theory(fill_mm, DISTANCE_MM, height_mm=HEIGHT_MM - BOTTOM_MM, index=1.329)  # of water at 830 nm
plt.plot(fill_mm, theory.eq7_mm, label="Eq. 7")
plt.plot(fill_mm, [rise_mm(float(fill)) for fill in fill_mm], "o", label="simulated shots")
plt.xlabel("fill [mm]")
plt.ylabel("rise of the bottom [mm]")
plt.legend()
plt.savefig(sys.argv[1], dpi=100)
