"""A screenshot of a page that replays a run: `python docs/screenshot.py FOLDER`.

Needs selenium, chromium and chromedriver.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

import worlds
from topomap.page import record_build, save_page

SIZE = 1200, 720
MOMENT = 1.0
"""Of the run, as a part of it."""
COLOURS = 255
"""Enough for a page without photographs."""


def screenshot(page: Path, moment: float) -> bytes:
    """Return a PNG of a page at a moment, with a vertex chosen."""
    options = Options()
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu"):
        options.add_argument(flag)
    options.binary_location = shutil.which("chromium") or ""
    service = Service(shutil.which("chromedriver"))
    driver = webdriver.Chrome(options=options, service=service)
    try:
        screen = {"width": SIZE[0], "height": SIZE[1], "mobile": False}
        driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride", {**screen, "deviceScaleFactor": 1}
        )
        driver.get(f"{page.as_uri()}#t={moment:g}")
        driver.find_element("tag name", "body").send_keys("nnnnnn")
        driver.execute_async_script(
            "const done = arguments[0];"
            "requestAnimationFrame(() => requestAnimationFrame(() => done()))"
        )
        return driver.get_screenshot_as_png()
    finally:
        driver.quit()


def main(folder: str) -> None:
    """Record a build by a physical robot and take its picture."""
    world = worlds.make("random", np.random.default_rng(7), corners=24, islands=1)
    _, run = record_build(world, np.random.default_rng(1), body="physical")
    with tempfile.TemporaryDirectory() as place:
        page = Path(place, "run.html")
        save_page(run, page)
        picture = Image.open(BytesIO(screenshot(page, MOMENT * run.end)))
    small = picture.convert("RGB").quantize(COLOURS, Image.Quantize.FASTOCTREE)
    small.save(Path(folder, "page.png"), optimize=True)


if __name__ == "__main__":
    main(sys.argv[1])
