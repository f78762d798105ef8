"""Estimates on arrays that NumPy made: the dipole summed over a cube, pixel by pixel."""

import numpy as np
import pytest

import scattermeter
from conftest import CAMERA_MM, TARGET_MM

HALF_MM, ETA = 10.0, 1.4
LED_MM = np.array([30.0, -60.0, 80.0])
LED_AXIS = np.array([-30.0, 60.0, -70.0]) / np.linalg.norm([-30, 60, -70])
INTENSITY = 0.5  # W/sr on the axis; falls with the cosine
FOCAL_PX, SIZE_PX = 700.0, (240, 180)
RESPONSIVITY, EXPOSURE_S = np.array([2.4e10, 2.9e10, 2.1e10]), 0.05
TRUTH = {"R": (1.0, 0.004), "G": (1.1, 0.01), "B": (1.2, 0.03)}
# Faces that the LED lights and the camera sees: a point of the face, its two tangents, its normal.
X, Y, Z = np.eye(3)
FACES = [
    (2 * HALF_MM * Z, X, Y, Z),
    (HALF_MM * Z - HALF_MM * Y, X, Z, -Y),
    (HALF_MM * Z + HALF_MM * X, Y, Z, X),
]


def transmittance(cosine):
    """Unpolarised Fresnel transmittance into the body."""
    inside = np.sqrt(1 - (1 - cosine**2) / ETA**2)
    s = (cosine - ETA * inside) / (cosine + ETA * inside)
    p = (ETA * cosine - inside) / (ETA * cosine + inside)
    return 1 - (s**2 + p**2) / 2


def sources(edge_mm):
    """Centres of the lit faces' cells, mm, and the power that enters each, W."""
    steps = np.arange(-HALF_MM + edge_mm / 2, HALF_MM, edge_mm)
    u, v = (t.ravel()[:, None] for t in np.meshgrid(steps, steps))
    points, powers = [], []
    for origin, tangent, bitangent, normal in FACES:
        at = origin + u * tangent + v * bitangent
        to_led = LED_MM - at
        distance = np.linalg.norm(to_led, axis=1)
        cosine = to_led @ normal / distance
        off_axis = -(to_led @ LED_AXIS) / distance
        entering = INTENSITY * off_axis * np.clip(cosine, 0, None) / distance**2
        points.append(at)
        powers.append(entering * transmittance(np.clip(cosine, 1e-9, None)) * edge_mm**2)
    return np.concatenate(points), np.concatenate(powers)


def camera_from_world():
    forward = (TARGET_MM - CAMERA_MM) / np.linalg.norm(TARGET_MM - CAMERA_MM)
    right = np.cross(forward, Z) / np.linalg.norm(np.cross(forward, Z))
    pose = np.eye(4)
    pose[:3, :3] = [right, np.cross(forward, right), forward]
    pose[:3, 3] = -pose[:3, :3] @ CAMERA_MM
    return pose


def seen_pixels(pose):
    """Pixels within a lit face: x and y, the point there, and the cosine."""
    x, y = (t.ravel() for t in np.meshgrid(np.arange(SIZE_PX[0]), np.arange(SIZE_PX[1])))
    rays = np.stack([(x - 120) / FOCAL_PX, (y - 90) / FOCAL_PX, np.ones(x.size)], axis=1)
    rays = rays @ pose[:3, :3]
    rays /= np.linalg.norm(rays, axis=1)[:, None]
    xy, points, cosines = [], [], []
    for origin, tangent, bitangent, normal in FACES:
        cosine = -(rays @ normal)
        if not (cosine > 0.05).all():
            continue
        at = CAMERA_MM + ((origin - CAMERA_MM) @ normal / -cosine)[:, None] * rays
        inside = np.maximum(*(np.abs((at - origin) @ t) for t in (tangent, bitangent)))
        keep = inside < HALF_MM - 0.1
        xy.append(np.stack([x[keep], y[keep]], axis=1))
        points.append(at[keep])
        cosines.append(cosine[keep])
    return np.concatenate(xy), np.concatenate(points), np.concatenate(cosines)


def dipole_sum(points, at, power, s, a):
    out = np.empty(len(points))
    for start in range(0, len(points), 200):
        part = points[start : start + 200]
        d2 = (part**2).sum(1)[:, None] + (at**2).sum(1) - 2 * part @ at.T
        d = np.sqrt(np.clip(d2, 0, None))
        out[start : start + 200] = scattermeter.dipole_reflectance(d, s, a, ETA) @ power
    return out


@pytest.fixture(scope="module")
def given():
    pose = camera_from_world()
    xy, points, cosine = seen_pixels(pose)
    at, power = sources(0.5)
    random = np.random.default_rng(7)
    counts = np.zeros(len(xy))
    site = "RGGB"
    channel = np.array([site[2 * (y % 2) + x % 2] for x, y in xy])
    for c, (name, (s, a)) in enumerate(TRUTH.items()):
        of = channel == name
        radiance = transmittance(cosine[of]) / np.pi * dipole_sum(points[of], at, power, s, a)
        counts[of] = RESPONSIVITY[c] * EXPOSURE_S * radiance
    variance = counts / 4 + 4  # 4 electrons a count, 2 counts of read noise
    counts += random.normal(size=len(counts)) * np.sqrt(variance)
    corners = [(x, y, z) for z in (0, 20) for x, y in ((-10, -10), (10, -10), (10, 10), (-10, 10))]
    quads = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    return {
        "camera": {
            "image_size_px": SIZE_PX,
            "fx_px": FOCAL_PX,
            "fy_px": FOCAL_PX,
            "cx_px": 120,
            "cy_px": 90,
            "responsivity_counts_mm2_sr_per_W_s": RESPONSIVITY,
            "responsivity_relative_std": 0.002,
        },
        "objects": {
            "cube": {
                "vertices_mm": np.array(corners, float),
                "triangles": np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]),
                "eta": ETA,
                "eta_std": 0.0,
                "position_std_mm": 0.0,
                "scale_relative_std": 0.0,
                "edge_std_mm": 0.0,
            }
        },
        "lights": {
            "led": {
                "position_mm": LED_MM,
                "axis": LED_AXIS,
                "intensity_W_per_sr": [INTENSITY] * 3,
                "position_std_mm": 0.0,
                "axis_std_deg": 0.0,
                "exponent_std": 0.0,
                "intensity_relative_std": 0.0,
            }
        },
        "even_light_share_std": 0.0,
        "shots": [
            {
                "object": "cube",
                "material": "POM",
                "lights": ["led"],
                "camera_from_world": pose,
                "exposure_s": EXPOSURE_S,
                "xy_px": xy,
                "value_counts": counts,
                "variance_counts2": variance,
                "variance_per_count": 0.25,
            }
        ],
    }


def test_estimate_finds_the_truth_in_arrays(given):
    stages = set()
    result = scattermeter.estimate(**given, progress=lambda stage, *_: stages.add(stage))
    pom = scattermeter.values(result)["POM"]
    for channel, truth in TRUTH.items():
        entry = pom[channel]
        assert entry["verdict"] == "ok"
        for key, value, worst in zip(("sigma_s_prime_per_mm", "sigma_a_per_mm"), truth, (0.02, 0.04)):
            assert entry[key]["value"] == pytest.approx(value, rel=worst), (channel, key)
            assert abs(entry[key]["value"] - value) < 4 * entry[key]["std"], (channel, key)
    assert stages


def test_nothing_is_exact_unless_stated(given):
    def without_deviations(table):
        return {name: {k: v for k, v in item.items() if "_std" not in k} for name, item in table.items()}

    def budget(result):
        return {cause["cause"] for cause in result["results"][0]["budget"]}

    rig = dict(
        given,
        lights=without_deviations(given["lights"]),
        objects=without_deviations(given["objects"]),
    )
    del rig["even_light_share_std"]
    default = scattermeter.estimate(**rig)
    uncertain = {"LED position", "LED axis", "LED exponent", "LED power"}
    uncertain |= {"mesh position", "mesh scale", "even light"}
    assert uncertain | {"eta", "edges"} <= budget(default)
    assert not uncertain & budget(scattermeter.estimate(**given))
    pom = scattermeter.values(default)["POM"]
    for channel, truth in TRUTH.items():
        for key, value in zip(("sigma_s_prime_per_mm", "sigma_a_per_mm"), truth):
            assert abs(pom[channel][key]["value"] - value) < 3 * pom[channel][key]["std"]


def test_a_deviation_below_0_is_refused(given):
    led = dict(given["lights"]["led"], position_std_mm=-0.1)
    with pytest.raises(scattermeter.InputError, match="lights.led.position_std_mm"):
        scattermeter.estimate(**dict(given, lights={"led": led}))


def test_a_lobe_without_planes_is_refused(given):
    lobe = {"angle_deg": [0, 90], "relative_x": [1, 0], "relative_y": [1, 0], "x_axis": LED_AXIS}
    led = dict(given["lights"]["led"], lobe=lobe)
    with pytest.raises(scattermeter.InputError, match="lights.led.lobe.x_axis"):
        scattermeter.estimate(**dict(given, lights={"led": led}))


def test_samples_of_another_length_are_refused(given):
    shot = dict(given["shots"][0], variance_counts2=np.ones(2))
    with pytest.raises(scattermeter.InputError, match="differ in length"):
        scattermeter.estimate(**dict(given, shots=[shot]))


def test_an_unknown_object_is_named(given):
    shot = dict(given["shots"][0], object="sphere")
    with pytest.raises(scattermeter.InputError, match=r"shots.shot 0.object: sphere"):
        scattermeter.estimate(**dict(given, shots=[shot]))


def test_a_missing_field_is_named():
    with pytest.raises(scattermeter.InputError, match="camera.image_size_px: is missing"):
        scattermeter.estimate({}, {}, {}, [])
