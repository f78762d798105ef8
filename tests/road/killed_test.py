#!/usr/bin/env python3
"""killed_test.py PROGRAM SAMPLES KILLS KILLS_LONG: kill -9 at random moments of measure, simulate and calibrate.

No half file stands under a final name, and the next run completes with the digits of one that nobody
killed. Also: two runs on one folder at a time, a folder that can't be written, a file-size limit, names
with blanks, quotes, a newline and letters beyond ASCII, a rig behind a symbolic link.
"""
import filecmp
import hashlib
import json
import os
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from small_rig import write_small_rig

PROGRAM, SAMPLES = (Path(p).resolve() for p in sys.argv[1:3])
KILLS = int(sys.argv[4 if "SCATTERMETER_LONG" in os.environ else 3])
KILLS_OF_ATLAS = 50
LED = """
calibration:
  led:
    spheres:
      - {center_mm: [-24, -12, 8], radius_mm: 8, center_std_mm: 0.006}
      - {center_mm: [24, -14, 8], radius_mm: 8, center_std_mm: 0.006}
      - {center_mm: [-22, 16, 10], radius_mm: 8, center_std_mm: 0.006}
      - {center_mm: [23, 15, 8], radius_mm: 8, center_std_mm: 0.006}
    planes:
      - {origin_mm: [-30, -22, 0], size_mm: [60, 44], albedo: [0.9, 0.92, 0.88], albedo_relative_std: 0.005}
      - {origin_mm: [-30, -22, 15], size_mm: [60, 44], albedo: [0.9, 0.92, 0.88], albedo_relative_std: 0.005}
    shots:
      - {file: spheres_led1.dng, kind: spheres, light: led1}
      - {file: low_led1.dng, kind: plane, plane: 1, light: led1}
      - {file: high_led1.dng, kind: plane, plane: 2, light: led1}
"""


def files(folder):
    return sorted(p.relative_to(folder) for p in Path(folder).rglob("*") if p.is_file())


class Killed(unittest.TestCase):
    def setUp(self):
        self.home = Path(tempfile.mkdtemp(prefix="a 'name' \"of\"\nall kinds é "))
        self.addCleanup(shutil.rmtree, self.home, ignore_errors=True)
        self.rig = write_small_rig(SAMPLES / "three_plastics", self.home)
        with open(self.rig, "a", encoding="utf-8") as rig:
            rig.write(LED)
        self.shots = self.home / "shots"

    def run_program(self, *words, **options):
        return subprocess.run([PROGRAM, "-q", *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              check=False, **options)

    def simulate(self):
        done = self.run_program("simulate", self.rig, "--what", "all", "--out", self.shots)
        self.assertEqual(done.returncode, 0, done.stderr)

    def same(self, folder, other):
        """The same files; of JSON and HTML what does not tell of time and command."""
        self.assertEqual(files(folder), files(other))
        for path in files(folder):
            if path.suffix == ".json":
                a, b = (json.loads((f / path).read_text(encoding="utf-8"))["results"] for f in (folder, other))
                self.assertEqual(a, b)
            elif path.suffix == ".dng":
                self.assertTrue(filecmp.cmp(folder / path, other / path, shallow=False), path)

    def complete(self, path):
        """What stands under a final name is whole."""
        if path.suffix == ".json":
            json.loads(path.read_text(encoding="utf-8"))
        elif path.suffix == ".html":
            self.assertTrue(path.read_text(encoding="utf-8").rstrip().endswith("</html>"), path)
        elif path.suffix == ".dng":
            self.assertEqual(path.stat().st_size, self.raw_size, path)

    def kill_at_random(self, finals, *words):
        """KILLS runs into one folder, each killed; then one that is not, against one in a new folder.

        With SCATTERMETER_LONG set, KILLS_LONG runs.
        """
        fresh, out = self.home / "fresh", self.home / "again"
        began = time.monotonic()
        first = self.run_program(*words, "--out", fresh / finals)
        self.assertIn(first.returncode, (0, 1), first.stderr)
        takes = time.monotonic() - began
        draw = random.Random(7)
        killed = 0
        for _ in range(KILLS):
            run = subprocess.Popen([PROGRAM, "-q", *words, "--out", out / finals], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
            time.sleep(draw.uniform(0, takes))
            run.kill()
            killed += run.wait() < 0
            for path in files(out) if out.exists() else []:
                if (fresh / path).exists():  # a final name
                    self.complete(out / path)
        self.assertGreater(killed, 0)
        last = self.run_program(*words, "--out", out / finals)
        self.assertEqual(last.returncode, first.returncode, last.stderr)
        for path in set(files(out)) - set(files(fresh)):  # what the killed had begun
            (out / path).unlink()
        self.same(out, fresh)

    def test_simulate(self):
        self.simulate()
        self.raw_size = max(p.stat().st_size for p in self.shots.iterdir())
        self.kill_at_random(".", "simulate", self.rig)

    def test_measure(self):
        self.simulate()
        self.kill_at_random(".", "measure", self.shots, "--rig", self.rig, "--model", "dipole")

    def test_calibrate(self):
        self.simulate()
        self.kill_at_random("leds", "calibrate", "led", self.shots, "--rig", self.rig)

    def paths_of_transport(self, folder):
        """By file: levels and content. All are whole."""
        out = {}
        for path in files(folder):
            if path.suffix == ".paths":
                content = (folder / path).read_bytes()
                digest, content = content[:64].decode(), content[64:]
                self.assertEqual(hashlib.sha256(content).hexdigest(), digest, path)
                out[path] = (struct.unpack_from("<q", content, 8)[0], content)
        return out

    @unittest.skipUnless("SCATTERMETER_LONG" in os.environ, "only with --long")
    def test_atlas(self):
        """Killed many times while paths are traced, which go on where they were, with the same digits."""
        self.simulate()
        words = ["measure", self.shots, "--rig", self.rig, "--model", "transport", "--material", "PP", "--channels",
                 "G", "--paths", "300000", "--time-limit", "1000"]
        began = time.monotonic()
        first = self.run_program(*words, "--out", self.home / "fresh")
        self.assertIn(first.returncode, (0, 1), first.stderr)
        takes = time.monotonic() - began
        alone = self.paths_of_transport(self.home / "fresh" / "atlas")
        self.assertTrue(alone)
        draw = random.Random(8)
        levels, killed, folder = {}, 0, 0
        while killed < KILLS_OF_ATLAS:
            out = self.home / f"again{folder}"
            run = subprocess.Popen([PROGRAM, "-q", *words, "--out", out], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
            time.sleep(draw.uniform(0, takes))
            run.kill()
            if run.wait() < 0:
                killed += 1
            else:  # all is traced: begin anew
                folder += 1
            for path, (level, content) in self.paths_of_transport(out / "atlas").items() if out.exists() else []:
                self.assertGreaterEqual(level, levels.get((out, path), 0), path)  # nothing is lost
                levels[out, path] = level
                if path in alone and alone[path][0] == level:
                    self.assertEqual(alone[path][1], content, path)
        equal = 0
        for out in {out for out, _ in levels}:
            last = self.run_program(*words, "--out", out)
            self.assertEqual(last.returncode, first.returncode, last.stderr)
            again = self.paths_of_transport(out / "atlas")
            equal += sum(again.get(path) == node for path, node in alone.items())
        print(f"{killed} killed; {equal} nodes with equal paths and equal digits")
        self.assertGreater(equal, 0)

    def test_two_at_a_time_behind_a_link(self):
        self.simulate()
        link = self.home / "elsewhere" / "link.yaml"
        link.parent.mkdir()
        link.symlink_to(self.rig)
        for mesh in self.home.glob("*.obj"):  # beside the link, as paths are relative to the rig's folder
            (link.parent / mesh.name).symlink_to(mesh)
        words = [PROGRAM, "-q", "measure", self.shots, "--model", "dipole"]
        runs = [subprocess.Popen([*words, "--rig", rig, "--out", self.home / "both"]) for rig in (self.rig, link)]
        self.assertEqual([r.wait() for r in runs], [0, 0])
        alone = self.run_program(*words[2:], "--rig", self.rig, "--out", self.home / "alone")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        self.same(self.home / "both", self.home / "alone")

    def test_no_room(self):
        self.simulate()
        small = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
        out = self.home / "out"
        done = self.run_program("measure", self.shots, "--rig", self.rig, "--model", "dipole", "--out", out,
                                preexec_fn=small)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("result.json", done.stderr)
        self.assertEqual(files(out), [])
        blocked = self.home / "file"
        blocked.write_text("no folder", encoding="utf-8")
        done = self.run_program("measure", self.shots, "--rig", self.rig, "--model", "dipole", "--out", blocked)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("file", done.stderr)
        self.assertEqual(blocked.read_text(encoding="utf-8"), "no folder")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
