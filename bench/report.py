#!/usr/bin/env python3
"""usage: bench/report.py FOLDER GROUP...
Prints the measurements in FOLDER/GROUP.json: first a table of ours, what stands beside it, their ratio and the goal; then,
of the group others, error against time, with a picture in FOLDER. Times are medians over the repetitions, of the whole
process's processor time; "by wall" is the ratio of the times that passed. U is what Embree alone needs for ten million
camera rays. RMSE of dots is relative to their own root mean square, after a scale of the whole image has been taken
off."""
import csv
import json
import subprocess
import sys
from pathlib import Path
from statistics import median

UNIT_RAYS = 10e6  # camera rays in the unit of work U
MATCHERS = {"bm": ("StereoBM", 1.5), "sgbm": ("StereoSGBM", 0.5)}  # goals of the time ratio
LIGHT_SCENES = {  # goals in U
    "paper_water": 1.6, "barley_tea": 15.0, "meniscus_water": 3.0, "paper_milk_tea": 4.0, "orange_juice": 15.0,
    "tomato_juice": 15.0, "whole_milk": 3.0, "glass_water": 12.0}
DETECT_GOALS = {"robust": 0.125, "paper": 0.25}
MATCH_CASES = ["water_clean", "water_noisy", "plane_clean", "plane_noisy"]
RENDERERS = {"fathom": ("Fathom", "spp"), "povray": ("POV-Ray photon map", "photons"),
             "cycles": ("Cycles shadow caustics", "spp")}


class Runs:
    def __init__(self, folder, groups):
        self.repetitions = {}  # of each benchmark
        for file in (folder / f"{group}.json" for group in groups):
            for run in json.loads(file.read_text()).get("benchmarks", []) if file.exists() else []:
                if run["run_type"] == "iteration":
                    name = run["run_name"].split("/process_time")[0].split("/iterations:")[0]
                    self.repetitions.setdefault(name, []).append(run)

    def __contains__(self, name):
        return name in self.repetitions

    def value(self, name, key):
        return median(run[key] for run in self.repetitions[name])

    def times(self, name, scale=1):
        """Of the processor, then of the wall's clock [ms]."""
        return [scale * self.value(name, key) for key in ("cpu_time", "real_time")]

    def cases(self, prefix):
        """Names below a prefix such as "group/case", by rising number at their end."""
        return sorted((name for name in self.repetitions if name.startswith(prefix + "/")),
                      key=lambda name: int(name.rsplit("/", 1)[1]))


class Table:
    def __init__(self, runs):
        self.runs = runs
        self.rows = [("", "ours", "beside", "ratio", "by wall", "goal", "")]

    def add(self, what, ours="", beside="", ratio=None, wall=None, goal=None, below=False):
        met = "" if goal is None else "met" if (ratio < goal if below else ratio <= goal) else "MISSED"
        sign = "<" if below else "≤"
        self.rows.append((what, ours, beside, number(ratio), number(wall), goal and f"{sign} {goal:g}" or "", met))

    def add_time(self, what, name, beside, goal):
        cpu, wall = zip(self.runs.times(name), self.runs.times(beside))
        self.add(f"{what}: time", f"{cpu[0]:.1f} ms", f"{cpu[1]:.1f} ms", cpu[0] / cpu[1], wall[0] / wall[1], goal)

    def add_rays(self, what, name):
        rays = self.runs.value(name, "rays")
        cpu, wall = (rays / time * 1e-3 for time in self.runs.times(name))
        self.add(f"{what}: Mray per cpu s (per wall s)", f"{cpu:.2f} ({wall:.2f})")


def number(value):
    return "" if value is None else f"{value:.2f}"


def aligned(rows):
    """The first column to the left, the others to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return "\n".join(
        "  ".join([row[0].ljust(widths[0])] + [c.rjust(w) for c, w in zip(row[1:], widths[1:])]).rstrip() for row in rows)


def report_tracing(table):
    for group, what in (("geometric", "geometric frame / Embree, same rays"),
                        ("photometric", "infrared image, 4 spp / Embree, same rays")):
        if f"{group}/fathom" in table.runs:
            table.add_time(what, f"{group}/fathom", f"{group}/embree", 1.6)
            table.add_rays("  ours", f"{group}/fathom")
            table.add_rays("  Embree", f"{group}/embree")


def report_light(table):
    for scene, goal in LIGHT_SCENES.items():
        ours, beside = f"light/{scene}/fathom", f"light/{scene}/embree"
        if ours not in table.runs:
            continue
        scale = UNIT_RAYS / table.runs.value(beside, "rays")
        cpu, wall = zip(table.runs.times(ours), table.runs.times(beside, scale))
        table.add(f"{scene}: infrared image, all light / U", f"{cpu[0]:.0f} ms", f"{cpu[1]:.0f} ms", cpu[0] / cpu[1],
                  wall[0] / wall[1], goal)
        walks, sensor = table.runs.value(ours, "walks_dn"), table.runs.value(ours, "sensor_dn")
        table.add("  noise of walks / of the sensor [DN]", f"{walks:.1f}", f"{sensor:.1f}", walks / sensor, None, 0.25,
                  below=True)
        walks, sensor = table.runs.value(ours, "walks_px"), table.runs.value(ours, "sensor_px")
        table.add("  the same of matched disparities [px]", f"{walks:.4f}", f"{sensor:.4f}", walks / sensor, None, 0.25,
                  below=True)


def report_generate(table):
    unit = "generate/embree"
    if unit not in table.runs:
        return
    cpu, wall = table.runs.times(unit, UNIT_RAYS / table.runs.value(unit, "rays"))
    for mode, goal in (("geometric", 0.12), ("photometric", 1.6)):
        frames = table.runs.value(f"generate/{mode}", "frames")
        cpu_ms, wall_ms = table.runs.times(f"generate/{mode}", 1 / frames)
        table.add(f"labelled {mode} frame / U", f"{cpu_ms:.0f} ms", f"{cpu:.0f} ms", cpu_ms / cpu, wall_ms / wall, goal)
        table.add("  its files [MB]", f"{table.runs.value(f'generate/{mode}', 'bytes') * 1e-6:.2f}", "",
                  table.runs.value(f"generate/{mode}", "bytes") * 1e-6, None, 1.2)
    for what, name in (("labelled geometric frames", "generate/geometric"), ("Embree", "generate/embree")):
        gain = table.runs.value(f"{name}_one_thread", "real_time") / table.runs.value(name, "real_time")
        table.add(f"{what}: all threads, times as fast as one", f"{gain:.2f}")


def report_matching(table):
    for case in MATCH_CASES:
        ours = f"match/{case}/fathom"
        if ours not in table.runs:
            continue
        for side, (name, goal) in MATCHERS.items():
            other = f"match/{case}/{side}"
            what = f"{case.replace('_', ', ')}: match / {name}"
            table.add_time(what, ours, other, goal)
            for key, label, goal_of_key in (("median_px", "median |e| [px]", 1.0), ("rms_px", "rms, |e| < 1 px", 1.0),
                                            ("outliers", "share |e| ≥ 1 px", 1.0), ("valid", "valid of lit", None)):
                a, b = table.runs.value(ours, key), table.runs.value(other, key)
                table.add(f"  {label}", f"{a:.4f}", f"{b:.4f}", a / b if b else None, None,
                          goal_of_key if b else None, below=True)


def report_detection(table):
    for name in sorted(name for name in table.runs.repetitions if name.startswith("detect/") and not name.endswith("/pcl")):
        _, cloud, method = name.split("/")
        table.add_time(f"{cloud}: {method} / PCL pipeline", name, f"detect/{cloud}/pcl", DETECT_GOALS.get(method))


def report_memory(table, folder):
    memory = json.loads((folder / "memory.json").read_text())
    table.add("fathom capture: peak memory [MB]", f"{memory['peak_mb']:.0f}", "", memory["peak_mb"], None, 600)
    table.add("fathom capture: cpu (wall) s", f"{memory['cpu_s']:.1f} ({memory['wall_s']:.1f})")


def report_diagnosis(table, folder):
    cost = json.loads((folder / "diagnosis_cost.json").read_text())
    table.add("diagnose / measure, the paper's 35 conditions × 10", f"{cost['diagnose_s']:.1f} s",
              f"{cost['measure_s']:.1f} s", cost["diagnose_s"] / cost["measure_s"], None, 3.0)
    table.add("the same by ray tracing", f"{cost['traced_s']:.0f} s", f"{cost['measure_s']:.1f} s",
              cost["traced_s"] / cost["measure_s"], None, 40.0)
    table.add("the same, two threads [min of wall clock]", f"{cost['traced_wall_s'] / 60:.1f}", "",
              cost["traced_wall_s"] / 60, None, 10.0)


def report_others(runs, folder):
    if "others/embree" not in runs:
        return
    unit_s = 1e-3 * UNIT_RAYS / runs.value("others/embree", "rays") * runs.value("others/embree", "cpu_time")
    rows = []
    for key, (renderer, unit) in RENDERERS.items():
        for name in runs.cases(f"others/{key}"):
            cpu_s = 1e-3 * runs.value(name, "cpu_time") if key == "fathom" else runs.value(name, "cpu_s")
            errors = (runs.value(name, error) for error in ("place_ir_px", "brightness", "rmse"))
            rows.append((renderer, f"{runs.value(name, 'effort'):.0f} {unit}", cpu_s, cpu_s / unit_s, *errors))
    print("\nDots on the bottom under 30 mm of clear water, 640 × 512 pixels, direct light, against exact refraction")
    print(aligned([("renderer", "effort", "cpu s", f"U of {unit_s:.2f} s", "place, rms [px]", "bottom / desk over exact", "RMSE")] +
                  [(renderer, effort, f"{cpu_s:.2f}", f"{units:.2f}", f"{place:.4f}", f"{brightness:.4f}", f"{rmse:.2%}")
                   for renderer, effort, cpu_s, units, place, brightness, rmse in rows]))
    with open(folder / "others.csv", "w", newline="") as file:
        columns = ("renderer", "effort", "cpu_s", "units", "place_ir_px", "brightness", "rmse")
        csv.writer(file).writerows([columns, *rows])
    subprocess.run(["gnuplot", "-d", Path(__file__).resolve().with_name("others.gp")], cwd=folder, check=True)
    print(f"picture: {folder / 'others.png'}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    results, groups = Path(sys.argv[1]), sys.argv[2:]
    runs = Runs(results, groups)
    everything = Table(runs)
    report_tracing(everything)
    report_light(everything)
    report_matching(everything)
    report_generate(everything)
    report_detection(everything)
    if "memory" in groups:
        report_memory(everything, results)
    if "diagnosis" in groups:
        report_diagnosis(everything, results)
    if len(everything.rows) > 1:
        print(aligned(everything.rows))
    report_others(runs, results)
