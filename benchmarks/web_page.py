"""`python -m benchmarks.web_page`: how soon the page shows a film, and how smoothly.

In headless Chromium, on a server of its own that has compiled: the time from pressing *Shake* to
the first picture of the film, and how many pictures a second are drawn while it plays, seen from
the side and in three dimensions. Without a graphics card the
processor draws three dimensions.
"""

from __future__ import annotations

import shutil
import statistics
import sys

from playwright.sync_api import Page, sync_playwright
from tests.web.conftest import start_server

TIMES = 5
SECONDS = 3  # that pictures are counted


def main() -> None:
    chromium = shutil.which("chromium")
    if chromium is None:
        sys.exit("chromium is not installed")
    server, address = start_server()
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
            for shape in ("side", "box", "cylinder"):
                page = browser.new_page(viewport={"width": 1280, "height": 900})
                page.goto(address)
                page.wait_for_selector("#name option:nth-child(10)", state="attached")
                page.check(f"[name=shape][value={shape}]")
                page.fill(
                    "#depth_m" if shape == "box" else "#base_m", "120"
                )  # it stands, so that the film is long
                page.wait_for_timeout(1000)
                first = [first_picture(page) for _ in range(TIMES)]
                print(
                    f"{shape}: first picture after {1e3 * first[0]:.0f} ms, then after "
                    f"{1e3 * statistics.median(first[1:]):.0f} ms (median of {TIMES - 1}); "
                    f"{pictures(page):.0f} pictures a second"
                )
    finally:
        server.terminate()
        server.communicate()


def first_picture(page: Page) -> float:
    """From pressing Shake until the film has begun to play [s]."""
    took: float = page.evaluate(
        """async () => {
            const begun = performance.now();
            const trace = document.querySelector(".trace");
            trace.replaceChildren();
            document.getElementById("shake").click();
            while (!trace.firstChild) await new Promise(requestAnimationFrame);
            return (performance.now() - begun) / 1000;
        }"""
    )
    return took


def pictures(page: Page) -> float:
    """Pictures a second while the film plays."""
    count: float = page.evaluate(
        """async (seconds) => {
            const now = document.querySelector(".now");
            let count = 0, before = now.textContent;
            const begun = performance.now();
            while (performance.now() - begun < 1000 * seconds) {
                await new Promise(requestAnimationFrame);
                if (now.textContent !== before) count += 1;
                before = now.textContent;
            }
            return count / seconds;
        }""",
        SECONDS,
    )
    return count


if __name__ == "__main__":
    main()
