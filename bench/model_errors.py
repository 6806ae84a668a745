#!/usr/bin/env python3
"""By how much the diagnosis mispredicts what simulated devices measure, as standard deviations of errors that
observations share. The sizes in diagnosis/predict/model_errors.cpp come from here.

  bench/model_errors.py build/release/app/fathom --members 36 -o out/model_errors

Each member of the ensemble is a campaign with nothing hidden. Sensor, pattern, block, cup and kind are its own; rig and
fills are known exactly, and the unit has no bias, so what is left is the prediction's own error. Kinds take turns: exact
triangulation, Fathom's infrared images matched by OpenCV, and Fathom's frames. Variances are found by restricted maximum
likelihood over all members of a kind. "own" is what one placement has for itself: noise, and no error of the model. Needs
NumPy and OpenCV (Debian: python3-opencv).
Members whose residuals are in the folder already are not run again.
"""
import argparse, csv, json, pathlib, random, shutil, sys
import numpy as np

from device_campaigns import PAINT, run
from opencv_matcher import match_again

SENSORS = ("xtion_pro_live_device", "kinect_v1_device", "xtion_pro_live")
CUPS = {"paper_cup": 30, "mug": 25, "tapered_cup": 30}  # and a middle fill of each, in mm
BLOCKS = (7, 9, 11)  # columns or rows; the shipped devices have 9
KINDS = ("photometric", "geometric", "opencv")  # of member 0, 1, 2, 3, …
REFERENCE_MM = 1200
OF_WALLS_PX = 1000  # sizes of errors of walls are those of a circle that knows as much as a mean of so many

PLACE = ("lateral_mm", "distance_mm")
CONDITION = ("liquid", "fill_mm", *PLACE)
SHARED_BY = {"all": (), "region": ("region",), "liquid region": ("liquid", "region"), "place": PLACE,
             "place region": (*PLACE, "region"), "condition": CONDITION, "condition region": (*CONDITION, "region"),
             "own": (*CONDITION, "region", "session", "pour", "placement")}
LEVELS = {"height_mm": ("all", "liquid region", "place", "place region", "condition", "condition region", "own"),
          "content_shape_mm": ("region", "liquid region"), "desk_residual_mm": ("all", "region", "own"),
          **{name: ("all", "place", "condition", "own")
             for name in ("cup_x_mm", "cup_y_mm", "cup_radius_mm", "desk_height_mm", "desk_pitch_deg", "desk_roll_deg")}}


def member(number):
    draw = random.Random(number)
    sensor = {"model": draw.choice(SENSORS), "height_mm": draw.choice((620, 650, 700)), "aim_mm": [0, 300, 0],
              "pattern": {"seed": number}, "unit": {"residue_px": 0}}
    if sensor["model"].endswith("_device"):
        sensor["matcher"] = {"window_columns": draw.choice(BLOCKS), "window_rows": draw.choice(BLOCKS)}
    else:
        sensor["noise"] = "device"
    cup = draw.choice(sorted(CUPS))
    fills = [draw.uniform(0.5, 1.4) * CUPS[cup] for _ in range(3)]
    fillings = [{"liquid": liquid, "fill_mm": round(fill)} for liquid, fill in zip(("water", "water", "paint"), fills)]
    return {"sensor": sensor, "cup": {"shape": cup}, "liquids": {"water": "water", "paint": PAINT},
            "fillings": [{"liquid": "empty"}, *fillings], "distance_mm": [200, 300, 400],
            "lateral_mm": [-draw.choice((60, 80)), draw.choice((0, 40))], "pours": 2, "trials": 1, "bare_desk_views": 3,
            "fill_sigma_mm": 0, "mode": "geometric" if kind(number) == "geometric" else "photometric"}


def kind(number):
    return KINDS[number % len(KINDS)]


def matched_by_opencv(args, number, folder):
    """The clouds of the member's campaign, made anew with OpenCV and a wall that the same unit took for reference."""
    sensor = {**member(number)["sensor"], "height_mm": REFERENCE_MM, "pitch_deg": 90}
    del sensor["aim_mm"]
    wall = {"sensor": sensor, "desk": {"size_mm": [3000, 3000]}}
    (folder / "reference.json").write_text(json.dumps(wall))
    run([args.fathom, "capture", folder / "reference.json", "-o", folder / "reference", "--quiet"])
    block = BLOCKS[SENSORS.index(sensor["model"])]  # each model another
    match_again(folder / "measured", folder / "reference" / "ir.png", REFERENCE_MM, block)
    shutil.rmtree(folder / "reference")


def residuals(args, number):
    folder = args.output / f"member_{number:04}"
    file = folder / "residuals.csv"
    if not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "campaign.json").write_text(json.dumps(member(number)))
        run([args.fathom, "campaign", folder / "campaign.json", "-o", folder / "measured", "--seed", number, "--quiet",
             *(["--infrared"] if kind(number) == "opencv" else [])])
        if kind(number) == "opencv":
            matched_by_opencv(args, number, folder)
        run([args.fathom, "diagnose", folder / "measured", "-o", folder / "diagnosis", "--quiet"])
        (folder / "diagnosis" / "residuals.csv").replace(file)
        for name in ("measured", "diagnosis"):
            shutil.rmtree(folder / name)
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def errors_of_means(rows):
    """Errors in patches of the image, beside that of a mean of OF_WALLS_PX pixels, as errors_of_means() in diagnosis/statistics has it:
    walls that are seen as short arcs have more."""
    pixels = np.array([float(row["pixels"]) for row in rows])
    typical = np.median(pixels)
    return np.sqrt(OF_WALLS_PX / typical) * np.clip(np.sqrt(typical / pixels), 1 / 3, 3)


def shapes(rows, levels):
    """Z Zᵀ of each level: where two rows share an error, the product of how much they have of it."""
    of_walls = rows[0]["observable"].startswith("cup_")
    result = []
    for level in levels:
        keys = [tuple(row[column] for column in SHARED_BY[level]) for row in rows]
        sizes = errors_of_means(rows) if of_walls and level != "all" else np.ones(len(rows))
        result.append(np.outer(sizes, sizes) * np.array([[float(a == b) for b in keys] for a in keys]))
    return result


def variances(members, levels):
    """Of all members (residuals, shapes) together, by Fisher scoring; means are 0."""
    scale = np.mean(np.concatenate([y for y, _ in members]) ** 2) + 1e-300
    v = np.full(len(levels), scale / len(levels))
    for _ in range(60):
        score, information = np.zeros(len(levels)), np.zeros((len(levels), len(levels)))
        for y, Z in members:
            W = np.linalg.inv(sum(v_k * Z_k for v_k, Z_k in zip(v, Z)) + 1e-6 * scale * np.eye(len(y)))
            weighted = [W @ Z_k for Z_k in Z]
            for k, Z_k in enumerate(Z):
                score[k] += 0.5 * (y @ W @ Z_k @ W @ y - np.trace(weighted[k]))
                for l in range(len(Z)):
                    information[k, l] += 0.5 * np.sum(weighted[k] * weighted[l].T)
        free = np.flatnonzero((v > 0) | (score > 0))
        step = np.zeros_like(v)
        step[free] = np.linalg.lstsq(information[np.ix_(free, free)], score[free], rcond=None)[0]
        new = np.maximum(v + step, 0)
        if np.linalg.norm(new - v) < 1e-5 * np.linalg.norm(new):
            return new
        v = new
    return v


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fathom", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--members", type=int, default=36)
    parser.add_argument("--first", type=int, default=1, help="number of the first member")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    args = parser.parse_args()
    by_kind = {each: [] for each in KINDS}
    for number in range(args.first, args.first + args.members):
        by_kind[kind(number)].append(residuals(args, number))
        print(f"member {number}, the last is {args.first + args.members - 1}", file=sys.stderr)
    for observable, levels in LEVELS.items():
        for each_kind, members in by_kind.items():
            parts = [[row for row in rows if row["observable"] == observable] for rows in members]
            data = [(np.array([float(row["before"]) for row in rows]), shapes(rows, levels)) for rows in parts if rows]
            if not data:
                continue
            sizes = " ".join(f"{level} {v ** 0.5:.4f}" for level, v in zip(levels, variances(data, levels)))
            each = sorted(np.sqrt(np.mean(y**2)) for y, _ in data)
            print(f"{observable:17s} {each_kind:11s} {sizes}; rms of members {each[0]:.4f} to {each[-1]:.4f}", flush=True)


if __name__ == "__main__":
    main()
