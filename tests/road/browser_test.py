#!/usr/bin/env python3
"""browser_test.py PROGRAM SAMPLES PACKAGES: the pages of the sample in a browser without a window.

Makes them at an eighth of the sample's size and has pages_in_browser.mjs look at them, with the npm packages in
PACKAGES. Skipped (status 77) where Chromium or Node.js is missing.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from browser import look_at_pages, missing_browser
from small_rig import write_small_rig

program, samples, packages = (Path(p).resolve() for p in sys.argv[1:4])
if missing_browser():
    print(f"skipped: {missing_browser()}")
    sys.exit(77)

with tempfile.TemporaryDirectory() as folder:
    rig = write_small_rig(samples / "three_plastics", folder)
    shots, out = f"{folder}/shots", f"{folder}/out"
    for words in (["simulate", rig, "--out", shots],
                  ["measure", shots, "--rig", rig, "--out", out],
                  ["check", shots, "--rig", rig, "--out", out],
                  ["compare", f"{out}/result.json", f"{out}/result.json", "--out", out],
                  ["plan", rig, "--out", out, "--patch-size", "2"]):
        done = subprocess.run([program, "--quiet", *words], capture_output=True, text=True, check=False)
        if done.returncode > 1:
            sys.exit(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    sys.exit(look_at_pages(packages, out, ["result", "check", "plan", "compare"]))
