#!/usr/bin/python3
"""usage: theory_curve.py PICTURE.png
How high the bottom of a cup seems under water: the paper's Eq. 7 beside exact optics, over the fill."""
import sys

import matplotlib.pyplot as plt
import numpy as np

import fathom

if len(sys.argv) != 2:
    sys.exit(__doc__)

fill_mm = np.linspace(1.0, 90.0, 90)
for distance_mm in (200.0, 400.0, 600.0):
    curve = fathom.theory(fill_mm, distance_mm)
    line, = plt.plot(fill_mm, curve.exact_mm, label=f"exact, {distance_mm:.0f} mm away")
    plt.plot(fill_mm, curve.eq7_mm, "--", color=line.get_color())
plt.plot([], [], "--", color="grey", label="Eq. 7")
plt.xlabel("fill [mm]")
plt.ylabel("measured height of the bottom [mm]")
plt.title("A bottom under water, seen from 650 mm above")
plt.legend()
plt.savefig(sys.argv[1], dpi=100)
