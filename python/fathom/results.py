"""What the functions of fathom return. Lengths of arrays are in metres, as everywhere in the program; every other unit
stands in the name. World: z up, the desk's top at z = 0, x to the sensor's right, y away from it. Camera: x right, y down,
z forward. The first pixel's centre is at (0.5, 0.5)."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Doubles = NDArray[np.float64]
Integers = NDArray[np.integer[Any]]


@dataclass(frozen=True, eq=False)
class Theory:
    """The raised bottom under a level, clear liquid. All arrays have the shape to which the arguments broadcast.

    eq7_mm: height above the bottom by the paper's Eq. 7
    exact_mm: the same by both refracted rays: what an ideal sensor measures
    incidence_projector_deg: angle from the vertical at which the projector's ray meets the surface
    incidence_camera_deg: the same of the camera's
    epipolar_px: how far the two rays miss each other; 0 on the baseline's perpendicular bisector
    """

    eq7_mm: Doubles
    exact_mm: Doubles
    incidence_projector_deg: Doubles
    incidence_camera_deg: Doubles
    epipolar_px: Doubles


@dataclass(frozen=True, eq=False)
class Truth:
    """What every pixel of the depth image really looks at: h x w arrays, 0 where there is nothing.

    position: h x w x 3 [m] world: the first diffuse point on the pixel's refracted ray
    apparent_depth: [m] what an ideal triangulating camera measures there; 0 where the projector is hidden
    object: number of the object there, see Camera.objects
    first_object: number of the first surface on the ray, a liquid's or clear wall's too
    first_depth: [m] depth of that surface
    path: 0 nothing, 1 direct, 2 refracted, 3 scattered
    """

    position: Floats
    apparent_depth: Floats
    object: NDArray[np.int32]
    first_object: NDArray[np.int32]
    first_depth: Floats
    path: NDArray[np.int32]


@dataclass(frozen=True, eq=False, repr=False)
class Capture:
    """One shot. The arrays are the simulator's own memory, not copies of it.

    ir: infrared image [DN], twice the depth image's size (1024 x 1280); None in geometric mode
    disparity_px: h x w, f b / Z; 0 where there is none
    depth: h x w [m] along the camera's axis; 0 where there is none
    cloud: h x w x 3 [m] camera frame; NaN where there is no depth
    intensity: h x w infrared light at the cloud's points [DN]
    camera_matrix: 3 x 3 [px], of the depth image
    world_from_camera: 4 x 4 [m]
    """

    ir: Floats | None
    disparity_px: Floats
    depth: Floats
    cloud: Floats
    intensity: Floats
    camera_matrix: Doubles
    world_from_camera: Doubles

    def __repr__(self) -> str:
        height, width = self.depth.shape
        seen = self.depth[self.depth > 0]
        depths = f"{seen.size / self.depth.size:.0%} of them seen, {seen.min():.3f} to {seen.max():.3f} m" if seen.size else "none seen"
        ir = "no infrared image" if self.ir is None else "infrared image of {1} x {0} px".format(*self.ir.shape)
        return f"<Capture: {width} x {height} depths, {depths}; {ir}>"


@dataclass(frozen=True, eq=False)
class DeskPlane:
    """Points p of the camera's frame with normal . p + offset_m = 0.

    normal: (3,) unit length, on the camera's side
    height_mm: of the camera above the desk
    pitch_deg: of the camera: 0 looks horizontally, 90 straight down
    rms_mm: of the inliers' distances
    """

    normal: Doubles
    offset_m: float
    height_mm: float
    pitch_deg: float
    inliers: int
    rms_mm: float


@dataclass(frozen=True, eq=False)
class Cup:
    """A cup that was found. What was not seen is None.

    center_camera_m: (3,) its axis 45 mm above the desk, camera frame
    rms_mm: of the points from the circle or cone
    height_mm: of the rim above the desk
    lean_deg: by how much its wall leans outwards
    score: [mm] how far points lie from the template or the fitted wall
    liquid: "yes", "no", "unknown"
    p_liquid: probability that there is a liquid
    surface_mm: mean height above the desk of what is seen inside
    sigma_mm: 1 sigma of that
    sd_mm: standard deviation of its points
    bottom_mm: where the empty cup's bottom is taken to be, above the desk
    kind: "transparent", "opaque", "unknown"
    why: the decision in words
    points: n x 3 [m] camera frame: the cup's points
    """

    center_camera_m: Doubles
    radius_mm: float
    rms_mm: float
    band_points: int
    icp_iterations: int | None
    radius_sigma_mm: float | None
    height_mm: float
    lean_deg: float | None
    score: float
    liquid: str
    p_liquid: float | None
    surface_mm: float | None
    sigma_mm: float | None
    sd_mm: float | None
    points_inside: int
    bottom_mm: float | None
    kind: str
    fill_mm: float | None
    fill_sigma_mm: float | None
    why: str
    points: Floats = field(repr=False)


@dataclass(frozen=True, eq=False)
class Candidate:
    """Something that was looked at and is no cup.

    center_camera_m: (3,) the middle of the room that it takes, 45 mm above the desk, camera frame
    height_mm: of its highest point above the desk
    score: [mm]
    """

    reason: str
    center_camera_m: Doubles
    width_mm: float
    height_mm: float
    radius_mm: float | None
    rms_mm: float | None
    band_points: int
    icp_iterations: int | None
    score: float | None
    surface_mm: float | None


@dataclass(frozen=True, eq=False)
class Detection:
    """What a detector found in a cloud.

    plane: None: no desk, `why` says the reason
    desk_from_camera: 4 x 4 [m]: z up from the desk, y the horizontal line of sight
    """

    plane: DeskPlane | None
    desk_from_camera: Doubles | None
    segments: int
    cups: list[Cup]
    candidates: list[Candidate]
    why: str


@dataclass(frozen=True)
class Explanation:
    """A row of a diagnosis' posterior: effects that together explain the measurements.

    effects: none: the model as it is; "unknown": what no effect in the list explains
    words: the same for people
    """

    effects: tuple[str, ...]
    words: str
    probability: float


@dataclass(frozen=True, eq=False)
class Residuals:
    """Every observation of a measurement as arrays of one length n, in the columns of residuals.csv. The last five are in
    the observable's unit: `residuals.observable == "height_mm"` picks the heights in cups.

    region: of the cup or of the desk around it
    before: measured minus predicted by the model as it is
    after: measured minus predicted with the effects that were found
    sigma: 1 sigma of that
    pixels: of which the observation is a mean; 0: of no certain number
    """

    observable: NDArray[np.str_]
    region: NDArray[np.str_]
    session: Integers
    pour: Integers
    placement: Integers
    liquid: NDArray[np.str_]
    fill_mm: Doubles
    distance_mm: Doubles
    lateral_mm: Doubles
    measured: Doubles
    before: Doubles
    after: Doubles
    sigma: Doubles
    pixels: Doubles


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Where model and measurement disagree, and what explains it.

    verdict: "none", "named", "ambiguous", "unknown", "named+unknown", "insufficient"
    answer: one to three sentences
    posterior: most probable first
    report: everything else, as report.json has it (docs/files.md)
    """

    verdict: str
    answer: str
    posterior: list[Explanation]
    residuals: Residuals
    report: dict[str, Any] = field(repr=False)


@dataclass(frozen=True, eq=False)
class LearnedUnit:
    """How one device differs from its model. Images are 480 x 640 [px of disparity].

    bias_px: measured minus true, where the clouds show the mean of their desks
    sigma_px: 1 sigma of that; as large as any unit's where no desk was seen
    seen: where any cloud has desk
    reference_px: the part that moves with the reference image
    camera_px: the part that stays at the camera's pixels
    facts: what `fathom calibrate` prints: name, with its unit, and value
    """

    bias_px: Floats
    sigma_px: Floats
    seen: NDArray[np.bool_]
    reference_px: Floats
    camera_px: Floats
    facts: dict[str, float | str]
    _native: Any = field(repr=False)

    def save(self, folder: str | Path) -> Path:
        """Writes unit_bias.exr and unit.json, which a scene's sensor takes: {"unit": "unit.json"}. Returns the path of
        unit.json."""
        self._native.save(folder)
        return Path(folder) / "unit.json"


@dataclass(frozen=True)
class DataSet:
    """A folder of labelled frames (docs/datasets.md).

    frames: of this part
    made_now: the others stood there already
    is_complete: with all other parts
    """

    folder: Path
    frames: int
    made_now: int
    is_complete: bool
