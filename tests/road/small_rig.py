"""The sample at an eighth of its resolution: PP under both LEDs on the cube only."""
import re
import shutil
from pathlib import Path


def small_rig(sample):
    """Text of the rig; its meshes stand beside it. sample: the folder samples/three_plastics."""
    text = (sample / "rig.yaml").read_text(encoding="utf-8")

    def eighth(px):
        return (float(px) + 0.5) / 8 - 0.5

    text = re.sub(r"image_px: \[([\d.]+), ([\d.]+)\]",
                  lambda m: f"image_px: [{eighth(m[1]):.3f}, {eighth(m[2]):.3f}]", text)
    text = text.replace("[3872, 2592]", "[484, 324]")
    text = re.sub(r"fx_px: 9836, fy_px: 9836, cx_px: [\d.]+, cy_px: [\d.]+",
                  f"fx_px: 1229.5, fy_px: 1229.5, cx_px: {eighth(1941.3):.3f}, cy_px: {eighth(1290.7):.3f}", text)
    text = re.sub(r"  - \{file: (?!PP_cube)[^}]*\}.*\n", "", text)
    return text.replace("point_std_px: 0.15", "point_std_px: 0.02")


def write_small_rig(sample, folder):
    """rig.yaml and its meshes in `folder`; returns the rig's path."""
    for name in ("cube.obj", "pyramid_on_pedestal.obj"):
        shutil.copy(sample / name, folder)
    path = Path(folder) / "rig.yaml"
    path.write_text(small_rig(sample), encoding="utf-8")
    return path
