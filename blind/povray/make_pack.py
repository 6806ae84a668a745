#!/usr/bin/python3
"""usage: blind/povray/make_pack.py --out PACK [--seed N] [--sets N] [--classes null:10,single:12,pair:3,unknown:5] [--only NAME]
Writes measurement directories of the world of POV-Ray and OpenCV (world.py), PACK/set_0000 and so on, and what is hidden in
each to PACK.truth.jsonl. A set has 64 clouds (240 MB) and takes half a minute of one core. Same seed, same sets. Needs Debian's
povray, python3-numpy, python3-scipy, python3-opencv."""
import argparse
import json
from pathlib import Path

import numpy as np
import world

# What the laboratory believes, and how well it knows it (1 σ): half a millimetre by ruler, a twentieth of a degree by level.
RIG = {"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4, "roll_deg": 0, "baseline_mm": 75, "focal_px": 570.342,
                  "disparity_offset_px": 0,
                  "sigma": {"height_mm": 0.5, "pitch_deg": 0.05, "roll_deg": 0.05, "baseline_mm": 0.05, "focal_px": 0.4,
                            "disparity_offset_px": 0.02}},
       "cup": {"shape": "paper_cup", "height_mm": 87, "inner_radius_mm": 40, "outer_radius_mm": 43, "bottom_mm": 7, "sigma": {"bottom_mm": 0.1}},
       "liquids": {"water": {"index": 1.3281, "absorption_per_mm": 0.0031, "scattering_per_mm": 0, "anisotropy": 0.9},
                   "paint": {"index": 1.336, "absorption_per_mm": 0.0032, "scattering_per_mm": 1000, "anisotropy": 0}},
       "fill_sigma_mm": 0.5, "placement_sigma_mm": 0.5}
# Sessions differ by a third of what a diagnosis allows them where a laboratory says nothing.
SESSION_PITCH_DEG, SESSION_OFFSET_PX = 0.004, 0.005
# A device's disparities wander slowly over the image, from shot to shot and with each change of the scene.
WANDER_PX, WANDER_SHOT, WANDER_PLACEMENT = 30, 0.02, 0.025
FILLS_MM, DISTANCES_MM, LATERALS_MM = (10, 25, 40), (250, 400), (-50, 0, 50)

# name: parameter: (least, most, signs). Sizes are several times what the laboratory knows of the quantity, so that all can be seen.
EFFECTS = {
    "refractive_index": {"delta_index": (0.02, 0.05, "+-")}, "sensor_height": {"delta_mm": (4, 12, "+-")},
    "sensor_pitch": {"delta_deg": (0.4, 1.2, "+-")}, "sensor_roll": {"delta_deg": (0.4, 1.2, "+-")},
    "baseline": {"delta_mm": (0.4, 1.2, "+-")}, "focal_length": {"delta_px": (5, 15, "+-")},
    "disparity_offset": {"delta_px": (0.2, 0.5, "+-")}, "radial_distortion": {"k1": (0.006, 0.03, "+-")},
    "thermal_drift": {"delta_px": (0.15, 0.4, "+-"), "tau_s": (600, 1500, "+")}, "cup_bottom_height": {"delta_mm": (1, 2.5, "+-")},
    "concave_bottom": {"sag_mm": (1.2, 3, "+")}, "surface_tilt": {"tilt_deg": (1, 2.5, "+"), "azimuth_deg": (0, 360, "+")},
    "meniscus": {"rise_mm": (1.5, 3.5, "+")},
    "fill_offset": {"delta_mm": (1.2, 3, "+-")}, "fill_scale": {"relative": (0.06, 0.15, "+-")}, "evaporation": {"mm_per_hour": (3, 6, "+")},
}
UNKNOWN = {
    # A pebble on the bottom; smear on the lens, where disparities are off; a coaster under the cup, in the second session alone.
    "pebble": {"x_mm": (-15, 15, "+"), "y_mm": (-5, 15, "+"), "radius_mm": (5, 8, "+")},
    "dirty_lens": {"u_px": (260, 380, "+"), "v_px": (80, 300, "+"), "sigma_px": (20, 40, "+"), "delta_px": (0.25, 0.5, "+-")},
    "coaster": {"delta_mm": (2, 4, "+")},
}
CLASSES = {"null": 10, "single": 12, "pair": 3, "unknown": 5}


def drawn_parameters(table, rng):
    """One value for each parameter, evenly within its range."""
    return {key: round(float(rng.uniform(least, most)) * (int(rng.choice([-1, 1])) if signs == "+-" else 1), 5)
            for key, (least, most, signs) in table.items()}


def rows_of(rng):
    """The shots in the order of time: each session pours each filling once and puts it at two places, twice the empty cup and the desk."""
    places = [(y, x) for y in DISTANCES_MM for x in LATERALS_MM]
    at = {key: [places[i] for i in rng.permutation(len(places))[:2]] for key in [(l, f) for l in RIG["liquids"] for f in FILLS_MM]}
    rows, pour, placement = [], 0, 0
    for session in range(2):
        jobs = []
        for (liquid, fill), spots in at.items():
            pour += 1
            jobs += [(turn, pour, liquid, fill, spot) for turn, spot in enumerate(spots)]
        jobs += [(turn, 0, "empty", 0, (DISTANCES_MM[0], LATERALS_MM[(turn + session) % 3])) for turn in range(2)]
        jobs += [(turn, 0, "none", 0, (0, 0)) for turn in range(2)]
        jobs.sort(key=lambda job: (job[0], rng.random()))
        time, poured = 60.0, {}
        for _, number, liquid, fill, (y, x) in jobs:
            placement += liquid != "none"
            for trial in range(2):
                rows.append({"session": session, "pour": number, "placement": placement if liquid != "none" else 0, "trial": trial,
                             "time_s": round(time, 1), "age_s": time - poured.setdefault(number, time), "liquid": liquid,
                             "fill_mm": fill, "distance_mm": y, "lateral_mm": x})
                time += 4
            time += rng.uniform(40, 70)
    return rows


def scene_of(row, effects, nuisances, unit):
    """The world in front of the sensor in a shot."""
    def of(name, key):
        return effects[name][key] if name in effects else 0
    rig, session = nuisances["rig"], nuisances["session"][row["session"]]
    warm = of("thermal_drift", "delta_px") * (1 - np.exp(-row["time_s"] / (of("thermal_drift", "tau_s") or 1)))
    sensor = world.Sensor(
        height_mm=650 + rig["height_mm"] + of("sensor_height", "delta_mm"),
        pitch_deg=58.4 + rig["pitch_deg"] + session[0] + of("sensor_pitch", "delta_deg"),
        roll_deg=rig["roll_deg"] + of("sensor_roll", "delta_deg"), baseline_mm=75 + rig["baseline_mm"] + of("baseline", "delta_mm"),
        focal_px=world.FOCAL_PX + rig["focal_px"] + of("focal_length", "delta_px"),
        disparity_offset_px=rig["disparity_offset_px"] + session[1] + of("disparity_offset", "delta_px") + warm, k1=of("radial_distortion", "k1"))
    if row["liquid"] == "none":
        return world.Scene(unit, sensor, None, world.Liquid())
    dx, dy = nuisances["placement"][row["placement"]]
    lift = of("coaster", "delta_mm") * row["session"]
    cup = world.Cup(row["lateral_mm"] + dx, row["distance_mm"] + dy, rim_mm=87 + lift,
                    bottom_mm=7 + lift + rig["bottom_mm"] + of("cup_bottom_height", "delta_mm"), sag_mm=of("concave_bottom", "sag_mm"))
    if "pebble" in effects:
        radius = of("pebble", "radius_mm")
        cup.bumps = ((of("pebble", "x_mm"), of("pebble", "y_mm"), cup.bottom_mm, radius),)
    if row["liquid"] == "empty":
        return world.Scene(unit, sensor, cup, world.Liquid())
    fill = (row["fill_mm"] * (1 + of("fill_scale", "relative")) + of("fill_offset", "delta_mm") + nuisances["pour"][row["pour"]]
            - of("evaporation", "mm_per_hour") * row["age_s"] / 3600)
    clear = row["liquid"] == "water"
    liquid = world.Liquid(cup.bottom_mm + max(fill, 0.5), (1.3281 + of("refractive_index", "delta_index")) if clear else 0,
                          of("surface_tilt", "tilt_deg"), of("surface_tilt", "azimuth_deg"), 0.0031,
                          of("meniscus", "rise_mm"))
    return world.Scene(unit, sensor, cup, liquid)


def write_set(folder, kind, seed, number, only=None):
    """One measurement directory; returns its line of truth. `only`: the one thing of its class that may be hidden."""
    rng = np.random.default_rng([seed, number])
    rows = rows_of(rng)
    table = UNKNOWN if kind == "unknown" else EFFECTS
    table = {name: ranges for name, ranges in table.items() if only in (None, name)}
    count = {"null": 0, "pair": 2}.get(kind, 1)
    effects = {name: drawn_parameters(table[name], rng) for name in rng.permutation(list(table))[:count].tolist()}
    sigma = RIG["sensor"]["sigma"] | RIG["cup"]["sigma"]
    nuisances = {"rig": {key: float(rng.normal(0, s)) for key, s in sigma.items()},
                 "session": {s: (float(rng.normal(0, SESSION_PITCH_DEG)), float(rng.normal(0, SESSION_OFFSET_PX))) for s in range(2)},
                 "pour": {p: float(rng.normal(0, RIG["fill_sigma_mm"])) for p in sorted({row["pour"] for row in rows})},
                 "placement": {p: rng.normal(0, RIG["placement_sigma_mm"], 2) for p in sorted({row["placement"] for row in rows})}}
    unit = world.Unit(np.random.default_rng([seed, number, 1]))
    (folder / "clouds").mkdir(parents=True)
    (folder / "rig.json").write_text(json.dumps(RIG, indent=1) + "\n")
    columns = ["session", "pour", "placement", "trial", "time_s", "liquid", "fill_mm", "distance_mm", "lateral_mm"]
    lines = ["frame," + ",".join(columns) + ",cloud"]
    drifting = {"thermal_drift", "evaporation"} & set(effects)
    scene = None
    for frame, row in enumerate(rows):
        if row["trial"] == 0 or drifting:
            scene = scene_of(row, effects, nuisances, unit)
        place_seed, shot = [seed, number, 2, frame - row["trial"]], np.random.default_rng([seed, number, 3, frame])
        infrared = scene.infrared(np.random.default_rng(place_seed), shot)
        disparity = world.disparities(infrared, unit.reference(scene.sensor)) + unit.bias_px
        disparity += WANDER_SHOT * world.smooth_field(shot, WANDER_PX)
        disparity += WANDER_PLACEMENT * world.smooth_field(np.random.default_rng(place_seed + [1]), WANDER_PX)
        if "dirty_lens" in effects:
            smear = effects["dirty_lens"]
            v, u = np.mgrid[0:world.ROWS, 0:world.COLUMNS]
            disparity += smear["delta_px"] * np.exp(-((u - smear["u_px"]) ** 2 + (v - smear["v_px"]) ** 2) / (2 * smear["sigma_px"] ** 2))
        world.write_cloud(folder / "clouds" / f"{frame:04d}.pcd", world.depth_mm(disparity))
        lines.append(",".join([str(frame)] + [str(row[key]) for key in columns] + [f"clouds/{frame:04d}.pcd"]))
    (folder / "frames.csv").write_text("\n".join(lines) + "\n")
    return {"set": folder.name, "class": kind, "effects": [{"name": name, "parameters": values} for name, values in effects.items()]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sets", type=int, default=30)
    parser.add_argument("--classes", default=",".join(f"{name}:{weight}" for name, weight in CLASSES.items()))
    parser.add_argument("--only", metavar="NAME", choices=[*EFFECTS, *UNKNOWN], help="hide nothing else")
    args = parser.parse_args()
    weights = {part.split(":")[0]: int((part.split(":") + ["1"])[1]) for part in args.classes.split(",")}
    if not set(weights) <= set(CLASSES):
        parser.error("classes are " + ", ".join(CLASSES))
    own_class = "unknown" if args.only in UNKNOWN else "single"
    if args.only and not set(weights) <= {"null", own_class}:
        parser.error(f"--only {args.only} goes with --classes null, {own_class}")
    kinds = [name for name, weight in weights.items() for _ in range(weight)]
    for number in range(args.sets):
        folder = args.out / f"set_{number:04d}"
        line = write_set(folder, kinds[number % len(kinds)], args.seed, number, args.only)
        with open(args.out.with_name(args.out.name + ".truth.jsonl"), "a") as truth:
            truth.write(json.dumps(line) + "\n")


if __name__ == "__main__":
    main()
