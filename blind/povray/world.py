"""A depth camera of other people's parts: POV-Ray bends the light, OpenCV matches the dots. Nothing of Fathom is in it.

POV-Ray says which point of the scene each direction of the infrared camera and of the projector sees, through the liquid
(positions.pov). Each dot of the slide lies where the projector sees it; it is drawn where the camera sees that point, as
bright as a matt surface is there. cv2.StereoBM matches the picture with the reference image that the same unit took of a
wall at 1.2 m. The device's steps of 1/8 px and whole millimetres, its unit's smooth error and its wander are added after.

World: mm, z up, the desk is z = 0, x right, y away, the origin below the middle of the baseline. Images: rows by columns,
pixel centres are whole numbers, the principal point is (319.5, 239.5). Infrared pictures have twice the depth's pixels.
"""
import dataclasses
import functools
import subprocess
import tempfile
from pathlib import Path

import cv2
import numpy as np
import scipy.fft
from scipy.spatial import cKDTree

COLUMNS, ROWS = 640, 480
CENTRE = np.array([319.5, 239.5])
REFERENCE_MM = 1200.0
STEP_PX = 0.125
BASELINE_MM = 75.0
FOCAL_PX = 570.342  # of the device's law of depth: 36000 / (8 · 0.1052 · 75)
LEAST_MM, MOST_MM = np.array([-900.0, -400.0, -40.0]), np.array([900.0, 2600.0, 200.0])
# Dots of the slide: about nine in a window of 9 by 9 pixels of the depth, as on the device.
DOTS = 36000
DOT_SIGMA_PX = 0.9  # in the infrared picture
# What differs from dot to dot: the laser's power, and the speckle of the surface, new with each placing of the cup.
POWER_SPREAD, SPECKLE = 0.25, 0.3
AMBIENT, WHITE, SHOT = 4.0, 130.0, 0.35  # grey levels: of the room, of a dot on the desk; noise per root of a level
WINDOW_PX = 19  # of the infrared picture: nine of the depth's pixels
CAPILLARY_MM = 2.7  # of water; the others' are not far from it
SEARCH_PX = (-32, 192)  # least disparity and how many, in the infrared picture: from 2 m to 0.4 m


@dataclasses.dataclass
class Sensor:
    height_mm: float = 650.0
    pitch_deg: float = 58.4
    roll_deg: float = 0.0
    baseline_mm: float = BASELINE_MM
    focal_px: float = FOCAL_PX
    disparity_offset_px: float = 0.0
    k1: float = 0.0  # of the camera: distorted = ideal · (1 + k1 r²)

    def axes(self):
        """Right, down, forward in the world, as rows."""
        pitch, roll = np.radians([self.pitch_deg, self.roll_deg])
        right, down = np.array([1.0, 0, 0]), np.array([0, -np.sin(pitch), -np.cos(pitch)])
        return np.array([np.cos(roll) * right + np.sin(roll) * down, np.cos(roll) * down - np.sin(roll) * right,
                         [0, np.cos(pitch), -np.sin(pitch)]])

    def camera_mm(self):
        return np.array([0, 0, self.height_mm]) - self.baseline_mm / 2 * self.axes()[0]

    def projector_mm(self):
        return np.array([0, 0, self.height_mm]) + self.baseline_mm / 2 * self.axes()[0]

    def image_of(self, tangents):
        """Pixels (N, 2) of the depth image in which the camera shows directions x/z, y/z."""
        r2 = (tangents ** 2).sum(1, keepdims=True)
        return CENTRE + self.focal_px * tangents * (1 + self.k1 * r2)


@dataclasses.dataclass
class Cup:
    x_mm: float = 0.0
    y_mm: float = 400.0
    rim_mm: float = 87.0
    inner_mm: float = 40.0
    outer_mm: float = 43.0
    bottom_mm: float = 7.0
    sag_mm: float = 0.0
    bumps: tuple = ()  # (x, y, z of the middle, radius)


@dataclasses.dataclass
class Liquid:
    level_mm: float = 0.0  # above the desk; 0: none
    index: float = 0.0  # 0: as opaque as paint
    tilt_deg: float = 0.0
    azimuth_deg: float = 0.0
    absorption_per_mm: float = 0.0
    rise_mm: float = 0.0  # by how much it climbs the cup's wall


class Unit:
    """What one copy of the device has for itself: its slide's dots, and a smooth error of its disparities [px]."""

    def __init__(self, rng):
        # The slide's picture is wider than the camera's by the baseline at the nearest distance.
        left, right, up = -0.75, 0.62, 0.45
        side = int(np.sqrt(DOTS * 1.6))
        # One dot somewhere in each cell of a grid of which two thirds are filled: scattered, but seldom on top of each other.
        cells = np.stack(np.meshgrid(np.arange(side), np.arange(side)), -1).reshape(-1, 2)
        cells = cells[rng.random(len(cells)) < 0.65]
        unit = (cells + rng.random(cells.shape)) / side
        self.dots = np.array([left, -up]) + unit * np.array([right - left, 2 * up])  # tangents x/z, y/z from the projector
        self.power = np.exp(POWER_SPREAD * rng.standard_normal(len(self.dots)))
        self.bias_px = sum(size_px * smooth_field(rng, sigma_px) for sigma_px, size_px in ((40, 0.08), (12, 0.05)))
        self.references = {}

    def reference(self, sensor):
        """The picture that this unit keeps of a wall at 1.2 m, taken by itself with its own focal length and lens."""
        key = sensor.focal_px, sensor.baseline_mm, sensor.k1
        if key not in self.references:
            tangents = self.dots + [sensor.baseline_mm / REFERENCE_MM, 0]
            self.references[key] = eight_bits(AMBIENT + drawn(2 * sensor.image_of(tangents) + 0.5, self.power * WHITE))
        return self.references[key]


def smooth_field(rng, sigma_px):
    """A field (ROWS, COLUMNS) of unit variance, smooth over so many pixels."""
    # A Gaussian of that width, by its Fourier transform: four times as fast as by sums over the wide ones.
    down, right = scipy.fft.fftfreq(ROWS)[:, None], scipy.fft.rfftfreq(COLUMNS)
    spectrum = scipy.fft.rfft2(rng.standard_normal((ROWS, COLUMNS))) * np.exp(-2 * (np.pi * sigma_px) ** 2 * (down ** 2 + right ** 2))
    field = scipy.fft.irfft2(spectrum, (ROWS, COLUMNS))
    return field / field.std()


def eight_bits(picture):
    """Grey levels as the camera gives them."""
    return np.clip(np.round(picture), 0, 255).astype(np.uint8)


def drawn(places, levels):
    """A picture (2 ROWS, 2 COLUMNS) of Gaussian dots at places (N, 2) in its pixels, with these levels in their middle."""
    height, width = 2 * ROWS, 2 * COLUMNS
    reach = 4
    inside = ((places > -reach) & (places < [width + reach, height + reach])).all(1) & np.isfinite(places).all(1)
    places, levels = places[inside], levels[inside]
    first = np.floor(places).astype(int)
    # A dot's square of pixels is its column's weights times its row's.
    near = np.arange(1 - reach, reach + 1)
    across, along = (np.exp(-(first[:, axis, None] + near - places[:, axis, None]) ** 2 / (2 * DOT_SIGMA_PX ** 2)) for axis in (0, 1))
    margin = 2 * reach  # room for the dots that lie beyond the edges
    wide = width + 2 * margin
    pixels = (first[:, 1, None, None] + near[:, None] + margin) * wide + first[:, 0, None, None] + near + margin
    light = (levels[:, None] * along)[:, :, None] * across[:, None, :]
    picture = np.bincount(pixels.ravel(), light.ravel(), (height + 2 * margin) * wide).reshape(height + 2 * margin, wide)
    return picture[margin:-margin, margin:-margin]


def pov(vector):
    return "<" + ", ".join(f"{float(v):.9g}" for v in vector) + ">"


def positions(eye_mm, sensor, cup, liquid):
    """(ROWS, COLUMNS, 3) the point [mm] that each direction from an eye sees first through the liquid; NaN: none. By POV-Ray."""
    right, down, forward = axes = sensor.axes()
    lines = {"EyeMm": pov(eye_mm), "Right": pov(right), "Down": pov(down), "Forward": pov(forward), "FocalPx": FOCAL_PX,
             "Columns": COLUMNS, "Rows": ROWS, "Least": pov(LEAST_MM), "Most": pov(MOST_MM), "HasCup": 0}
    picture = rendered(tuple(lines.items()), (0, 0, COLUMNS, ROWS))
    if cup is None:
        return picture
    bumps = cup.bumps or ((0, 0, -30.0, 1.0),)  # POV-Ray has no empty arrays: one below the desk
    lines |= {"HasCup": 1, "CupMm": pov([cup.x_mm, cup.y_mm, 0]), "RimMm": cup.rim_mm, "BottomMm": cup.bottom_mm, "InnerMm": cup.inner_mm,
              "OuterMm": cup.outer_mm, "SagMm": cup.sag_mm, "LevelMm": liquid.level_mm, "Index": liquid.index,
              "TiltDeg": liquid.tilt_deg, "AzimuthDeg": liquid.azimuth_deg, "RiseMm": liquid.rise_mm, "CapillaryMm": CAPILLARY_MM,
              "Bumps": f"array[{len(bumps)}] {{{', '.join(pov(bump) for bump in bumps)}}}"}
    # The cup changes the part of the picture that shows the box around it.
    box = [[cup.x_mm + x * cup.outer_mm, cup.y_mm + y * cup.outer_mm, z * cup.rim_mm] for x in (-1, 1) for y in (-1, 1) for z in (0, 1)]
    local = (np.array(box) - eye_mm) @ axes.T
    corners = CENTRE + FOCAL_PX * local[:, :2] / local[:, 2:]
    left, top = np.clip(np.floor(corners.min(0)).astype(int) - 2, 0, [COLUMNS - 1, ROWS - 1])
    beyond, below = np.clip(np.ceil(corners.max(0)).astype(int) + 3, [left + 1, top + 1], [COLUMNS, ROWS])
    picture = picture.copy()
    picture[top:below, left:beyond] = rendered(tuple(lines.items()), (left, top, beyond, below))
    return picture


@functools.lru_cache(maxsize=16)
def rendered(lines, part):
    """The points that a part of the picture shows: (first column, first row, last column + 1, last row + 1). Not to be changed."""
    left, top, beyond, below = part
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "parameters.inc").write_text("".join(f"#declare {name} = {value};\n" for name, value in lines))
        (folder / "positions.pov").write_text(Path(__file__).with_name("positions.pov").read_text())
        run = subprocess.run(["povray", "+Ipositions.pov", "+Opositions.png", f"+W{COLUMNS}", f"+H{ROWS}", f"+SC{left + 1}", f"+EC{beyond}",
                              f"+SR{top + 1}", f"+ER{below}", "+FN16", "File_Gamma=1", "-D", "-A", "+WT1"], cwd=folder,
                             capture_output=True, text=True)
        picture = cv2.imread(str(folder / "positions.png"), cv2.IMREAD_UNCHANGED)
    if run.returncode or picture is None:
        raise RuntimeError("povray: " + run.stderr)
    colour = picture[top:below, left:beyond, 2::-1] / 65535.0  # the rest of the picture is black
    nothing = (colour == 0).all(2) | (colour >= 1).any(2)
    return np.where(nothing[:, :, None], np.nan, LEAST_MM + colour * (MOST_MM - LEAST_MM))


def looked_up(points, places):
    """Points (N, 3) at places (N, 2) of an image of them, by interpolation; NaN where its four pixels see different things."""
    places = np.nan_to_num(places, nan=-1.0, posinf=-1.0, neginf=-1.0)
    column, row = np.floor(places).astype(int).T
    inside = (column >= 0) & (column < COLUMNS - 1) & (row >= 0) & (row < ROWS - 1)
    column, row = np.where(inside, column, 0), np.where(inside, row, 0)
    a, b = (places - np.floor(places)).T[:, :, None]
    corners = points[row, column], points[row, column + 1], points[row + 1, column], points[row + 1, column + 1]
    found = (1 - a) * (1 - b) * corners[0] + a * (1 - b) * corners[1] + (1 - a) * b * corners[2] + a * b * corners[3]
    # On one smooth surface two opposite sides of a pixel are alike; over an edge they are not.
    unlike = np.linalg.norm(corners[0] - corners[1] - corners[2] + corners[3], axis=1)
    across = np.maximum(np.linalg.norm(corners[0] - corners[3], axis=1), np.linalg.norm(corners[1] - corners[2], axis=1))
    return np.where((inside & (unlike < 0.3) & (across < 25))[:, None], found, np.nan)


class Scene:
    """One arrangement of sensor, cup and liquid: where each dot lies and where the camera sees it."""

    def __init__(self, unit, sensor, cup, liquid):
        self.unit, self.sensor = unit, sensor
        axes, camera, projector = sensor.axes(), sensor.camera_mm(), sensor.projector_mm()
        lit = positions(projector, sensor, cup, liquid)
        seen = positions(camera, sensor, cup, liquid)
        # Thermal drift and the like turn the slide: the dots move by the offset after the reference was taken.
        tangents = unit.dots + [sensor.disparity_offset_px / sensor.focal_px, 0]
        point = looked_up(lit, CENTRE + FOCAL_PX * tangents)
        local = (point - camera) @ axes.T
        ideal = CENTRE + FOCAL_PX * local[:, :2] / local[:, 2:]
        there = looked_up(seen, ideal)
        near = np.linalg.norm(there - point, axis=1) < 0.6
        below = np.zeros(len(point), bool)
        clear = cup is not None and liquid.level_mm > 0 and liquid.index > 0
        if clear:
            below = self.in_the_liquid(point, cup, liquid)
            ideal[below], near[below] = self.through_the_liquid(seen, point[below], self.in_the_liquid(seen, cup, liquid))
        near &= np.isfinite(ideal).all(1)
        self.places = np.where(near[:, None], 2 * sensor.image_of((ideal - CENTRE) / FOCAL_PX) + 0.5, np.nan)
        towards = projector - point
        distance = np.linalg.norm(towards, axis=1)
        normal = np.zeros_like(point)
        normal[:, 2] = 1
        if cup is not None:
            radial = point - [cup.x_mm, cup.y_mm, 0]
            radial[:, 2] = 0
            radius = np.linalg.norm(radial, axis=1)
            inside = np.abs(radius - cup.inner_mm) < 0.1
            wall = (inside | (np.abs(radius - cup.outer_mm) < 0.1)) & (point[:, 2] < cup.rim_mm - 0.1) & (point[:, 2] > 0.1)
            normal[wall] = (radial / np.maximum(radius, 1)[:, None] * np.where(inside, -1, 1)[:, None])[wall]
        cosine = np.clip((towards * normal).sum(1) / distance, 0, 1)
        self.level = WHITE * cosine * (700 / distance) ** 2 / 0.8
        if clear:
            depth = np.where(below, liquid.level_mm - point[:, 2], 0)
            self.level *= np.exp(-2.2 * liquid.absorption_per_mm * depth)
        self.level *= unit.power

    @staticmethod
    def in_the_liquid(points, cup, liquid):
        radius = np.hypot(points[..., 0] - cup.x_mm, points[..., 1] - cup.y_mm)
        return (radius < cup.inner_mm + 0.05) & (points[..., 2] < liquid.level_mm - 0.05)

    @staticmethod
    def through_the_liquid(seen, points, wet):
        """Pixels in which the camera sees points below the surface, and whether it does: the image of positions, inverted."""
        rows, columns = np.nonzero(wet)
        place, ok = np.full((len(points), 2), np.nan), np.zeros(len(points), bool)
        if len(rows) < 20 or len(points) == 0:
            return place, ok
        tree = cKDTree(seen[rows, columns])
        _, nearest = tree.query(points)
        place = np.stack([columns[nearest], rows[nearest]], 1).astype(float)
        for _ in range(5):  # Newton's steps, least squares in three coordinates
            here = looked_up(seen, place)
            across = looked_up(seen, place + [0.5, 0]) - looked_up(seen, place - [0.5, 0])
            along = looked_up(seen, place + [0, 0.5]) - looked_up(seen, place - [0, 0.5])
            error = points - here
            aa, ab, bb = (across * across).sum(1), (across * along).sum(1), (along * along).sum(1)
            ea, eb = (across * error).sum(1), (along * error).sum(1)
            det = aa * bb - ab * ab
            step = np.stack([bb * ea - ab * eb, aa * eb - ab * ea], 1) / det[:, None]
            place = place + np.clip(step, -2, 2)
        return place, np.linalg.norm(looked_up(seen, place) - points, axis=1) < 0.3

    def infrared(self, placement_rng, rng):
        """The infrared picture of a shot, eight bits: speckle of this placing of the cup, noise of this shot."""
        shape = 1 / SPECKLE ** 2
        speckle = placement_rng.gamma(shape, 1 / shape, len(self.level)) * (1 + 0.05 * rng.standard_normal(len(self.level)))
        picture = AMBIENT + drawn(self.places, np.where(np.isfinite(self.level), self.level, 0) * speckle)
        picture += SHOT * np.sqrt(picture) * rng.standard_normal(picture.shape)
        return eight_bits(picture)


def disparities(infrared, reference):
    """(ROWS, COLUMNS) disparity [px of the depth image] of a picture to the reference image; NaN where OpenCV finds none."""
    matcher = cv2.StereoBM_create(numDisparities=SEARCH_PX[1], blockSize=WINDOW_PX)
    matcher.setMinDisparity(SEARCH_PX[0])
    matcher.setPreFilterType(cv2.STEREO_BM_PREFILTER_XSOBEL)
    matcher.setTextureThreshold(200)
    matcher.setUniquenessRatio(12)
    matcher.setSpeckleWindowSize(120)
    matcher.setSpeckleRange(2)
    # Beyond its left edge the picture needs room for the search.
    pad = SEARCH_PX[0] + SEARCH_PX[1] + WINDOW_PX
    wide = [cv2.copyMakeBorder(picture, 0, 0, pad, pad, cv2.BORDER_CONSTANT, value=0) for picture in (infrared, reference)]
    found = matcher.compute(*wide)[:, pad:-pad].astype(float) / 16
    found[found < SEARCH_PX[0]] = np.nan
    return (found[0::2, 0::2] + found[1::2, 1::2]) / 4  # two pixels of one depth pixel; half as many pixels


def depth_mm(disparity_px):
    """What the device says [mm]: a step of 1/8 px, then whole millimetres."""
    steps = np.floor(disparity_px / STEP_PX) + 0.5
    z = np.floor(1 / (1 / REFERENCE_MM + steps * STEP_PX / (FOCAL_PX * BASELINE_MM)))
    return np.where((z > 315) & (z < 5000), z, np.nan)


def write_cloud(path, depth):
    """A PCD of depth [mm], as the host makes it with the focal length that the device claims."""
    row, column = np.mgrid[0:ROWS, 0:COLUMNS]
    cloud = np.stack([(column - CENTRE[0]) * depth / FOCAL_PX, (row - CENTRE[1]) * depth / FOCAL_PX, depth], -1)
    body = (cloud * 1e-3).astype("<f4").reshape(-1, 3)
    body[~np.isfinite(body[:, 2])] = np.nan
    head = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
            f"WIDTH {COLUMNS}\nHEIGHT {ROWS}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {COLUMNS * ROWS}\nDATA binary\n")
    path.write_bytes(head.encode() + body.tobytes())
