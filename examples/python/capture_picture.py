#!/usr/bin/python3
"""usage: capture_picture.py PICTURE.png
One simulated shot of a cup with water: the infrared image and the depth that the device finds in it."""
import sys

import matplotlib.pyplot as plt
import numpy as np

import fathom

if len(sys.argv) != 2:
    sys.exit(__doc__)

shot = fathom.capture({
    "sensor": fathom.Sensor(model="xtion_pro_live_device", height_mm=650, aim_mm=[0, 400, 0]),
    "cups": [{"shape": "paper_cup", "position_mm": [0, 400], "liquid": "water", "fill_mm": 50}],
})
figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.5), layout="constrained")
left.imshow(shot.ir, cmap="gray", vmax=np.percentile(shot.ir, 99.5))
left.set_title("infrared")
depth = right.imshow(np.where(shot.depth > 0, 1000 * shot.depth, np.nan), cmap="viridis_r", vmin=600, vmax=1000)
right.set_title("measured depth; white: none")
figure.colorbar(depth, ax=right, label="depth [mm]")
figure.savefig(sys.argv[1], dpi=100)
