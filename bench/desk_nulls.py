#!/usr/bin/env python3
"""Real desks as measurements with nothing hidden: each is diagnosed with a unit that the other clouds taught.

  bench/desk_nulls.py build/release/app/fathom mOSD/*.pcd mOSD_more/*.pcd -o out/desk_nulls

The pose in rig.json is that of the desk's own cloud, which stands for a laboratory that measured it. Prints the verdict
of each desk and how many are none. Every unit is learned anew, in four minutes for 21 clouds.
"""
import argparse, json, pathlib, shutil

from device_campaigns import run

FRAMES = """frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud
0,0,0,0,0,0,none,0,0,0,cloud.pcd
"""


def learned(fathom, clouds, folder):
    run([fathom, "calibrate", *clouds, "-o", folder, "--quiet"])
    return json.loads((folder / "unit.json").read_text())


def diagnosed(args, cloud):
    folder = args.output / cloud.stem
    measured = folder / "measured"
    pose = learned(args.fathom, [cloud], folder / "pose")["bias"]["poses"][0]
    learned(args.fathom, [c for c in args.clouds if c != cloud], measured)
    shutil.copy(cloud, measured / "cloud.pcd")
    sensor = {"model": args.sensor, "unit": "unit.json"} | {key: pose[key] for key in ("height_mm", "pitch_deg", "roll_deg")}
    (measured / "rig.json").write_text(json.dumps({"sensor": sensor, "cup": {"shape": "paper_cup"}, "liquids": {}}))
    (measured / "frames.csv").write_text(FRAMES)
    run([args.fathom, "diagnose", measured, "-o", folder / "diagnosis", "--quiet"])
    return json.loads((folder / "diagnosis" / "report.json").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fathom", type=pathlib.Path)
    parser.add_argument("clouds", type=pathlib.Path, nargs="+")
    parser.add_argument("--sensor", default="kinect_v1")
    parser.add_argument("-o", "--output", type=pathlib.Path, default="out/desk_nulls")
    args = parser.parse_args()
    silent = 0
    for cloud in args.clouds:
        report = diagnosed(args, cloud)
        silent += report["verdict"] == "none"
        print(f"{cloud.stem}  {report['verdict']}  p of none = {report['probability_of_none']:.2g}", flush=True)
    print(f"none: {silent}/{len(args.clouds)}")


if __name__ == "__main__":
    main()
