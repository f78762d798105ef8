"""Scattering and absorption of translucent materials, from raw camera shots.

Lengths are mm, coefficients 1/mm. The functions call the library in this process: no program is
started, Ctrl-C ends long work, and `progress` is called with the steps done. Bad input raises
InputError with a message that names file, field and value; a missing file or folder raises
FileNotFoundError.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence

from . import _native
from ._native import (
    InputError,
    __version__,
    dipole_reflectance,
    dipole_total_reflectance,
    fresnel_transmittance,
    half_space_albedo,
)
from ._result import PathLike, Result, read_result, values

__all__ = [
    "InputError",
    "Result",
    "__version__",
    "calibrate_camera",
    "calibrate_led",
    "calibrate_radiance",
    "check",
    "dipole_reflectance",
    "dipole_total_reflectance",
    "estimate",
    "export",
    "fresnel_transmittance",
    "half_space_albedo",
    "measure",
    "plan",
    "read_result",
    "simulate",
    "values",
]

ProgressCallback = Callable[[str, int, int], None]


def measure(
    shots: PathLike,
    rig: PathLike,
    *,
    out: Optional[PathLike] = None,
    model: str = "auto",
    patch_size_mm: Optional[float] = None,
    time_limit_s: float = 50.0,
    materials: Sequence[str] = (),
    channels: str = "",
    cache: Optional[PathLike] = None,
    threads: Optional[int] = None,
    progress: Optional[ProgressCallback] = None,
) -> Result:
    """Measure the materials in a folder of raw shots.

    shots: folder of the raws. rig: the rig file (YAML). out: folder for result.json (default: none
    is written). model: auto, dipole, transport or paper. patch_size_mm: edge of the surface
    patches, mm. time_limit_s: limit for transport, s per material and channel. materials, channels:
    only these (letters of "RGB"). cache: folder for decoded shots. threads: all cores by default.
    progress: called with (stage, steps done, steps in total). The verdict and reasons of an entry
    show whether its value is refused.
    """
    text = _native.measure(
        os.fspath(shots),
        os.fspath(rig),
        model,
        patch_size_mm,
        time_limit_s,
        list(materials),
        channels,
        os.fspath(cache) if cache is not None else "",
        threads,
        progress,
    )
    if out is not None:
        _write(Path(out) / "result.json", text)
    return Result(json.loads(text))


def check(
    shots: PathLike, rig: PathLike, *, progress: Optional[ProgressCallback] = None
) -> Dict[str, Any]:
    """Check whether the setup is consistent: the residual of every calibration and its limit.

    shots: folder of the raws. rig: the rig file. Returns the content of check.json.
    """
    content: Dict[str, Any] = json.loads(_native.check(os.fspath(shots), os.fspath(rig), progress))
    return content


def simulate(
    rig: PathLike,
    out: PathLike,
    *,
    transport: str = "dipole",
    paths: int = 1_000_000,
    seed: int = 1,
    noise: bool = True,
    progress: Optional[ProgressCallback] = None,
) -> List[Path]:
    """Make simulated raw shots of a rig's truth materials.

    out: folder for the DNG files, created if missing. transport: dipole or volume (Monte Carlo, with
    `paths` light paths for each light of a shot and channel). Returns the paths of the files.
    """
    if transport not in ("dipole", "volume"):
        raise ValueError(f"transport: expected dipole or volume, got {transport!r}")
    written = _native.simulate(
        os.fspath(rig), os.fspath(out), transport == "volume", paths, seed, noise, progress
    )
    return [Path(path) for path in written]


def plan(
    rig: PathLike, *, other_shots: bool = True, progress: Optional[ProgressCallback] = None
) -> Dict[str, Any]:
    """Predict the uncertainty of what a rig's shots will measure, before they are taken.

    other_shots: also suggest further shots. Returns the content of plan.json.
    """
    content: Dict[str, Any] = json.loads(_native.plan(os.fspath(rig), other_shots, progress))
    return content


def calibrate_camera(
    shots: PathLike, rig: PathLike, out: PathLike, *, progress: Optional[ProgressCallback] = None
) -> Path:
    """Calibrate the lens from the board shots of the rig's calibration.camera.

    Writes the YAML file `out`, which camera.intrinsics of a rig may name, and returns its path.
    """
    return _write(Path(out), _native.calibrate_camera(os.fspath(shots), os.fspath(rig), progress))


def calibrate_led(
    shots: PathLike,
    rig: PathLike,
    light: str,
    out: PathLike,
    *,
    progress: Optional[ProgressCallback] = None,
) -> Path:
    """Calibrate one LED from the spheres and planes of the rig's calibration.led.

    Writes the YAML file `out`, which lights.NAME.calibration of a rig may name, and returns its path.
    """
    text = _native.calibrate_led(os.fspath(shots), os.fspath(rig), light, progress)
    return _write(Path(out), text)


def calibrate_radiance(
    shots: PathLike, rig: PathLike, out: PathLike, *, progress: Optional[ProgressCallback] = None
) -> Path:
    """Calibrate the sensor from the dark frames and flats of the rig's calibration.radiance.

    Writes the YAML file `out`, which camera.radiance of a rig may name, and returns its path.
    """
    return _write(Path(out), _native.calibrate_radiance(os.fspath(shots), os.fspath(rig), progress))


def export(
    result: PathLike,
    format: str,
    out: PathLike,
    *,
    materials: Sequence[str] = (),
    mm_per_unit: Optional[float] = None,
    g: float = 0.0,
) -> Path:
    """Write measured materials as a renderer's material or as a table; returns the path.

    result: a result.json. format: mitsuba, pbrt, blender, openpbr, materialx or csv. materials: only
    these. mm_per_unit: length of a scene unit, mm (default: that of the format). g: mean cosine of the
    phase function to write, -1 < g < 1. A refused channel raises InputError (csv: its row has the
    verdict and no values).
    """
    _native.export(os.fspath(result), format, os.fspath(out), list(materials), mm_per_unit, g)
    return Path(out)


def estimate(
    camera: Mapping[str, Any],
    objects: Mapping[str, Mapping[str, Any]],
    lights: Mapping[str, Mapping[str, Any]],
    shots: Sequence[Mapping[str, Any]],
    *,
    model: str = "dipole",
    patch_size_mm: Optional[float] = None,
    time_limit_s: float = 50.0,
    even_light_share_std: float = 0.003,
    progress: Optional[ProgressCallback] = None,
) -> Result:
    """Estimate materials from linear images given as arrays, without any file.

    camera: image_size_px (2), fx_px, fy_px, cx_px, cy_px; optional distortion (0, 4, 5 or 8 terms of
    OpenCV's model), cfa ("RGGB" and so on), responsivity_counts_mm2_sr_per_W_s (3) and
    responsivity_relative_std; without a responsivity the scale is free.
    objects, by name: vertices_mm (n, 3) and triangles (m, 3) of a closed mesh in the world frame,
    counter-clockwise from outside; eta; optional eta_std (0.01), g (0; of Henyey and Greenstein),
    gamma_std (0.55; with g: 0.1), position_std_mm (0.1), scale_relative_std (0.002),
    edge_std_mm (0.1) and surface_alpha_std (0.03; of a smooth surface's gloss).
    lights, by name, LEDs: position_mm (3), axis (3), intensity_W_per_sr (3); optional exponent
    or lobe ({angle_deg, relative} or {angle_deg, relative_x, relative_y, x_axis}), radius_mm,
    position_std_mm (0.3), axis_std_deg (1), exponent_std (0.05), intensity_relative_std (0.01).
    shots, each: object, material, lights (names), camera_from_world (4, 4; OpenCV's axes, mm),
    exposure_s, and for each of its n samples xy_px (n, 2; column and row in the frame), value_counts
    (n; above black) and variance_counts2 (n); optional name, pose_covariance (6, 6; rad and mm) and
    variance_per_count (of photon noise, 1 / gain). Other samples are not used.
    even_light_share_std: of unlisted even light, as a share of the LEDs' irradiance.
    Standard deviations that are not given are those of a careful user's rig, as in a rig file; 0
    states a value as exact.
    """
    text = _native.estimate(
        dict(camera),
        {name: dict(value) for name, value in objects.items()},
        {name: dict(value) for name, value in lights.items()},
        [dict(shot) for shot in shots],
        model,
        patch_size_mm,
        time_limit_s,
        even_light_share_std,
        progress,
    )
    return Result(json.loads(text))


def _write(path: Path, text: str) -> Path:
    """Write the file by rename, so that it appears complete or not at all."""
    _native.write_text_file(os.fspath(path), text)
    return path
