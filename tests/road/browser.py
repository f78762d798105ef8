"""Pages looked at in a browser without a window."""
import shutil
import subprocess
from pathlib import Path

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
NODE = shutil.which("node")


def missing_browser():
    """Why no page can be looked at; empty if one can."""
    return "" if BROWSER and NODE else "Chromium or Node.js is not installed"


def look_at_pages(packages, folder, names):
    """Exit status of pages_in_browser.mjs for these pages of the folder, without their ending."""
    look = Path(__file__).with_name("pages_in_browser.mjs")
    return subprocess.run([NODE, look, packages, BROWSER, folder, *names], check=False).returncode
