#!/usr/bin/env python3
"""pages_test.py SOURCE: the documents say what the program says.

Every message that samples/first_measurement quotes stands in the sources, every reason for a refusal
in the sources stands on that page, and its tables are those of the CSV files. The links of all
documents lead somewhere, and the README names every command.
"""
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
FOLDER = SOURCE / "samples" / "first_measurement"
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")
LITERAL = r'"(?:[^"\\\n]|\\.)*"'


def literals(text):
    """String literals, those that the compiler joins as one."""
    text = re.sub(r"(?m)^\s*//.*$", "", text)
    return ["".join(part[1:-1] for part in re.findall(LITERAL, run)).replace('\\"', '"')
            for run in re.findall(rf"{LITERAL}(?:\s*{LITERAL})*", text)]


def said():
    """All that the program may say."""
    return [words for folder in ("core", "capture", "calib", "apps")
            for path in sorted((SOURCE / folder).rglob("*.cc"))
            for words in literals(path.read_text(encoding="utf-8"))]


class Page(unittest.TestCase):
    def quoted(self):
        """Code in the tables under the headings on messages."""
        start, end = PAGE.index("## What the verdict means"), PAGE.index("## How good the numbers are")
        for line in PAGE[start:end].splitlines():
            if line.startswith("| ") and not line.startswith("|---"):
                cells = line.strip("|").split("|")
                # Messages stand in the first cell, advice of `check` in the second.
                for cell in cells[:1] if "`" in cells[0] else cells[1:]:
                    yield from re.findall(r"`([^`]*)`", cell)

    def test_messages_are_the_programs(self):
        everything = said()
        quoted = list(self.quoted())
        self.assertGreater(len(quoted), 30)
        for message in quoted:
            for part in re.split("…", message):
                if len(part.strip()) > 3:
                    self.assertTrue(any(part.strip() in words for words in everything), f"{part!r} of {message!r}")

    def test_every_reason_stands_on_the_page(self):
        quoted = "\n".join(self.quoted())
        for path in ("core/fit/estimate.cc", "core/fit/dipole_fit.cc",
                     "core/estimation/transport_verdict.cc"):
            text = (SOURCE / path).read_text(encoding="utf-8")
            reasons = re.findall(rf"(?:reasons\.push_back|add_once)\(\s*(?:sentence\(|fmt::format\()?\s*({LITERAL}(?:\s*{LITERAL})*)",
                                 text)
            self.assertGreater(len(reasons), 3, path)
            for reason in reasons:
                words = re.split(r"[{(]", literals(reason)[0])[0].strip()
                if words == "the image or its prediction contains values that are not finite":
                    continue  # a defect, not a user's affair
                known = any(words.startswith(w) or w.startswith(words) for w in
                            (re.split("…", q)[0].strip() for q in self.quoted()) if w)
                self.assertTrue(known or words in quoted, f"{path}: {words}")

    def test_tables_are_those_of_the_figures(self):
        subprocess.run([sys.executable, FOLDER / "figures" / "tables", "--check"], check=True)

    def test_links_lead_somewhere(self):
        pages = [page for page in SOURCE.rglob("*.md") if "build" not in page.relative_to(SOURCE).parts]
        self.assertGreater(len(pages), 6)
        for page in pages:
            for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
                self.assertTrue((page.parent / link).exists(), f"{page}: {link}")

    def test_the_readme_names_every_command(self):
        program = (SOURCE / "apps" / "program" / "command_line.cc").read_text(encoding="utf-8")
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        commands = set(re.findall(r"add_([a-z]+)_command\(", program)) | {"calibrate"}
        self.assertGreater(len(commands), 10)
        for command in commands:
            self.assertIn(command, readme)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
