"""Objects of scene files, made by scripts/pages from the tables that read these. docs/scene.md has the same keys."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from fathom._configuration import Configuration


@dataclass(kw_only=True, slots=True, repr=False)
class Sensor(Configuration):
    """Sensor, sensor of a scene.

    model: a model of fathom list sensors; the other keys change it. xtion_pro_live and kinect_v1 match ideally, for
        work on what light does; names that end in _device imitate the real device; a name
    name: what a sensor without model is called; a text
    height_mm: height of the baseline's middle above the desk; above 0, at most 1000000
    aim_mm: the point of the world that the baseline's middle looks at; or pitch_deg; [x, y, z]
    pitch_deg: angle below the horizontal; 90: straight down; -90 to 90
    roll_deg: turn about the optical axis, clockwise as seen from behind; -180 to 180
    world_from_camera: pose of the infrared camera instead of height and angles: rotation, and translation in metres; 4
        rows of 4 numbers
    baseline_mm: from the camera to the projector; above 0, at most 1000000; default 75
    wavelength_nm: of the projector's light; 100 to 5000; default 830
    ir_size_px: width and height of the infrared image; [width, height], each 16 to 8192; default [1280, 1024]
    depth_size_px: width and height of the depth image: half of ir_size_px; rows beyond are cropped; [width, height],
        each 16 to 8192; default [640, 480]
    focal_px: focal length of the depth image; 1 to 1000000; default 570.342
    principal_px: principal point of the depth image; its middle where only the size is given; [x, y], each -1000000 to
        1000000; default [320, 240]
    reference_mm: distance of the reference plane; above 0, at most 1000000; default 1200
    near_mm: nearer depths are invalid; a search of 63 px reaches to 440 mm; above 0, at most 1000000; default 450
    far_mm: farther depths are invalid; above 0, at most 1000000; default 10000
    radiant_dn_mm2: brightness: a dot's centre on albedo 1 at r mm has this times cos θ / r²; above 0; default 590000000
    quantization: device: depths are rounded to the device's steps of 1/8 px of disparity; off: they are not; device,
        off; default device
    depth_step_phase: offset of the depth steps, as a share of a step; 0.5: halfway between two codes; -2 to 2; default
        0.5
    codes_per_step: number of codes of 1/8 px in one depth step; 1 to 64; default 1
    depth_cut_mm: depths are truncated to multiples of this; 0: they are not; 0 to 100; default 1
    optics: lenses: speckle's grain, defocus, distortion; an object
    noise: off; basic: speckle of the dots, shot and read noise; landau_2016: constants as published; device: speckle of
        the pixels, in the reference image as well, shot and read noise, ambient light, blooming; or an object of parts;
        a name or an object
    unit: how this individual device differs from its model: a unit.json of fathom calibrate, which switches residue_px
        off, or an object; a path or an object
    pattern: the projected dots; an object
    matcher: how disparities are found; an object
    believed: calibration that the device computes depths and points with, where it differs from the true one; an object
    """

    model: str | Path | None = None
    name: str | Path | None = None
    height_mm: float | None = None
    aim_mm: Sequence[float] | None = None
    pitch_deg: float | None = None
    roll_deg: float | None = None
    world_from_camera: Sequence[Sequence[float]] | None = None
    baseline_mm: float | None = None
    wavelength_nm: float | None = None
    ir_size_px: Sequence[int] | None = None
    depth_size_px: Sequence[int] | None = None
    focal_px: float | None = None
    principal_px: Sequence[float] | None = None
    reference_mm: float | None = None
    near_mm: float | None = None
    far_mm: float | None = None
    radiant_dn_mm2: float | None = None
    quantization: Literal["device", "off"] | None = None
    depth_step_phase: float | None = None
    codes_per_step: int | None = None
    depth_cut_mm: float | None = None
    optics: Optics | None = None
    noise: Literal["off", "basic", "landau_2016", "device"] | Noise | None = None
    unit: str | Path | Unit | None = None
    pattern: Pattern | None = None
    matcher: Matcher | None = None
    believed: Calibration | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Pattern(Configuration):
    """Pattern, sensor.pattern of a scene.

    tile_columns: positions along a tile's rows; 16 to 512; default 211
    tile_rows: positions along a tile's columns; 16 to 512; default 165
    tiles_across: tiles side by side; 1 to 64; default 4
    tiles_down: tiles one below the other; 1 to 64; default 3
    step_px: angle between positions, in pixels of the depth image; 0.25 to 16; default 1
    dots_per_tile: positions of a tile that have a dot: 9 to 15 % of them; 1 to 39321; default 3861
    dot_sigma_ir_px: standard deviation of a dot's image, lens included; at most 1.2 step_px; 0.3 to 2; default 0.9
    zero_order: brightness of the spot in each tile's middle over that of a dot; 0 to 1000; default 1
    tile_spread: standard deviation of the tiles' brightness over their mean; 0 to 0.3; default 0
    seed: by which dots are placed; 0 to 1073741824; default 1
    image: a grey PNG of one's own pattern, relative to this file: a pixel for each position, instead of dots of our
        own; a path
    """

    tile_columns: int | None = None
    tile_rows: int | None = None
    tiles_across: int | None = None
    tiles_down: int | None = None
    step_px: float | None = None
    dots_per_tile: int | None = None
    dot_sigma_ir_px: float | None = None
    zero_order: float | None = None
    tile_spread: float | None = None
    seed: int | None = None
    image: str | Path | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Optics(Configuration):
    """Optics, sensor.optics of a scene.

    f_number: of the infrared camera, whose speckle has grains of the wavelength times this; 0.7 to 64; default 3.2
    pixel_um: pitch of the infrared camera's pixels; 0.5 to 50; default 5.2
    focus_mm: distance that the camera sees sharply; 0: all; 0 to 1000000; default 0
    beam_mm: width (4 standard deviations) of the projector's beams where they leave it; 0: rays; 0 to 5; default 0
    camera_k1: radial distortion of the camera; negative: barrel. Clouds are made as if there were none, as the device
        does; -0.2 to 0.2; default 0
    camera_k2: the same, with the fourth power of the radius; -0.2 to 0.2; default 0
    projector_k1: radial distortion of the projected pattern; positive: pincushion; -0.2 to 0.2; default 0
    """

    f_number: float | None = None
    pixel_um: float | None = None
    focus_mm: float | None = None
    beam_mm: float | None = None
    camera_k1: float | None = None
    camera_k2: float | None = None
    projector_k1: float | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Noise(Configuration):
    """Noise, sensor.noise of a scene.

    speckle_shape: of the Gamma distribution of the dots' brightness, at least 1; 0: none; from 0; default 0
    speckle_mean: mean of that distribution; above 0; default 1
    pixel_speckle: share of the light that is coherent and makes speckle on the pixels, with the grain of optics; 0 to
        1; default 0
    reference_speckle: the same in the reference image; 0 to 1; default 0
    speckle_renewed: share of the pixels' speckle that each frame draws anew; all frames of a scene have the rest in
        common; 0 to 1; default 0
    ambient_dn: ambient infrared light on albedo 1; from 0; default 0
    gain: of exposure and amplifier; above 0; default 1
    electrons_per_dn: at gain 1; shot noise has the variance signal × gain / this; 0: none; from 0; default 0
    read_dn: standard deviation of the detector's own noise; from 0; default 0
    offset_dn: mean of the detector's own noise; -1024 to 1024; default 0
    bloom_share: share of the light above saturation that spills to the pixels around; 0 to 1; default 0
    bloom_ir_px: mean distance along each axis that it spills; 0.5 to 64; default 4
    bits: of rounding and saturation; 0: none; 0 to 16; default 0
    disparity: noise of geometric captures, which have no image that noise could come from: statistics of measured
        desks; an object
    """

    speckle_shape: float | None = None
    speckle_mean: float | None = None
    pixel_speckle: float | None = None
    reference_speckle: float | None = None
    speckle_renewed: float | None = None
    ambient_dn: float | None = None
    gain: float | None = None
    electrons_per_dn: float | None = None
    read_dn: float | None = None
    offset_dn: float | None = None
    bloom_share: float | None = None
    bloom_ir_px: float | None = None
    bits: int | None = None
    disparity: DisparityNoise | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class DisparityNoise(Configuration):
    """Noise of geometric captures, sensor.noise.disparity of a scene.

    facing_px: standard deviation of the disparity of a surface that faces the sensor, far away; 0 to 4; default 0
    lateral_px: standard deviation of the random lateral displacement of what a pixel reads, along each axis; 0 to 16;
        default 0
    renewed: share of both variances that each frame draws anew; 0 to 1; default 0
    """

    facing_px: float | None = None
    lateral_px: float | None = None
    renewed: float | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Matcher(Configuration):
    """Matcher, sensor.matcher of a scene.

    method: precise: slopes and edges are followed; device: block correlation in steps of 1/8 px; precise, device;
        default precise
    window_columns: of the block, odd; 3 to 31; default 9
    window_rows: of the block, odd; 3 to 31; default 9
    disparity_min_px: least disparity of the search, from the reference plane; positive: nearer; -256 to 255; default
        -32
    disparity_max_px: largest disparity of the search; -255 to 256; default 63
    correlation_min: least zero-mean normalised cross-correlation of a match; 0 to 1; default 0.55
    contrast_min_dn: least standard deviation of a block; from 0; default 4
    relative_contrast_min: least ratio of standard deviation to mean in a block; device method only: light that is even,
        from outside or smeared within a body, takes the dots' contrast; 0 to 2; default 0
    compression_dn: blocks are compared after √(light + this), so that bright dots count for less; 0: after nothing;
        device method only; from 0; default 0
    hole_max_px: widest gap of a row that is filled when one surface lies on both sides; 0: none; 0 to 64; default 0
    """

    method: Literal["precise", "device"] | None = None
    window_columns: int | None = None
    window_rows: int | None = None
    disparity_min_px: int | None = None
    disparity_max_px: int | None = None
    correlation_min: float | None = None
    contrast_min_dn: float | None = None
    relative_contrast_min: float | None = None
    compression_dn: float | None = None
    hole_max_px: int | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Unit(Configuration):
    """Unit, sensor.unit of a scene.

    disparity_offset_px: constant bias of this device's disparities; -4 to 4; default 0
    wander_px: standard deviation of an error that all disparities of a frame share; 0 to 4; default 0
    disparity_sigma_px: spread of the disparity's zero from unit to unit; 0 to 4; default 0
    scale_sigma: relative spread of focal length times baseline; 0 to 0.1; default 0
    serial: which unit this is: it draws its errors and the speckle of its reference image; 0 to 1073741824; default 0
    residue_px: standard deviation over the image of this device's fixed disparity error, which differs from place to
        place; 0 to 4; default 0
    residue_reach_px: distance over which that error changes; 4 to 1000; default 70
    warm_up_px: additional disparity of a cold device; -4 to 4; default 0
    warm_up_s: time in which that falls to 1/e; above 0; default 940
    on_for_s: time since the unit was switched on, at frame 0; from 0; default 1000000000
    frame_interval_s: from frame to frame; above 0; default 0.0333333
    learned: a unit.json of fathom calibrate, relative to this file; its map of errors is added to those that are drawn;
        a path
    """

    disparity_offset_px: float | None = None
    wander_px: float | None = None
    disparity_sigma_px: float | None = None
    scale_sigma: float | None = None
    serial: int | None = None
    residue_px: float | None = None
    residue_reach_px: float | None = None
    warm_up_px: float | None = None
    warm_up_s: float | None = None
    on_for_s: float | None = None
    frame_interval_s: float | None = None
    learned: str | Path | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Calibration(Configuration):
    """Believed calibration, sensor.believed of a scene.

    baseline_mm: from the camera to the projector; above 0, at most 1000000; required
    focal_px: focal length; 1 to 1000000; required
    principal_px: principal point; [x, y], each -1000000 to 1000000; required
    """

    baseline_mm: float | None = None
    focal_px: float | None = None
    principal_px: Sequence[float] | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Desk(Configuration):
    """Desk, desk of a scene.

    albedo: share of the light that it scatters back; 0 to 1; default 0.55
    glaze: a clear coat, which mirrors; an object
    size_mm: along x and y; [x, y], each above 0, at most 1000000; default [1400, 1000]
    centre_mm: its middle; [x, y], each -1000000 to 1000000; default [0, 500]
    """

    albedo: float | None = None
    glaze: Glaze | None = None
    size_mm: Sequence[float] | None = None
    centre_mm: Sequence[float] | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Surface(Configuration):
    """A liquid's surface, cups[].surface of a scene.

    contact_angle_deg: of the meniscus at an upright wall, in the liquid: Young and Laplace's profile, up below 90°; 1
        to 179
    capillary_length_mm: of the liquid, beside contact_angle_deg; above 0, at most 1000000
    tilt_deg: of the surface, as a plane; 0 to 45; default 0
    tilt_azimuth_deg: direction in which it rises, from +x towards +y; any; default 0
    ripples: sines across the surface, which are added; a list of objects
    """

    contact_angle_deg: float | None = None
    capillary_length_mm: float | None = None
    tilt_deg: float | None = None
    tilt_azimuth_deg: float | None = None
    ripples: Sequence[Ripple] | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Ripple(Configuration):
    """Ripple, cups[].surface.ripples[] of a scene.

    wavelength_mm: from crest to crest; above 0, at most 1000000; required
    amplitude_mm: of the sine; 0 to 1000000; required
    azimuth_deg: direction in which the phase grows, from +x towards +y; any; default 0
    phase_deg: at the cup's axis; 0: level there, rising; any; default 0
    """

    wavelength_mm: float | None = None
    amplitude_mm: float | None = None
    azimuth_deg: float | None = None
    phase_deg: float | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Handle(Configuration):
    """Handle, cups[].shape.handle of a scene.

    low_mm: height where it leaves the wall; above 0, at most 2000; default 20
    high_mm: height where it joins the wall again; above 0, at most 2000; default 70
    reach_mm: how far its centre line stands out of the wall; above 0, at most 2000; default 30
    tube_radius_mm: radius of its section; above 0, at most 2000; default 5
    """

    low_mm: float | None = None
    high_mm: float | None = None
    reach_mm: float | None = None
    tube_radius_mm: float | None = None


@dataclass(kw_only=True, slots=True, repr=False)
class Glaze(Configuration):
    """Glaze, desk.glaze, cups[].glaze of a scene.

    roughness: α of the slopes of its facets (GGX); 0.02 to 1; required
    index: refractive index; 1 to 4; default 1.5
    """

    roughness: float | None = None
    index: float | None = None
