#!/usr/bin/env python3
"""usage: gate.py EXACT/frames.csv FATHOM/heights.csv NULL/heights.csv
The gate of the blind tests: without effects, errors and noise the generator's heights must differ from Fathom's geometric
ones by a norm of at least 3, in units of what the empty cup's height scatters by when it is put down anew (third table, a
set in which nothing is hidden). Prints rows; exit 1 where the two agree too well, or so badly that one is wrong."""
import csv
import sys
from collections import defaultdict
from math import sqrt

AGREE_TOO_WELL = 3.0
WORST_MM = 1.0  # more than any difference of matching explains


def heights(path):
    """Mean height and all heights of every condition [mm]."""
    found = defaultdict(list)
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["height_mm"]:
                place = tuple(float(row[key]) for key in ("fill_mm", "distance_mm", "lateral_mm"))
                found[row["liquid"], place].append((row["placement"], float(row["height_mm"])))
    return found


def mean(values):
    return sum(values) / len(values)


def scatter_of_empty(table):
    """Standard deviation of placements of the empty cup about their condition's mean [mm], pooled."""
    squares, freedom = 0.0, 0
    for (liquid, _), frames in table.items():
        if liquid != "empty":
            continue
        trials = defaultdict(list)
        for placement, height in frames:
            trials[placement].append(height)
        means = [mean(heights) for heights in trials.values()]
        squares += sum((height - mean(means)) ** 2 for height in means)
        freedom += len(means) - 1
    return sqrt(squares / freedom)


def main(exact_path, fathom_path, null_path):
    exact, fathom = heights(exact_path), heights(fathom_path)
    differences = [mean([h for _, h in exact[key]]) - mean([h for _, h in fathom[key]]) for key in fathom if key in exact]
    scatter = scatter_of_empty(heights(null_path))
    norm = sqrt(sum(d * d for d in differences)) / scatter
    rms = sqrt(mean([d * d for d in differences]))
    print(f"conditions        {len(differences)}")
    print(f"mean_difference   {mean(differences):.3f} mm")
    print(f"rms_difference    {rms:.3f} mm")
    print(f"scatter_of_empty  {scatter:.3f} mm")
    print(f"whitened_norm     {norm:.1f}")
    return 0 if norm >= AGREE_TOO_WELL and max(map(abs, differences)) < WORST_MM else 1


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
