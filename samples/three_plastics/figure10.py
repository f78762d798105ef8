#!/usr/bin/python3
"""Draws r(d) of a result's materials, as the paper's figure 10: figure10.py RESULT.json OUT.png

Points: what the shots show without a model, with 95 % intervals; lines: the dipole at the measured
values. Needs the Python package (see README.md) and python3-matplotlib.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import scattermeter


def main(result_path, picture_path):
    materials = scattermeter.values(scattermeter.read_result(result_path))
    figure, axes = plt.subplots(
        1, len(materials), figsize=(4.2 * len(materials), 3.8), sharey=True, squeeze=False
    )
    for axis, (name, channels) in zip(axes[0], materials.items()):
        for channel, colour in zip("RGB", ("#c0392b", "#1e8449", "#2471a3")):
            entry = channels.get(channel)
            if entry is None or entry["sigma_s_prime_per_mm"]["value"] is None:
                continue
            s = entry["sigma_s_prime_per_mm"]["value"]
            a = entry["sigma_a_per_mm"]["value"]
            knots = [k for k in entry.get("reflectance", {}).get("knots", []) if k["determined"]]
            d = np.array([k["distance_mm"] for k in knots])
            r = np.array([k["r_per_mm2"] for k in knots])
            if len(knots):
                ends = np.array([k["interval95_per_mm2"] for k in knots], dtype=float).T
                axis.errorbar(d, r, np.abs(ends - r), fmt="o", ms=3, lw=0.8, color=colour)
            fine = np.linspace(0, d.max() if len(knots) else 10, 400)
            refused = "" if entry["verdict"] == "ok" else " (refused)"
            axis.plot(
                fine,
                scattermeter.dipole_reflectance(fine, s, a, entry["eta"]),
                color=colour,
                label=f"{channel}: {s:.3g}, {a:.2g} per mm{refused}",
            )
        axis.set(title=name, xlabel="d (mm)", yscale="log")
        axis.legend(title="sigma_s', sigma_a", fontsize=8, title_fontsize=8)
    axes[0][0].set_ylabel("r(d) (1/mm²)")
    figure.tight_layout()
    figure.savefig(picture_path, dpi=120)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
