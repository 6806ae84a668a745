#!/usr/bin/env python3
"""usage: blind/povray/near_wall.py [--rise-mm 2.5] [--cups 12]
What a device shows of a meniscus: by how much paint in a cup reads higher near the wall than in its middle, with a flat
surface and with one that climbs the wall, in POV-Ray's world. Prints means over cups, rings of 2 mm and three sides.
Needs Debian's povray, python3-numpy, python3-opencv, python3-scipy."""
import argparse

import numpy as np

import world

RINGS_MM = [(low, low + 2) for low in range(2, 14, 2)]
FILL_MM, PLACE_MM = 40, (0, 250)


def height_map(scene, sensor, rng):
    """(ROWS, COLUMNS) of x, y, z in the world [mm]: what the device shows of a scene, without the unit's bias."""
    disparity = world.disparities(scene.infrared(rng, rng), scene.unit.reference(sensor))
    z = world.depth_mm(disparity)
    row, column = np.mgrid[0:world.ROWS, 0:world.COLUMNS]
    local = np.stack([(column - world.CENTRE[0]) * z / world.FOCAL_PX, (row - world.CENTRE[1]) * z / world.FOCAL_PX, z], -1)
    return sensor.camera_mm() + local @ sensor.axes()


def raised_mm(points, cup):
    """Of each ring: mean height above the middle's, of the far, left and right side together; NaN where nothing is seen."""
    right, away = points[..., 0] - cup.x_mm, points[..., 1] - cup.y_mm
    radius, height = np.hypot(right, away), points[..., 2]
    seen = np.abs(height - cup.bottom_mm - FILL_MM) < 5
    middle = height[seen & (radius < cup.inner_mm / 2)].mean()
    # The near wall hides its own side.
    sides = seen & (away > -np.abs(right))
    rings = [sides & (radius <= cup.inner_mm - low) & (radius > cup.inner_mm - high) for low, high in RINGS_MM]
    return [height[ring].mean() - middle if ring.any() else np.nan for ring in rings]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rise-mm", type=float, default=2.5)
    parser.add_argument("--cups", type=int, default=12, help="each another unit, place and speckle")
    options = parser.parse_args()
    found = {0.0: [], options.rise_mm: []}
    for number in range(options.cups):
        rng = np.random.default_rng([1, number])
        unit, (dx, dy) = world.Unit(rng), rng.normal(0, 2, 2)
        cup = world.Cup(PLACE_MM[0] + dx, PLACE_MM[1] + dy)
        sensor = world.Sensor()
        for rise_mm, rows in found.items():
            paint = world.Liquid(cup.bottom_mm + FILL_MM, rise_mm=rise_mm)
            scene = world.Scene(unit, sensor, cup, paint)
            rows.append(raised_mm(height_map(scene, sensor, np.random.default_rng([2, number])), cup))
    flat, curved = (np.nanmean(rows, 0) for rows in found.values())
    spread = np.nanstd(found[0.0], 0, ddof=1)
    print(f"| from the wall | flat surface [mm] | between cups, 1 σ [mm] | a meniscus of {options.rise_mm:g} mm adds [mm] |\n|---|---|---|---|")
    for (low, high), level, sd, more in zip(RINGS_MM, flat, spread, curved - flat):
        print(f"| {low} to {high} mm | {level:.2f} | {sd:.2f} | {more:.2f} |")


if __name__ == "__main__":
    main()
