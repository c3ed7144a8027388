"""A headless browser, where the machine has one."""

import hashlib
import os
import shutil
import warnings

import pytest

FLAGS = (
    *("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"),
    *("--no-first-run", "--disable-background-networking", "--disable-sync"),
    *("--disable-component-update", "--disable-quic", "--force-color-profile=srgb"),
)
NEEDED = "needs a browser: install selenium, chromium and chromedriver"


class Browser:
    """A browser with one page in it."""

    def __init__(self, driver):
        self.driver = driver

    def open(self, path, moment=None, size=(1200, 800), dark=False, phone=False):
        """Show a page at a moment, on a fresh screen; return what it complained of."""
        driver = self.driver
        driver.get("about:blank")
        screen = {"width": size[0], "height": size[1], "mobile": phone}
        screen["deviceScaleFactor"] = 1
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
        driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": phone})
        scheme = {
            "name": "prefers-color-scheme",
            "value": "dark" if dark else "light",
        }
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})
        driver.get(path.as_uri() + ("" if moment is None else f"#t={moment:g}"))
        self.settle()
        return driver.get_log("browser")

    def run(self, script, *arguments):
        """Run a script in the page and return what it returns."""
        return self.driver.execute_script(script, *arguments)

    def settle(self):
        """Wait until two frames have been drawn."""
        self.driver.execute_async_script(
            "const done = arguments[0];"
            "requestAnimationFrame(() => requestAnimationFrame(() => done()))"
        )

    def text(self, name):
        """Return the text of an element by id."""
        return self.run("return document.getElementById(arguments[0]).innerText", name)

    def picture(self, name="scene"):
        """Return a digest of what a canvas shows."""
        self.settle()
        found = self.run(
            "return document.getElementById(arguments[0]).toDataURL()", name
        )
        return hashlib.sha256(found.encode()).hexdigest()

    def press(self, *keys):
        """Press keys, one after another."""
        from selenium.webdriver.common.action_chains import ActionChains

        ActionChains(self.driver).send_keys(*keys).perform()
        self.settle()

    def slide(self, share):
        """Move the time slider to a part of its way, as a hand does."""
        self.run(
            "const slider = document.getElementById('slider');"
            "slider.value = arguments[0] * slider.max;"
            "slider.dispatchEvent(new Event('input'))",
            share,
        )
        self.settle()

    def view(self):
        """Return middle x, y in metres and pixels a metre of the picture."""
        self.settle()
        found = self.run("return document.getElementById('scene').dataset.view")
        return tuple(float(part) for part in found.split())

    def pixel_of(self, x, y):
        """Return where a place of the world is, from the picture's middle."""
        middle_x, middle_y, scale = self.view()
        return (x - middle_x) * scale, (middle_y - y) * scale

    def hover(self, x, y):
        """Point at a place of the world; return what the page says of it."""
        from selenium.webdriver.common.action_chains import ActionChains

        scene = self.driver.find_element("id", "scene")
        right, down = (round(value) for value in self.pixel_of(x, y))
        chain = ActionChains(self.driver, duration=0)
        chain.move_to_element_with_offset(scene, right, down).perform()
        self.settle()
        tip = self.driver.find_element("id", "tip")
        return tip.text if tip.is_displayed() else ""


@pytest.fixture(scope="session")
def driver():
    """Start a headless Chromium, or skip."""
    webdriver = pytest.importorskip("selenium.webdriver", reason=NEEDED)
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service

    names = "chromium", "chromium-browser", "google-chrome"
    binary = os.environ.get("TOPOMAP_BROWSER") or next(
        filter(None, map(shutil.which, names)), None
    )
    chromedriver = shutil.which("chromedriver")
    if binary is None or chromedriver is None:
        pytest.skip(NEEDED)
    options = Options()
    options.binary_location = binary
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        started = webdriver.Chrome(options=options, service=Service(chromedriver))
        yield started
        started.quit()


@pytest.fixture
def browser(driver):
    """Return a browser to open a page in."""
    return Browser(driver)
