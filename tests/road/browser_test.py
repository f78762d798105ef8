#!/usr/bin/env python3
"""browser_test.py PROGRAM SAMPLES PACKAGES: the pages in a browser without a window.

Makes the pages of the sample at an eighth of its size and has browser_test.mjs look at them, with the npm
packages in PACKAGES. Skipped (status 77) where Chromium or Node.js is missing.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from small_rig import write_small_rig

program, samples, packages = (Path(p).resolve() for p in sys.argv[1:4])
browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
node = shutil.which("node")
if not browser or not node:
    print("skipped: Chromium or Node.js is not installed")
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
    test = Path(__file__).with_suffix(".mjs")
    sys.exit(subprocess.run([node, test, packages, browser, out], check=False).returncode)
