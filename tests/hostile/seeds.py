"""Small valid inputs, of which mutants are made: written here, or by the program from these."""
import json
import math
import shutil
import struct
import subprocess
from pathlib import Path

import mutate_cloud
import mutate_gltf
import mutate_image

SCENES = Path(__file__).resolve().parents[2] / "scenes"
# A few hundred pixels: a geometric shot takes milliseconds.
TINY = {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0], "ir_size_px": [128, 96], "depth_size_px": [64, 48],
        "focal_px": 57}
CUP = {"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43, "albedo": 0.8}

PATTERN = {"tile_columns": 32, "tile_rows": 32, "tiles_across": 2, "tiles_down": 2, "image": "pattern.png"}


def scenes():
    """Scenes that between them use most keys."""
    cup = {"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 30}
    mine = {"index": 1.34, "absorption_per_mm": 0.003, "scattering_per_mm": 2.0, "anisotropy": 0.9, "source": "here"}
    return [
        {"sensor": TINY, "desk": {"albedo": 0.55, "size_mm": [1400, 1000]}, "cups": [cup]},
        {"sensor": {**TINY, "noise": "device"},
         "cups": [{**cup, "shape": CUP, "liquid": mine, "surface": {"contact_angle_deg": 30, "capillary_length_mm": 2.7}}]},
        {"sensor": {**TINY, "noise": {"read_dn": 2, "disparity": {"facing_px": 0.06, "lateral_px": 1.5, "renewed": 0.5}},
                    "unit": {"disparity_offset_px": 0.1, "serial": 3}},
         "cups": [{**cup, "shape": {"inner_profile_mm": [[0, 5], [30, 6], [40, 80]],
                                    "outer_profile_mm": [[0, 0], [34, 0], [43, 80]]}, "fill_mm": 20,
                   "surface": {"tilt_deg": 2, "tilt_azimuth_deg": 30, "ripples": [{"wavelength_mm": 15, "amplitude_mm": 0.2,
                                                                                   "azimuth_deg": 10, "phase_deg": 0}]}}]},
        {"sensor": {**TINY, "optics": {"f_number": 2.8, "focus_mm": 900, "camera_k1": -0.02},
                    "matcher": {"method": "device", "hole_max_px": 4}},
         "desk": {"albedo": 0.5, "size_mm": [1400, 1000], "glaze": {"roughness": 0.2}},
         "cups": [{**cup, "shape": {**CUP, "albedo": 0.7}, "glaze": {"roughness": 0.1, "index": 1.5}, "position_mm": [20, 280]}],
         "objects": [{"solid": "can", "position_mm": [120, 300, 0]}, {"solid": {"box_mm": [60, 40, 80], "albedo": 0.4},
                                                                      "position_mm": [-120, 350, 0], "rotation_deg": [0, 0, 30]},
                     {"solid": {"cup": "mug"}, "position_mm": [0, 450, 0], "rotation_deg": [180, 0, 0]}]},
        {"sensor": TINY, "cups": [{**cup, "liquid": {"name": "intralipid_20", "dilution": 0.05}}],
         "effects": [{"name": "surface_tilt", "slope_y_deg": 0.5}, {"name": "fill_offset", "fill_mm": 0.6, "liquid": "water"},
                     {"name": "sensor_roll", "roll_deg": 0.4}]},
    ]


def campaign():
    return {"sensor": {**TINY, "noise": "device"}, "desk": {"albedo": 0.55}, "cup": {"shape": "paper_cup"},
            "liquids": {"water": "water", "paint": {"index": 1.336, "absorption_per_mm": 0.003, "scattering_per_mm": 1000}},
            "fillings": [{"liquid": "empty"}, {"liquid": "water", "fill_mm": 20}, {"liquid": "paint", "fill_mm": 30}],
            "distance_mm": [300], "lateral_mm": [0],
            "bare_desk_views": 1, "sessions": 1, "pours": 1, "placements": 1, "trials": 1, "frame_s": 1, "placement_s": 2,
            "pour_s": 5, "fill_sigma_mm": 0.5, "placement_sigma_mm": 0.5,
            "rig_sigma": {"height_mm": 0.5, "bottom_mm": 0.1}, "mode": "geometric",
            "effects": [{"name": "fill_scale", "scale": 0.15}]}


def table():
    """(rig.json, frames.csv) of heights without clouds."""
    rig = {"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4, "roll_deg": 0, "baseline_mm": 75,
                      "focal_px": 570.342, "disparity_offset_px": 0, "sigma": {"height_mm": 0.5, "pitch_deg": 0.05}},
           "cup": {"shape": "paper_cup", "height_mm": 87, "inner_radius_mm": 40, "outer_radius_mm": 43, "bottom_mm": 7,
                   "sigma": {"bottom_mm": 0.1}},
           "liquids": {"water": "water", "milk": {"index": 1.344, "absorption_per_mm": 0.003, "scattering_per_mm": 1000,
                                                  "anisotropy": 0}}, "fill_sigma_mm": 0.5, "placement_sigma_mm": 0.5}
    rows = ["frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud,height_mm,height_sd_mm,points"]
    placement = 0
    for pour, (liquid, fill, height) in enumerate([("empty", 0, 7.1), ("water", 20, 13.2), ("water", 30, 16.1),
                                                   ("milk", 30, 36.8)]):
        for distance in (250, 350):
            for trial in range(2):
                rows.append(f"{len(rows) - 1},0,{pour},{placement},{trial},{10 * len(rows)},{liquid},{fill},{distance},0,,{height + 0.1 * trial + 0.001 * distance:.3f},0.8,400")
            placement += 1
    return json.dumps(rig), "\n".join(rows) + "\n"


def model():
    return {"effects": [{"name": "fill_scale", "scale": 0.15}, {"name": "sensor_roll", "roll_deg": 0.3}],
            "covariance": {"parameters": ["/effects/0/scale", "/effects/1/roll_deg"], "matrix": [[0.0001, 0], [0, 0.01]]},
            "provenance": {"fathom": "0.1.0", "measurement": "story", "seed": 1,
                           "named": [{"effect": "fill_scale", "p_discovery": 1e-9, "p_confirmation": 1e-5}],
                           "gap": {"train": {"before_rms_mm": 2.3}}}}


def points():
    """A desk with an open cup on it as a camera sees them, (x, y, z, intensity), thinned."""
    result = []
    tilt, height = math.radians(58.4), 0.65

    def seen(x, y, z):  # world to camera: x right, y away, z up
        up = height - z
        result.append((x, up * math.cos(tilt) - y * math.sin(tilt), up * math.sin(tilt) + y * math.cos(tilt), 200.0))
    for i in range(-28, 29):
        for j in range(0, 40):
            x, y = 0.01 * i, 0.1 + 0.012 * j
            if math.hypot(x, y - 0.3) > 0.043:
                seen(x, y, 0.0)
    for k in range(0, 88, 4):
        for a in range(0, 360, 5):
            if math.sin(math.radians(a)) < 0.2:
                seen(0.043 * math.cos(math.radians(a)), 0.3 + 0.043 * math.sin(math.radians(a)), 1e-3 * k)
    for i in range(-12, 13):
        for j in range(-12, 13):
            if math.hypot(i, j) < 12.5:
                seen(0.003 * i, 0.3 + 0.003 * j, 0.02)
    return result


class Seeds:
    """What the program makes of them, once."""

    def __init__(self, program, folder, env):
        self.scenes, self.campaign, self.model = [json.dumps(s) for s in scenes()], json.dumps(campaign()), json.dumps(model())
        self.rig, self.frames = table()
        self.points = points()
        self.clutter = json.dumps({**json.loads((SCENES / "clutter" / "desk.json").read_text()),
                                   "sensor": {**TINY, "aim_mm": [0, 350, 0], "noise": "basic"}})
        self.dataset = json.dumps({**json.loads((SCENES / "datasets" / "cups.json").read_text()), "cups": {"number": [1, 2], "kinds": [
            {"shape": "mug"}, {"shape": {"height_mm": [70, 125], "bottom_mm": [3, 8], "inner_radius_mm": [28, 46], "wall_mm": 2}, "variants": 2}]}})
        self.poses = json.dumps({"world_from_camera": [[[1, 0, 0, 0], [0, -0.6, 0.8, 0], [0, -0.8, -0.6, 0.65]]] * 2})
        self.config = json.dumps({"templates": ["cup.json"]})
        self.template = (SCENES / "templates" / "paper_cup.json").read_text().replace("paper_cup.pcd", "cup.pcd")
        self.template_cloud = (SCENES / "templates" / "paper_cup.pcd").read_bytes()
        self.labels = "scene,labels,object,support,horiz_dist_m,circle_r_mm,inner_median_mm\ncloud,1,mug_upright,table,0.3,43,20\ncloud,2,can,table,0.5,30,\n"
        self.recording, self.clouds = folder / "recording", folder / "campaign"
        folder.mkdir(parents=True)
        (folder / "scene.json").write_text(json.dumps({"sensor": TINY, "cups": [{"shape": "paper_cup", "position_mm": [0, 300]}]}))
        # Clouds in which a cup has enough pixels.
        seen = {**TINY, "noise": "device", "ir_size_px": [640, 480], "depth_size_px": [320, 240], "focal_px": 285}
        (folder / "spec.json").write_text(json.dumps({**campaign(), "sensor": seen, "effects": []}))
        for arguments in (["capture", "scene.json", "-o", "recording", "--mode", "geometric"], ["campaign", "spec.json", "-o",
                                                                                                "campaign"]):
            subprocess.run([program, *arguments, "--quiet"], cwd=folder, env=env, check=True, stdout=subprocess.DEVNULL)
        (folder / "frames.json").write_text(self.dataset)
        subprocess.run([program, "generate", "frames.json", "--frames", "1", "-o", "drawn", "--quiet"], cwd=folder, env=env, check=True,
                       stdout=subprocess.DEVNULL)
        self.drawn = folder / "drawn"
        self.results = folder / "results"
        for arguments in (["detect", "campaign/clouds/000001.pcd", "-o", "results/found"], ["diagnose", "campaign", "-o", "results/diagnosis"]):
            subprocess.run([program, *arguments, "--quiet"], cwd=folder, env=env, check=True, stdout=subprocess.DEVNULL)
        self.disparity = (self.recording / "disparity.exr").read_bytes()
        self.record = (self.recording / "run.json").read_text()
        self.require_good(program, folder, env)

    def require_good(self, program, folder, env):
        """Mutants of what is refused anyway would show nothing."""
        good = folder / "good"
        (good / "heights").mkdir(parents=True)
        for i, scene in enumerate(self.scenes):
            (good / f"scene{i}.json").write_text(scene)
        tree = json.loads(self.scenes[0])
        tree["sensor"]["pattern"] = PATTERN
        (good / "pattern.json").write_text(json.dumps({**tree, "objects": [{"gltf": "box.gltf", "position_mm": [120, 300, 0]}]}))
        text, data = mutate_gltf.box()
        (good / "box.gltf").write_text(json.dumps(text))
        (good / "box.bin").write_bytes(data)
        (good / "pattern.png").write_bytes(mutate_image.grey_png(64, 64))
        few = "\n".join(self.frames.splitlines()[:10]) + "\n"  # a diagnosis of all of them takes seconds
        for name, value in {"model.json": self.model, "clutter.json": self.clutter, "frames.json": self.dataset, "poses.json": self.poses,
                            "config.json": self.config, "cup.json": self.template,
                            "cups_groundtruth.csv": self.labels, "heights/rig.json": self.rig,
                            "heights/frames.csv": few}.items():
            (good / name).write_text(value)
        (good / "cup.pcd").write_bytes(self.template_cloud)
        for kind in ("ascii", "binary", "binary_compressed"):
            (good / f"{kind}.pcd").write_bytes(mutate_cloud.write_pcd(self.points, len(self.points), 1, kind))
        shutil.copy(good / "binary.pcd", good / "cloud.pcd")  # which the labels name
        commands = [["capture", f"scene{i}.json", "--mode", "geometric"] for i in range(len(self.scenes))] + [
            ["capture", "pattern.json", "--mode", "geometric"], ["capture", "scene0.json", "--mode", "geometric", "--model",
                                                                 "model.json"], ["measure", "heights"],
            ["measure", str(self.clouds)], ["diagnose", "heights", "--model", "model.json"], ["detect", "ascii.pcd", "--config",
                                                                                              "config.json"],
            ["detect", "binary.pcd", "binary_compressed.pcd", "--poses", "poses.json"], ["template", "binary.pcd", "--name", "x"],
            ["evaluate", "recognition", "--trials", "1", "--clutter", "clutter.json"], ["generate", "frames.json", "--frames", "1"],
            ["evaluate", "."], ["evaluate", str(self.drawn)], ["view", str(self.results / "found")], ["view", str(self.results / "diagnosis")],
        ["detect", "--live", str(self.recording)]]
        for i, command in enumerate(commands):
            subprocess.run([program, *command, "-o", str(folder / f"out{i}"), "--quiet"], cwd=good, env=env, check=True,
                           stdout=subprocess.DEVNULL)

    def copy_recording(self, folder):
        shutil.copytree(self.recording, folder)

    def copy_clouds(self, folder):
        shutil.copytree(self.clouds, folder)

    def cloud_bytes(self):
        return b"".join(struct.pack("<4f", *p) for p in self.points)
