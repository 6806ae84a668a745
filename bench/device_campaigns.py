#!/usr/bin/env python3
"""Campaigns of simulated devices, each a unit of its own, diagnosed: with nothing hidden, or with one effect.

  bench/device_campaigns.py build/release/app/fathom --nulls 60 --singles 30 -o out/device_campaigns
  bench/device_campaigns.py build/release/app/fathom --nulls 12 --mode photometric -o out/device_photometric

Prints one row a campaign and counts with Clopper–Pearson intervals. Campaigns whose report is in the
folder already are not run again; a folder of other options is refused. Needs Debian's python3-scipy.
"""
import argparse, json, pathlib, shutil, subprocess, sys

SENSORS = ("xtion_pro_live_device", "kinect_v1_device")
PAINT = {"index": 1.336, "absorption_per_mm": 0.003, "scattering_per_mm": 1000}
DESIGNS = {
    "places": dict(fillings=[("empty", 0), ("water", 20), ("water", 40), ("paint", 30)], distance_mm=[200, 300],
                   lateral_mm=[-80, 80], pours=3, trials=2),
    "distances": dict(fillings=[("empty", 0), ("water", 10), ("water", 20), ("water", 30), ("paint", 10), ("paint", 20),
                                ("paint", 30)], distance_mm=[200, 300, 400, 500], lateral_mm=[0], pours=2, trials=2),
    "sessions": dict(fillings=[("empty", 0), ("water", 30), ("paint", 20)], distance_mm=[250], lateral_mm=[-60, 60],
                     pours=2, trials=3, sessions=3)}
# Each is several times as large as such a campaign's uncertainty; the diagnosis must give the name that stands here.
EFFECTS = ({"name": "fill_scale", "scale": 0.15}, {"name": "fill_offset", "fill_mm": 4},
           {"name": "refractive_index", "liquid": "water", "index_change": 0.06}, {"name": "cup_bottom_height", "height_mm": 3},
           {"name": "sensor_height", "height_mm": 8})


def spec(design, sensor, serial, mode, bare_desk_views, effects):
    d = dict(DESIGNS[design])
    fillings = [{"liquid": l} if l == "empty" else {"liquid": l, "fill_mm": f} for l, f in d.pop("fillings")]
    return {"sensor": {"model": sensor, "height_mm": 650, "aim_mm": [0, 300, 0], "unit": {"serial": serial}},
            "cup": {"shape": "paper_cup"}, "liquids": {"water": "water", "paint": PAINT}, "fillings": fillings,
            "bare_desk_views": bare_desk_views, "mode": mode, "effects": effects, **d}


def run(command):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"error: {' '.join(map(str, command))}: {result.stderr.strip()}")


def diagnosed(args, name, campaign, seed):
    folder = args.output / name
    report = folder / "diagnosis" / "report.json"
    if not report.exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "campaign.json").write_text(json.dumps(campaign))
        run([args.fathom, "campaign", folder / "campaign.json", "-o", folder / "measured", "--seed", seed, "--quiet"])
        run([args.fathom, "diagnose", folder / "measured", "-o", folder / "diagnosis", "--quiet"])
        shutil.rmtree(folder / "measured")
    return json.loads(report.read_text())


def require_same_options(args):
    """Answers of other campaigns would be counted as these."""
    asked = {"mode": args.mode, "bare_desk_views": args.bare_desk_views}
    file = args.output / "options.json"
    if file.exists() and json.loads(file.read_text()) != asked:
        sys.exit(f"error: {file}: is of other campaigns, {json.loads(file.read_text())}; choose another -o")
    args.output.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(asked))


def interval(k, n):
    """Clopper and Pearson's at 95 %."""
    from scipy.stats import beta
    return (0.0 if k == 0 else beta.ppf(0.025, k, n - k + 1)), (1.0 if k == n else beta.ppf(0.975, k + 1, n - k))


def share(what, k, n):
    if n:
        low, high = interval(k, n)
        print(f"{what}: {k}/{n} ({100 * low:.1f} to {100 * high:.1f} %)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fathom", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--nulls", type=int, default=12)
    parser.add_argument("--singles", type=int, default=0)
    parser.add_argument("--mode", choices=("geometric", "photometric"), default="geometric")
    parser.add_argument("--bare-desk-views", type=int, default=3)
    parser.add_argument("--first", type=int, default=1, help="seed and serial of the first campaign")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    args = parser.parse_args()
    require_same_options(args)
    silent = named = first = found = held = 0
    for i in range(args.nulls + args.singles):
        number, is_null = args.first + i, i < args.nulls
        design, sensor = list(DESIGNS)[i % 3], SENSORS[i // 3 % 2]
        effect = [] if is_null else [EFFECTS[(i - args.nulls) % len(EFFECTS)]]
        report = diagnosed(args, f"{'null' if is_null else 'single'}_{number:04}",
                           spec(design, sensor, number, args.mode, args.bare_desk_views, effect), number)
        effects = [e["name"] for e in report["effects"]]
        truth = effect[0]["name"] if effect else "nothing"
        likeliest = report["ambiguity_set"][0] if report["ambiguity_set"] else {"effects": []}
        sets = [likeliest["effects"], *likeliest.get("indistinguishable", [])]
        print(f"{number} {design} {sensor} {truth}: {report['verdict']} {effects} "
              f"p of none {report['probability_of_none']:.2g}; first {sets}", flush=True)
        silent += is_null and report["verdict"] == "none"
        named += is_null and bool(effects)
        if not is_null:
            first += [truth] in sets
            key, value = next((k, v) for k, v in effect[0].items() if k not in ("name", "liquid"))
            found += truth in effects
            for e in report["effects"]:
                ci = e.get("parameters", {}).get(key, {}).get("ci95") if e["name"] == truth else None
                held += bool(ci) and ci[0] <= value <= ci[1]
    share("nothing hidden: none", silent, args.nulls)
    share("nothing hidden: names something", named, args.nulls)
    share("one effect: first, or cannot be told from what is", first, args.singles)
    share("one effect: named", found, args.singles)
    share("its interval holds, where it is named", held, found)


if __name__ == "__main__":
    main()
