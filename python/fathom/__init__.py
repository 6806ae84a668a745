"""Fathom in Python: a structured-light depth camera that looks at cups with liquids, as NumPy arrays.

    import fathom
    shot = fathom.capture(fathom.scene("paper_water"))
    shot.depth                       # 480 x 640 [m]

Every function takes what the program's command of the same name takes and gives the same numbers. What is wrong from
outside, a file, a key, a shape, raises fathom.Error with the program's one line. Functions that may take long let other
threads run, end with Ctrl-C, and call progress(what, done, total) where one is given.
"""
from __future__ import annotations

import os
import threading
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

if (_scenes := Path(__file__).with_name("scenes")).is_dir():  # an installed package brings the libraries along
    os.environ.setdefault("FATHOM_DATA", str(_scenes))

from fathom import _fathom
from fathom._fathom import Error, __version__
from fathom.config import (Calibration, Desk, DisparityNoise, Glaze, Handle, Matcher, Noise, Optics, Pattern, Ripple, Sensor,
                           Surface, Unit)
from fathom.results import (Candidate, Capture, Cup, DataSet, DeskPlane, Detection, Diagnosis, Explanation, Floats, LearnedUnit,
                            Residuals, Theory, Truth)

__all__ = [
    "Calibration", "Camera", "Candidate", "Capture", "Cup", "DataSet", "Desk", "DeskPlane", "Detection", "Diagnosis",
    "DisparityNoise", "Error", "Explanation", "Glaze", "Handle", "LearnedUnit", "Matcher", "Noise", "Optics", "Pattern", "Residuals",
    "Ripple", "Sensor", "Surface", "Theory", "Truth", "Unit", "__version__", "calibrate", "capture", "configure",
    "detect", "diagnose", "generate", "names", "read_cloud", "scene", "sensor", "theory"]

Error.__module__ = "fathom"

PathLike = Union[str, "os.PathLike[str]"]
Scene = Union[PathLike, Mapping[str, Any]]
Progress = Callable[[str, int, int], object]


def theory(fill_mm: ArrayLike, distance_mm: ArrayLike, lateral_mm: ArrayLike = 0.0, *, height_mm: ArrayLike = 650.0,
           index: ArrayLike = 1.333, baseline_mm: ArrayLike = 75.0, pitch_deg: ArrayLike | None = None) -> Theory:
    """How high a bottom under a level, clear liquid is measured: the paper's Eq. 7 and the exact triangulation.

    Arguments are numbers or arrays, which broadcast against each other.

    fill_mm: depth of the liquid, below height_mm
    distance_mm, lateral_mm: place of the bottom point, along the line of sight and along the baseline
    height_mm: of the sensor above the bottom
    index: of the liquid relative to air, at least 1
    baseline_mm: from camera to projector
    pitch_deg: of the sensor below the horizontal; None: it aims at each bottom point
    """
    pitch = np.nan if pitch_deg is None else pitch_deg
    arrays = [_numbers(*argument) for argument in (
        ("fill_mm", fill_mm), ("distance_mm", distance_mm), ("lateral_mm", lateral_mm), ("height_mm", height_mm),
        ("baseline_mm", baseline_mm), ("index", index), ("pitch_deg", pitch))]
    try:
        given = np.broadcast_arrays(*arrays)
    except ValueError as problem:
        raise Error(f"theory: {problem}") from None
    found = _fathom.raised_bottoms(np.stack([argument.ravel() for argument in given], axis=1))
    return Theory(*(found[:, column].reshape(given[0].shape) for column in range(found.shape[1])))


class Camera:
    """A simulated sensor before a scene, ready for any number of shots; only the noise differs from shot to shot.

    scene: a scene file, or its content as a dictionary, in which objects of fathom.config and arrays may stand
        (docs/scene.md); files that a dictionary names are relative to the working folder
    mode: "photometric": infrared image and matching; "geometric": every pixel's exact triangulation, images only of liquids that
        scatter
    light: "direct", where liquids that scatter are opaque, "full", or "auto": full where a cup or anything else stands,
        unless a liquid scatters as paint does (reduced scattering from 20 per mm); "geometric" adds to direct light only what liquids scatter
    spp: samples per infrared pixel, on a square grid
    seed: of everything random
    model: model.json of a diagnosis, whose effects are there as well
    """

    def __init__(self, scene: Scene, *, mode: str = "photometric", light: str = "auto", spp: int = 4, seed: int = 1,
                 model: PathLike | None = None, progress: Progress | None = None) -> None:
        path, content = _file_or_object(scene)
        self._alone = threading.Lock()
        self._native = _fathom.Camera(path, content, mode, light, spp, _seed(seed), model, progress)

    def shoot(self, frame: int = 0, *, progress: Progress | None = None) -> Capture:
        """The shot of that number, from 0."""
        with self._alone:  # a shot takes all cores
            arrays = self._native.shoot(_seed(frame, "frame"), progress)
        return Capture(**arrays, camera_matrix=np.array(self.record["camera_matrix"]),
                       world_from_camera=np.array(self.record["world_from_camera"]))

    @cached_property
    def record(self) -> dict[str, Any]:
        """What is shot, as run.json of the program has it: resolved scene, media, objects, approximations, times."""
        return self._native.record()

    @cached_property
    def sensor(self) -> Sensor:
        """The sensor with all its keys, effects included."""
        return Sensor.from_dict(self.record["sensor"])

    @property
    def objects(self) -> dict[int, str]:
        """Names of the objects by the numbers that Truth has."""
        return {int(number): name for number, name in self.record["objects"].items()}

    @cached_property
    def truth(self) -> Truth:
        """What every pixel really looks at."""
        channels = self._native.truth()

        def whole(name: str) -> Any:
            return channels[name].astype(np.int32)

        return Truth(position=np.stack([channels[f"position.{axis}"] for axis in "XYZ"], axis=-1),
                     apparent_depth=channels["apparent.Z"], object=whole("object"), first_object=whole("first.object"),
                     first_depth=channels["first.Z"], path=whole("path"))


def capture(scene: Scene, *, mode: str = "photometric", light: str = "auto", spp: int = 4, seed: int = 1,
            model: PathLike | None = None, progress: Progress | None = None) -> Capture:
    """One shot of a scene. A Camera also has the truth, and shoots again at once.
    """
    camera = Camera(scene, mode=mode, light=light, spp=spp, seed=seed, model=model, progress=progress)
    return camera.shoot(progress=progress)


capture.__doc__ = f"{capture.__doc__}\n    " + (Camera.__doc__ or "").split("\n\n", 1)[1].lstrip()


def sensor(model: str = "xtion_pro_live", **keys: Any) -> Sensor:
    """A sensor of names("sensors") with all its keys as attributes, to look at or to change.

    keys: of a scene's sensor, over those of the model; at least the pose, by height_mm and aim_mm or pitch_deg
    """
    whole = _fathom.whole_sensor({"model": model, **keys})
    pose = {key: keys[key] for key in ("height_mm", "aim_mm", "pitch_deg", "roll_deg") if key in keys}
    if pose:
        del whole["world_from_camera"]
    return Sensor.from_dict({**whole, **pose})


def read_cloud(path: PathLike) -> tuple[Floats, Floats | None]:
    """Points of a PCD or PLY file in metres, h x w x 3 or n x 3, and their intensities, h x w or n, or None.

    path: of the file

    NaN where nothing was measured; camera frame: x right, y down, z forward.
    """
    return _fathom.read_cloud(path)


def detect(cloud: Union[ArrayLike, PathLike, Capture], intensity: ArrayLike | None = None, *, method: str = "robust",
           height_mm: float | None = None, pitch_deg: float | None = None, unit: PathLike | None = None,
           config: Union[PathLike, Mapping[str, Any], None] = None) -> Detection:
    """Finds cups on a desk and the liquids in them.

    cloud: n x 3 or h x w x 3 points [m] in the camera's frame, NaN where nothing was measured; or a PCD or PLY file;
        or a Capture
    intensity: infrared light at the points, n or h x w; it tells clear liquids from opaque ones
    method: "robust", or "paper" and the other methods of `fathom detect --help`
    height_mm, pitch_deg: of the camera over the desk, where that is known; both or neither
    unit: unit.json of `calibrate`, whose bias is taken off the cloud
    config: parameters of the method, a file or its keys (docs/files.md)
    """
    if isinstance(cloud, Capture):
        points: Any = cloud.cloud
        intensity = cloud.intensity if intensity is None else intensity
    elif isinstance(cloud, (str, os.PathLike)):
        points, own = _fathom.read_cloud(cloud)
        intensity = own if intensity is None else intensity
    else:
        points = _numbers("cloud", cloud, np.float32)
    brightness = None if intensity is None else _numbers("intensity", intensity, np.float32)
    found = _fathom.detect(points, brightness, method, height_mm, pitch_deg, unit, *_file_or_object(config))
    plane = found["plane"]
    if plane:
        plane["normal"] = np.array(plane["normal"])
    for thing in found["cups"] + found["candidates"]:
        thing["center_camera_m"] = np.array(thing["center_camera_m"])
    return Detection(
        plane=plane and DeskPlane(**plane), desk_from_camera=found.get("desk_from_camera"), segments=found["segments"],
        cups=[Cup(**cup) for cup in found["cups"]],
        candidates=[Candidate(**candidate) for candidate in found["candidates"]], why=found.get("why", ""))


def diagnose(folders: Union[PathLike, Sequence[PathLike]], *, model: PathLike | None = None, without: Sequence[str] = (),
             fidelity: str = "geometric", seed: int = 1, progress: Progress | None = None) -> Diagnosis:
    """Finds where model and measurement disagree, names the effect that explains it, and says what is left.

    folders: a measurement folder (rig.json, frames.csv, clouds), or several: later sessions of the same rig
    model: model.json of an earlier diagnosis, whose effects are known already
    without: effects of names("effects") that are not considered
    fidelity: "geometric": some hundred rays a condition; "photometric": after that whole images of what is left
    """
    places = [folders] if isinstance(folders, (str, os.PathLike)) else list(folders)
    if not places:
        raise Error("folders: must name at least one measurement folder")
    if isinstance(without, str):
        without = [without]
    found = _fathom.diagnose(places, model, list(without), fidelity, _seed(seed), progress)
    columns = {name: np.asarray(column) for name, column in found["residuals"].items()}
    report = found["report"]
    return Diagnosis(verdict=report["verdict"], answer=report["answer"],
                     posterior=[Explanation(**row) for row in found["posterior"]], residuals=Residuals(**columns), report=report)


def calibrate(clouds: Union[PathLike, Sequence[PathLike]], *, height_mm: float | None = None, pitch_deg: float | None = None,
              focal_px: float | None = None, interval_s: float | None = None, registered: bool | None = None,
              progress: Progress | None = None) -> LearnedUnit:
    """Learns how one device differs from its model, from clouds of desks and walls.

    clouds: PCD or PLY files, or a frames.csv that names them
    height_mm, pitch_deg: of the camera over the desk, where that is known; both or neither
    focal_px: of the infrared camera at 640 x 480, whatever depths and rays tell
    interval_s: from one cloud to the next, the first was taken when the device was switched on
    registered: whether the clouds are the colour camera's; None: their rays tell
    """
    files = [clouds] if isinstance(clouds, (str, os.PathLike)) else list(clouds)
    native = _fathom.calibrate(files, height_mm, pitch_deg, focal_px, interval_s, registered, progress)
    return LearnedUnit(bias_px=native.bias_px(), sigma_px=native.sigma_px(), seen=native.seen(),
                       reference_px=native.reference_px(), camera_px=native.camera_px(), facts=native.facts(), _native=native)


def generate(folder: PathLike, frames: int = 1000, *, spec: Union[PathLike, Mapping[str, Any], None] = None, seed: int = 1,
             shard: tuple[int, int] = (0, 1), progress: Progress | None = None) -> DataSet:
    """Labelled frames of random desks, as BOP and COCO have them. Goes on where an earlier run of the same stopped.

    folder: where they go
    spec: what is drawn, a file or its keys (docs/datasets.md); None: the specification that comes with the program
    shard: (i, n): only the i-th of n parts, from 0
    """
    part, parts = shard
    made = _fathom.generate(folder, frames, *_file_or_object(spec), _seed(seed), part, parts, progress)
    return DataSet(folder=Path(folder), **made)


def names(library: str) -> list[str]:
    """Entries of a library that scenes name: "cups", "effects", "media", "sensors", "solids" or "walls"."""
    return _fathom.names(library)


def scene(name: str) -> Path:
    """Path of a scene file that comes with the program, such as "paper_water"."""
    path = Path(_fathom.data_directory()) / f"{name}.json"
    if not path.is_file():
        known = ", ".join(sorted(file.stem for file in path.parent.glob("*.json") if file.stem != "schema"))
        raise Error(f"unknown scene '{name}', choose from {known}")
    return path


def configure(*, threads: int = 0, max_input_mb: int = 1000, allow_outside: bool = False) -> None:
    """The program's options of these names, for the whole process. Call it while no other function runs.

    threads: 0: all
    max_input_mb: memory that one file which is read may claim
    allow_outside: files that are read may name others outside their folder
    """
    _fathom.configure(threads, max_input_mb, allow_outside)


def _file_or_object(given: Any) -> tuple[PathLike | None, Any]:
    return (given, None) if isinstance(given, (str, os.PathLike)) else (None, given)


def _numbers(name: str, given: ArrayLike, of: Any = np.float64) -> Any:
    try:
        return np.asarray(given, dtype=of)
    except (TypeError, ValueError) as problem:
        raise Error(f"{name}: must be numbers: {problem}") from None


def _seed(number: int, name: str = "seed") -> int:
    if not 0 <= number < 2**64:
        raise Error(f"{name}: must be a whole number from 0 to 2^64 - 1, got {number}")
    return number
