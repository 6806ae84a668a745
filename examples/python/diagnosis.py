#!/usr/bin/python3
"""usage: diagnosis.py PICTURE.png FOLDER
Why a laboratory's measurement (rig.json, frames.csv, clouds) differs from the model: heights before and after, and what
explains them."""
import sys

import matplotlib.pyplot as plt
import numpy as np

import fathom

if len(sys.argv) != 3:
    sys.exit(__doc__)

found = fathom.diagnose(sys.argv[2])
print(found.answer)
rows = found.residuals
heights = np.flatnonzero(rows.observable == "height_mm")
heights = heights[np.lexsort((rows.fill_mm[heights], rows.liquid[heights]))]

figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.5), layout="constrained", width_ratios=(2, 1))
number = np.arange(len(heights))
left.errorbar(number, rows.before[heights], rows.sigma[heights], fmt=".", label="the model as it is", color="tab:orange")
left.plot(number, rows.after[heights], ".", label="with what was found", color="tab:blue")
left.axhline(0.0, color="grey", linewidth=0.5)
left.set_xlabel("height in a cup, by liquid and fill")
left.set_ylabel("measured minus model [mm]")
left.legend()
likely = found.posterior[:6][::-1]
right.barh([row.words for row in likely], [row.probability for row in likely])
right.set(xlim=(0, 1), ylim=(-0.8, max(len(likely), 4) - 0.2))
right.set_xlabel("probability")
right.set_title(f"verdict: {found.verdict}")
figure.savefig(sys.argv[1], dpi=100)
