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
    """The raised bottom under a level, clear liquid. All arrays have the shape to which the arguments broadcast."""

    eq7_mm: Doubles  #: height above the bottom by the paper's Eq. 7
    exact_mm: Doubles  #: the same by both refracted rays: what an ideal sensor measures
    incidence_projector_deg: Doubles  #: angle from the vertical at which the projector's ray meets the surface
    incidence_camera_deg: Doubles  #: the same of the camera's
    epipolar_px: Doubles  #: how far the two rays miss each other; 0 on the baseline's perpendicular bisector


@dataclass(frozen=True, eq=False)
class Truth:
    """What every pixel of the depth image really looks at: h x w arrays, 0 where there is nothing."""

    position: Floats  #: h x w x 3 [m] world: the first diffuse point on the pixel's refracted ray
    apparent_depth: Floats  #: [m] what an ideal triangulating camera measures there; 0 where the projector is hidden
    object: NDArray[np.int32]  #: number of the object there, see Camera.objects
    first_object: NDArray[np.int32]  #: number of the first surface on the ray, a liquid's or clear wall's too
    first_depth: Floats  #: [m] depth of that surface
    path: NDArray[np.int32]  #: 0 nothing, 1 direct, 2 refracted, 3 scattered


@dataclass(frozen=True, eq=False, repr=False)
class Capture:
    """One shot. The arrays are the simulator's own memory, not copies of it."""

    ir: Floats | None  #: infrared image [DN], twice the depth image's size (1024 x 1280); None in geometric mode
    disparity_px: Floats  #: h x w, f b / Z; 0 where there is none
    depth: Floats  #: h x w [m] along the camera's axis; 0 where there is none
    cloud: Floats  #: h x w x 3 [m] camera frame; NaN where there is no depth
    intensity: Floats  #: h x w infrared light at the cloud's points [DN]
    camera_matrix: Doubles  #: 3 x 3 [px], of the depth image
    world_from_camera: Doubles  #: 4 x 4 [m]

    def __repr__(self) -> str:
        height, width = self.depth.shape
        seen = self.depth[self.depth > 0]
        depths = f"{seen.size / self.depth.size:.0%} of them seen, {seen.min():.3f} to {seen.max():.3f} m" if seen.size else "none seen"
        ir = "no infrared image" if self.ir is None else "infrared image of {1} x {0} px".format(*self.ir.shape)
        return f"<Capture: {width} x {height} depths, {depths}; {ir}>"


@dataclass(frozen=True, eq=False)
class DeskPlane:
    """Points p of the camera's frame with normal . p + offset_m = 0."""

    normal: Doubles  #: (3,) unit length, on the camera's side
    offset_m: float
    height_mm: float  #: of the camera above the desk
    pitch_deg: float  #: of the camera: 0 looks horizontally, 90 straight down
    inliers: int
    rms_mm: float  #: of the inliers' distances


@dataclass(frozen=True, eq=False)
class Cup:
    """A cup that was found. What was not seen is None."""

    center_camera_m: Doubles  #: (3,) its axis 45 mm above the desk, camera frame
    radius_mm: float
    rms_mm: float  #: of the points from the circle or cone
    band_points: int
    icp_iterations: int | None
    radius_sigma_mm: float | None
    height_mm: float  #: of the rim above the desk
    lean_deg: float | None  #: by how much its wall leans outwards
    score: float  #: [mm] how far points lie from the template or the fitted wall
    liquid: str  #: "yes", "no", "unknown"
    p_liquid: float | None  #: probability that there is a liquid
    surface_mm: float | None  #: mean height above the desk of what is seen inside
    sigma_mm: float | None  #: 1 sigma of that
    sd_mm: float | None  #: standard deviation of its points
    points_inside: int
    bottom_mm: float | None  #: where the empty cup's bottom is taken to be, above the desk
    kind: str  #: "transparent", "opaque", "unknown"
    fill_mm: float | None
    fill_sigma_mm: float | None
    why: str  #: the decision in words
    points: Floats = field(repr=False)  #: n x 3 [m] camera frame: the cup's points


@dataclass(frozen=True, eq=False)
class Candidate:
    """Something that was looked at and is no cup."""

    reason: str
    center_camera_m: Doubles  #: (3,) the middle of the room that it takes, 45 mm above the desk, camera frame
    width_mm: float
    height_mm: float  #: of its highest point above the desk
    radius_mm: float | None
    rms_mm: float | None
    band_points: int
    icp_iterations: int | None
    score: float | None  #: [mm]
    surface_mm: float | None


@dataclass(frozen=True, eq=False)
class Detection:
    """What a detector found in a cloud."""

    plane: DeskPlane | None  #: None: no desk, `why` says the reason
    desk_from_camera: Doubles | None  #: 4 x 4 [m]: z up from the desk, y the horizontal line of sight
    segments: int
    cups: list[Cup]
    candidates: list[Candidate]
    why: str


@dataclass(frozen=True)
class Explanation:
    """A row of a diagnosis' posterior: effects that together explain the measurements."""

    effects: tuple[str, ...]  #: none: the model as it is; "unknown": what no effect in the list explains
    words: str  #: the same for people
    probability: float


@dataclass(frozen=True, eq=False)
class Residuals:
    """Every observation of a measurement as arrays of one length n, in the columns of residuals.csv. The last five are in
    the observable's unit: `residuals.observable == "height_mm"` picks the heights in cups."""

    observable: NDArray[np.str_]
    region: NDArray[np.str_]  #: of the cup or of the desk around it
    session: Integers
    pour: Integers
    placement: Integers
    liquid: NDArray[np.str_]
    fill_mm: Doubles
    distance_mm: Doubles
    lateral_mm: Doubles
    measured: Doubles
    before: Doubles  #: measured minus predicted by the model as it is
    after: Doubles  #: measured minus predicted with the effects that were found
    sigma: Doubles  #: 1 sigma of that
    pixels: Doubles  #: of which the observation is a mean; 0: of no certain number


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Where model and measurement disagree, and what explains it."""

    verdict: str  #: "none", "named", "ambiguous", "unknown", "named+unknown", "insufficient"
    answer: str  #: one to three sentences
    posterior: list[Explanation]  #: most probable first
    residuals: Residuals
    report: dict[str, Any] = field(repr=False)  #: everything else, as report.json has it (docs/files.md)


@dataclass(frozen=True, eq=False)
class LearnedUnit:
    """How one device differs from its model. Images are 480 x 640 [px of disparity]."""

    bias_px: Floats  #: measured minus true, where the clouds show the mean of their desks
    sigma_px: Floats  #: 1 sigma of that; as large as any unit's where no desk was seen
    seen: NDArray[np.bool_]  #: where any cloud has desk
    reference_px: Floats  #: the part that moves with the reference image
    camera_px: Floats  #: the part that stays at the camera's pixels
    facts: dict[str, float | str]  #: what `fathom calibrate` prints: name, with its unit, and value
    _native: Any = field(repr=False)

    def save(self, folder: str | Path) -> Path:
        """Writes unit_bias.exr and unit.json, which a scene's sensor takes: {"unit": "unit.json"}. Returns the path of
        unit.json."""
        self._native.save(folder)
        return Path(folder) / "unit.json"


@dataclass(frozen=True)
class DataSet:
    """A folder of labelled frames (docs/datasets.md)."""

    folder: Path
    frames: int  #: of this part
    made_now: int  #: the others stood there already
    is_complete: bool  #: with all other parts
