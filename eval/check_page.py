#!/usr/bin/env python3
"""Opens pages of report.py from disk in headless Chromium and checks them, at the widths of a desktop and a phone.

usage: check_page.py [--screenshots DIRECTORY] PAGE...

No message on the console, no request but for the page itself, all rows of the table, pictures of every kind, nothing
wider than the screen, every choice of a tracker works. Needs Chromium and its driver, Debian's packages chromium and
chromium-driver; the exit status is 77 without them.
"""
import argparse
import base64
import json
import pathlib
import shutil
import sys
import time

import environment
import entries

# Width, height, whether it is a phone.
SCREENS = {"desktop": (1280, 900, False), "phone": (390, 844, True)}
# A picture of a page may be this high.
HIGHEST = 16000


class Wrong(Exception):
    """The page is not as it should be."""


def demand(condition, what):
    if not condition:
        raise Wrong(what)


def browser_of(width, height, phone, dark):
    from selenium import webdriver
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
                     "--disable-background-networking", "--disable-component-update"):
        options.add_argument(argument)
    options.binary_location = shutil.which("chromium")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(options, webdriver.ChromeService(shutil.which("chromedriver")))
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone})
    if dark:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
    return browser


def requests_of(browser):
    """The addresses of everything that was loaded."""
    messages = (json.loads(entry["message"])["message"] for entry in browser.get_log("performance"))
    return [message["params"]["request"]["url"] for message in messages
            if message["method"] == "Network.requestWillBeSent"]


def screenshot(browser, path, width, height, phone):
    browser.execute_script("window.scrollTo(0, 0)")
    whole = min(browser.execute_script("return document.documentElement.scrollHeight"), HIGHEST)
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": whole, "deviceScaleFactor": 1, "mobile": phone})
    data = browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]
    path.write_bytes(base64.b64decode(data))
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone})


def check(browser, address, trackers, width):
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.select import Select
    browser.get(address)
    time.sleep(0.3)

    def all_of(selector):
        return browser.find_elements(By.CSS_SELECTOR, selector)

    loaded = [url for url in requests_of(browser) if not url.startswith("data:")]
    demand(loaded == [address], f"it loads {loaded}, not only itself")
    names = [each.text for each in all_of("#scores tbody th")]
    demand(names == trackers, f"the table has the rows {names}")
    demand(all(each.text.strip() for each in all_of("#scores tbody td")), "the table has empty cells")
    columns = len(all_of("#scores thead th")) - 1
    marked = browser.execute_script("""
        return [...document.querySelectorAll("#scores tbody tr")].map(row => [...row.cells].slice(1).map(
            cell => cell.classList.contains("best")))""")
    demand(all(any(row[i] for row in marked) for i in range(columns)), "a column has no best value marked")
    for section in ("bars", "alpha", "time", "sequences"):
        shown = [each for each in all_of(f"#{section} svg") if each.is_displayed()]
        demand(shown, f"no picture is to be seen in section {section}")
        demand(all(len(each.get_attribute("aria-label")) > 40 for each in shown), f"no alternative text in {section}")
    for section in all_of("#sequences details"):
        if section.get_attribute("open") is None:
            section.find_element(By.TAG_NAME, "summary").click()
        demand(
            len(section.find_elements(By.CSS_SELECTOR, "tbody tr")) == len(trackers), "a sequence's table lacks rows"
        )
    for group in ("timeline", "switches"):
        for tracker in trackers[::-1]:
            Select(all_of(f"select[data-group={group}]")[0]).select_by_value(tracker)
            visible = {
                each.get_attribute("data-name") for each in all_of(f"[data-choice={group}]") if each.is_displayed()
            }
            demand(visible == {tracker}, f"the choice of {tracker} shows {visible} of {group}")
    broken = browser.execute_script("""
        return [...document.images].filter(image => !image.complete || !image.naturalWidth || !image.alt).length""")
    demand(not broken, f"{broken} images are broken or lack their alternative text")
    scroll = browser.execute_script("return document.documentElement.scrollWidth")
    demand(scroll <= width, f"the page is {scroll} pixels wide on a screen of {width}")
    messages = [entry["message"] for entry in browser.get_log("browser")]
    demand(not messages, f"the console says {messages}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="+", type=pathlib.Path)
    parser.add_argument("--screenshots", type=pathlib.Path, help="directory for pictures of the pages")
    parser.add_argument("--entries", default=",".join(entries.TRACKERS), help="the rows there must be")
    options = parser.parse_args()
    if not shutil.which("chromium") or not shutil.which("chromedriver"):
        environment.skip("there is no chromium, or no chromedriver")
    environment.enter("check")
    failed = 0
    for page in options.pages:
        for screen, (width, height, phone) in SCREENS.items():
            for dark in (False, True):
                browser = browser_of(width, height, phone, dark)
                name = f"{page.parent.name}-{screen}{'-dark' * dark}"
                try:
                    check(browser, page.resolve().as_uri(), options.entries.split(","), width)
                    print(f"ok: {page}, {screen}{', dark' * dark}")
                except Wrong as error:
                    failed += 1
                    print(f"WRONG: {page}, {screen}{', dark' * dark}: {error}")
                if options.screenshots:
                    options.screenshots.mkdir(parents=True, exist_ok=True)
                    screenshot(browser, options.screenshots / f"{name}.png", width, height, phone)
                browser.quit()
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
