#!/usr/bin/env python3
"""ranks_test.py PROGRAM SAMPLES: one Monte Carlo, of raws or of pictures, by 1, 2 and 4 ranks of Open MPI.

The files are those of a run without mpirun, byte by byte; one rank writes and speaks; an error of one
rank is told once and ends all. Status 77: mpirun is not there.
"""
import filecmp
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from small_rig import write_small_rig

PROGRAM, SAMPLES = (Path(p).resolve() for p in sys.argv[1:3])
VOLUME = ["--transport", "volume", "--paths", "6400", "--seed", "5"]


def run(*words, **options):
    return subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False, **options)


def mpirun(ranks, *words, **options):
    return run("mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks, *words, **options)


def own_lines(text):
    """What the program says, not mpirun."""
    return [line for line in text.splitlines() if line.startswith("scattermeter: ")]


class RanksShareThePaths(unittest.TestCase):
    def setUp(self):
        self.home = Path(tempfile.mkdtemp(prefix="ranks "))
        self.addCleanup(shutil.rmtree, self.home, ignore_errors=True)
        self.rig = write_small_rig(SAMPLES / "three_plastics", self.home)

    def test_same_bytes(self):
        alone = run(PROGRAM, "simulate", self.rig, *VOLUME, "--out", self.home / "alone")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        names = sorted(p.name for p in (self.home / "alone").iterdir())
        self.assertEqual(names, ["PP_cube_1.dng", "PP_cube_2.dng"])
        other = run(PROGRAM, "simulate", self.rig, *VOLUME[:-1], "6", "--out", self.home / "other")
        self.assertEqual(other.returncode, 0, other.stderr)
        self.assertFalse(filecmp.cmp(self.home / "alone" / names[0], self.home / "other" / names[0], shallow=False))
        for ranks in (1, 2, 4):
            out = self.home / f"by {ranks}"
            done = mpirun(ranks, PROGRAM, "simulate", self.rig, *VOLUME, "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.replace(str(out), ""), alone.stdout.replace(str(self.home / "alone"), ""))
            self.assertEqual(sorted(p.name for p in out.iterdir()), names)
            for name in names:
                self.assertTrue(filecmp.cmp(self.home / "alone" / name, out / name, shallow=False), (ranks, name))

    def test_rendered_pictures_are_the_same_bytes(self):
        shots, result = self.home / "shots", self.home / "result"
        done = run(PROGRAM, "-q", "simulate", self.rig, "--out", shots)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run(PROGRAM, "-q", "measure", shots, "--rig", self.rig, "--out", result, "--model", "dipole")
        self.assertEqual(done.returncode, 0, done.stderr)
        words = [PROGRAM, "render", self.rig, "--result", result / "result.json", "--model", "transport",
                 "--width", "96", "--paths", "6400", "--out", "pictures"]
        said = set()
        for ranks in (0, 1, 2, 4):  # 0: without mpirun
            place = self.home / f"render by {ranks}"
            place.mkdir()
            done = mpirun(ranks, *words, cwd=place) if ranks else run(*words, cwd=place)
            self.assertEqual(done.returncode, 0, done.stderr)
            said.add(done.stdout)
        self.assertEqual(len(said), 1, said)
        alone = self.home / "render by 0" / "pictures"
        names = sorted(p.name for p in alone.iterdir())
        self.assertEqual({Path(n).suffix for n in names}, {".exr", ".png", ".csv"})
        for ranks in (1, 2, 4):
            other = self.home / f"render by {ranks}" / "pictures"
            self.assertEqual(sorted(p.name for p in other.iterdir()), names)
            for name in names:
                self.assertTrue(filecmp.cmp(alone / name, other / name, shallow=False), (ranks, name))
        # Noise of other paths shows in the pictures: what is compared is the Monte Carlo.
        place = self.home / "other seed"
        place.mkdir()
        self.assertEqual(run(*words, "--seed", "2", cwd=place).returncode, 0)
        picture = next(n for n in names if n.endswith(".exr"))
        self.assertFalse(filecmp.cmp(alone / picture, place / "pictures" / picture, shallow=False))

    def test_an_error_of_all_is_told_once(self):
        (self.home / "cube.obj").unlink()
        done = mpirun(2, PROGRAM, "simulate", self.rig, *VOLUME, "--out", self.home / "out")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
        self.assertIn("cube.obj", own_lines(done.stderr)[0])

    def one_rank_differs(self, rank, rig):
        script = f'[ "$OMPI_COMM_WORLD_RANK" = {rank} ] && rig=$2 || rig=$1; shift 2; program=$1; shift; ' \
                 'exec "$program" simulate "$rig" "$@"'
        return mpirun(4, "sh", "-c", script, "sh", self.rig, rig, PROGRAM, *VOLUME, "--out", self.home / "out")

    def test_an_error_of_one_ends_all(self):
        for rank in (0, 2):
            done = self.one_rank_differs(rank, self.home / "nowhere.yaml")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
            self.assertIn("nowhere.yaml", own_lines(done.stderr)[0])
            self.assertEqual(done.stdout, "")
            self.assertFalse((self.home / "out").exists())

    def test_ranks_with_other_input_are_told(self):
        text = self.rig.read_text(encoding="utf-8")
        other = self.home / "other.yaml"
        changed = text.replace("PP: {sigma_s_prime_per_mm: [0.62,", "PP: {sigma_s_prime_per_mm: [0.63,")
        self.assertNotEqual(changed, text)
        other.write_text(changed, encoding="utf-8")
        done = self.one_rank_differs(1, other)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
        self.assertIn("the ranks do not do the same", own_lines(done.stderr)[0])
        self.assertFalse((self.home / "out").exists())

    def test_commands_that_share_nothing_are_refused(self):
        done = mpirun(2, PROGRAM, "measure", self.home, "--rig", self.rig, "--out", self.home / "out")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
        self.assertIn("one process", own_lines(done.stderr)[0])


if __name__ == "__main__":
    if shutil.which("mpirun") is None:
        print("skipped: mpirun is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
