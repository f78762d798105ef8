"""Needs PYTHONPATH at the built package."""

import math
import pathlib

import numpy as np
import pytest

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "samples" / "three_plastics"

FOCAL_PX, CENTRE_PX = 1229.5, (241.8, 161.2)
CAMERA_MM, TARGET_MM = np.array([0.0, -100.0, 150.0]), np.array([0.0, 0.0, 9.0])
MARKS_MM = [
    (-26, -14, 0), (26, -14, 0), (26, 20, 0), (-26, 20, 0),
    (0, -16, 0), (-28, -8, 12), (28, -8, 12), (24, 16, 15),
]  # fmt: skip


def image_px(point_mm):
    """Where a camera without distortion, upright, sees a point."""
    forward = (TARGET_MM - CAMERA_MM) / np.linalg.norm(TARGET_MM - CAMERA_MM)
    right = np.cross(forward, (0, 0, 1))
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    d = np.asarray(point_mm) - CAMERA_MM
    depth = d @ forward
    assert math.isfinite(depth) and depth > 0
    return [
        CENTRE_PX[0] + FOCAL_PX * (d @ right) / depth,
        CENTRE_PX[1] + FOCAL_PX * (d @ down) / depth,
    ]


@pytest.fixture(scope="session")
def rig(tmp_path_factory):
    """A cube under one LED, seen at an eighth of the sample's resolution."""
    folder = tmp_path_factory.mktemp("rig")
    (folder / "cube.obj").write_bytes((SAMPLES / "cube.obj").read_bytes())
    points = "".join(
        f"    - {{world_mm: {list(mark)}, image_px: {image_px(mark)}}}\n" for mark in MARKS_MM
    )
    path = folder / "rig.yaml"
    path.write_text(
        f"""scattermeter_rig: 1
camera:
  image_size_px: [484, 324]
  intrinsics: {{fx_px: {FOCAL_PX}, fy_px: {FOCAL_PX}, cx_px: {CENTRE_PX[0]}, cy_px: {CENTRE_PX[1]}}}
  responsivity_counts_mm2_sr_per_W_s: [2.4e10, 2.9e10, 2.1e10]
  responsivity_relative_std: 0.01
  exposure_s: 0.05
pose:
  points:
{points}objects:
  cube: {{mesh: cube.obj, eta: 1.4}}
lights:
  led: {{type: led, position_mm: [30, -60, 80], axis: [-30, 60, -70], intensity_W_per_sr: [0.05, 0.05, 0.05]}}
shots:
  - {{file: POM.dng, object: cube, material: POM, lights: [led]}}
truth:
  materials:
    POM: {{sigma_s_prime_per_mm: [1.4, 1.6, 1.75], sigma_a_per_mm: [0.002, 0.004, 0.008]}}
"""
    )
    return path
