"""Error against processor time: tables, and pictures by gnuplot."""
import csv
import subprocess
from pathlib import Path

from runs import UNIT_RAYS, aligned

SCENES = ["paper_water", "meniscus_water", "paper_milk_tea", "glass_water"]
RENDERERS = {"fathom": ("Fathom", "spp"), "povray": ("POV-Ray photon map", "photons"),
             "cycles": ("Cycles shadow caustics", "spp")}


def draw(folder, name, columns, rows):
    """NAME.csv, of whose curves bench/NAME.gp makes NAME.png."""
    with open(folder / f"{name}.csv", "w", newline="") as file:
        csv.writer(file).writerows([columns, *rows])
    subprocess.run(["gnuplot", "-d", Path(__file__).resolve().with_name(f"{name}.gp")], cwd=folder, check=True)
    print(f"picture: {folder / name}.png")


def report_convergence(runs, folder):
    names = [name for scene in SCENES for name in runs.cases(f"convergence/{scene}")]
    if not names:
        return
    rows = [(name.split("/")[1], int(runs.value(name, "samples")), 1e-3 * runs.value(name, "cpu_time"),
             runs.value(name, "rmse_dn"), runs.value(name, "reference_dn")) for name in names]
    print("\nAll light, a strip of 16 × 192 infrared pixels through the cup: error of those on it against a converged image")
    print(aligned([("scene", "spp", "cpu s", "RMSE [DN]", "of the reference [DN]")] +
                  [(scene, f"{spp}", f"{cpu_s:.3f}", f"{rmse:.2f}", f"{reference:.2f}")
                   for scene, spp, cpu_s, rmse, reference in rows]))
    draw(folder, "convergence", ("scene", "spp", "cpu_s", "rmse_dn", "reference_dn"), rows)


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
    draw(folder, "others", ("renderer", "effort", "cpu_s", "units", "place_ir_px", "brightness", "rmse"), rows)
