"""The page, as people use it, in headless Chromium."""

from __future__ import annotations

import io
import json
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest
from openpyxl import Workbook, load_workbook
from PIL import Image
from scipy.spatial.transform import Rotation, Slerp

from shaketable import Body, General, Solid, read_inventory, simulate, suite
from shaketable.assess.classes import NOT_CLASSED
from shaketable.building.typical import STRUCTURES
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.inventory.template import inventory_template
from shaketable.language import LANGUAGES
from shaketable.tables.template import write_template
from shaketable.web.answers import Counts
from shaketable.web.room_answers import Way

pytestmark = pytest.mark.web

TEXTS = Path(__file__).parents[2] / "src" / "shaketable" / "web" / "texts"
STATIC = TEXTS.parent / "static"
AXE = Path(__file__).parent / "vendor" / "axe.min.js"
# refusals, and drawing without a graphics card
QUIET = ("status of 422", "GPU stall", "creating WebGL context")
WIDE, PHONE = (1280, 900), (390, 844)


@pytest.fixture(params=[WIDE, PHONE], ids=["wide", "phone"])
def page(request: pytest.FixtureRequest, browser: Any, address: str) -> Iterator[Any]:
    """A page at a size, which may ask nobody but the server and must tell no error."""
    width, height = request.param
    context = browser.new_context(viewport={"width": width, "height": height}, locale="en-GB")
    context.route(lambda url: not url.startswith(address), lambda route: route.abort())
    opened, told = context.new_page(), []
    opened.on(
        "console",
        lambda message: any(each in message.text for each in QUIET) or told.append(message.text),
    )
    opened.on("pageerror", lambda error: told.append(str(error)))
    # a page that is left drops its events, and its icon where the browser has not asked for it yet
    dropped = ("/events", "/icon.svg")
    opened.on(
        "requestfailed",
        lambda asked: any(each in asked.url for each in dropped) or told.append(asked.url),
    )
    visit(opened, address)
    yield opened
    context.close()
    assert told == []


def visit(page: Any, address: str) -> None:
    page.goto(f"{address}/#shape=side&slides=1")
    page.wait_for_selector("#name option:nth-child(10)", state="attached")


def serious(page: Any) -> list[tuple[str, str]]:
    """What axe-core finds, 4.14.1 of Deque Systems, from npm, under the MPL 2.0."""
    page.evaluate(AXE.read_text("utf-8"))
    found = page.evaluate("async () => await axe.run()")
    assert len(found["passes"]) > 20
    grave = [each for each in found["violations"] if each["impact"] in ("serious", "critical")]
    return [(each["id"], each["nodes"][0]["html"]) for each in grave]


def test_it_begins_with_a_box_in_all_directions_that_cannot_slide(page: Any, address: str) -> None:
    """As a list takes it; the view from the side is for experts, and below."""
    page.goto("about:blank")
    page.goto(f"{address}/")
    page.wait_for_selector("#name option:nth-child(10)", state="attached")
    assert page.is_checked("[name=shape][value=box]")
    assert not page.is_checked("#slides")
    shapes = page.locator("[name=shape]").evaluate_all("all => all.map((each) => each.value)")
    assert shapes == ["box", "cylinder", "side"]
    page.wait_for_selector("canvas:visible")


@pytest.mark.parametrize(("link", "slides"), [("width_m=0.33", True), ("slides=0", False)])
def test_a_link_of_before_it_began_with_a_box(
    page: Any, address: str, link: str, slides: bool
) -> None:
    """It named no shape: it was seen from the side, and could slide unless it said no."""
    page.goto("about:blank")
    page.goto(f"{address}/#{link}")
    page.wait_for_selector("#name option:nth-child(10)", state="attached")
    assert page.is_checked("[name=shape][value=side]")
    assert page.is_checked("#slides") is slides
    assert page.input_value("#base_m") == ("33" if "width_m" in link else "32")
    page.check("[name=shape][value=box]")  # the size along the shaking stays
    assert page.input_value("#depth_m") == ("33" if "width_m" in link else "32")


def test_one_shaking_and_its_film(page: Any) -> None:
    """The film shows the rotation that `simulate` gives at its time."""
    page.fill("#base_m", "32")
    page.select_option("#name", "NORTHR/MUL009")
    with page.expect_response("**/api/simulate") as answer:
        page.click("#shake")
    page.wait_for_selector(".trace svg")
    motion = next(each for each in suite("fema-p695") if each.name == "NORTHR/MUL009")
    found = simulate(Body.rectangle(0.32, 1.8), motion, model=General(static_friction=0.5))
    assert f"after {found.overturning_time:.3g} s" in page.inner_text("#verdict")
    shown = page.evaluate(
        """async ([film, thing]) => {
            const { poseAt } = await import("./static/scene.js");
            return [2.0, 4.25, 6.01].map((time) => poseAt(film, thing, time).turn);
        }""",
        [
            answer.value.json(),
            {"base_m": 0.32, "height_m": 1.8, "cg_share": 0.5, "eccentricity": 0.5},
        ],
    )
    # between two pictures the page interpolates what curves: a 60th of a second at 5 rad/s²
    expected = np.interp([2.0, 4.25, 6.01], found.time, found.rotation)
    np.testing.assert_allclose(shown, expected, atol=5.0 / 8 / 60**2)


@pytest.mark.parametrize("shape", ["box", "cylinder"])
def test_a_film_in_three_dimensions(page: Any, shape: str) -> None:
    """It shows the position and the turn that `simulate` gives at its time."""
    page.check(f"[name=shape][value={shape}]")
    page.fill("#depth_m" if shape == "box" else "#base_m", "40")
    page.fill("#height_m", "160")
    page.select_option("#name", "NORTHR/MUL009")
    with page.expect_response("**/api/space/simulate") as answer:
        page.click("#shake")
    page.wait_for_selector(".trace svg")
    pair = next(each for each in suite("fema-p695", pairs=True) if each.name == "NORTHR/MUL009")
    solid = Solid.box(0.4, 0.9, 1.6) if shape == "box" else Solid.cylinder(0.4, 1.6)
    found = simulate(solid, pair, model=General(static_friction=0.5))
    at = [2.0, 4.25, 6.01]
    shown = page.evaluate(
        """async ([film, at]) => {
            const { poseAt } = await import("./static/solid.js");
            return at.map((time) => poseAt(film, time)).map(
                ({ position, turn }) => [...position, turn.x, turn.y, turn.z, turn.w]);
        }""",
        [answer.value.json(), at],
    )
    position = [np.interp(at, found.time, each) for each in found.position.T]
    turn = Slerp(found.time, found.rotation)(at)
    # between two pictures the page interpolates what curves: a 60th of a second at 10 m/s², rad/s²
    np.testing.assert_allclose([each[:3] for each in shown], np.transpose(position), atol=4e-4)
    apart = (turn * Rotation.from_quat([each[3:] for each in shown]).inv()).magnitude()
    assert apart.max() < 4e-4


def test_the_canvas_is_not_empty_in_three_dimensions(page: Any) -> None:
    """The support, the object and the world behind have colours of their own."""
    page.check("[name=shape][value=cylinder]")
    page.wait_for_selector("canvas:nth-child(2):visible")
    page.wait_for_timeout(500)
    picture = Image.open(io.BytesIO(page.locator("canvas:nth-child(2)").screenshot()))
    many = [n for n, _ in picture.convert("RGB").getcolors(1 << 24) if n > 500]
    assert len(many) >= 4
    before = picture.tobytes()
    page.locator("[id^=round-]").fill("120")
    page.wait_for_timeout(300)
    again = Image.open(io.BytesIO(page.locator("canvas:nth-child(2)").screenshot()))
    assert again.tobytes() != before  # seen from elsewhere


def test_what_is_worst_is_shaken(page: Any) -> None:
    """First the share of three dimensions, then its curve; what overturns it most is one of it."""
    page.check("[name=shape][value=cylinder]")
    page.fill("#base_m", "23")
    page.click("#many")
    page.wait_for_selector("#curve svg", timeout=60_000)
    assert "of 96 shakings" in page.inner_text("#share")
    assert "48 independent recordings" in page.inner_text("#sure")
    assert "with a friction of 0.5 alone" in page.inner_text("#sure")
    page.click("#worst")
    page.wait_for_selector(".trace svg")
    assert "It falls" in page.inner_text("#verdict")


@pytest.mark.parametrize("shape", ["side", "box"])
def test_a_wall_and_a_strap(page: Any, address: str, shape: str) -> None:
    """What they do is told with the verdict and with the share, and a link carries them."""
    assert "Nothing holds it" in page.inner_text("#limits-text")
    page.check(f"[name=shape][value={shape}]")
    page.click("#beside summary")
    page.check("#wall")
    page.check("#strap")
    page.fill("#wall_gap_mm", "30")
    page.fill("#strap_slack_mm", "20")
    assert "Nothing holds it" not in page.inner_text("#limits-text")
    page.select_option("#name", "NORTHR/MUL009")
    with page.expect_response("**/simulate") as answer:
        page.click("#shake")
    page.wait_for_selector(".trace svg")
    found = answer.value.json()
    told = f"{found['strap_peak']:.2g}"
    assert f"Its strap bore up to {told} times its weight" in page.inner_text("#verdict")
    with page.expect_response("**/many") as answer:
        page.click("#many")
    page.wait_for_selector("#share:has-text('its strap bore up to')", timeout=60_000)
    share, told = page.inner_text("#share"), answer.value.json()
    assert f"In 90 of 100 its strap bore up to {answer.value.json()['strap_90']:.2g} times" in share
    more = f"in {told['held_up']} more only its wall or strap holds it up"
    assert (more in share) is bool(told["held_up"])
    page.wait_for_selector("#curve svg", timeout=90_000)
    link = page.url
    page.goto("about:blank")
    page.goto(link)
    page.wait_for_selector("#name option:nth-child(10)", state="attached")
    assert page.is_checked("#wall")
    assert page.is_checked("#strap")
    assert not page.is_checked("#edge")
    assert page.input_value("#strap_slack_mm") == "20"


def test_a_wall_is_drawn_vertical(page: Any) -> None:
    """Its gap is from the nearest point, on a floor that leans to the front the lower edge."""
    page.check("[name=shape][value=box]")
    found = page.evaluate(
        """async () => {
            const { wallAt } = await import("./static/solid.js");
            const thing = { shape: "box", depth_m: 0.6, width_m: 0.4, height_m: 1.8, tilt_deg: 5 };
            return [0, 90].map((facing_deg) => wallAt({
                ...thing, facing_deg, beside: { wall_gap_mm: 10 },
            })).map(({ toward, far }) => [toward.x, toward.y, toward.z, far]);
        }"""
    )
    # 0.3 cos 5° of the base's edge is farther than that of the top, which leans away; turned by
    # 90° the wall stands at a side, where nothing leans
    np.testing.assert_allclose(found[0], [1, 0, 0, 0.3 * np.cos(np.radians(5)) + 0.01], atol=1e-9)
    np.testing.assert_allclose(found[1], [0, 1, 0, 0.31], atol=1e-9)


def test_an_edge_has_a_lip(page: Any) -> None:
    page.click("#beside summary")
    assert page.is_hidden("[data-field=lip_mm]")
    page.check("#edge")
    for shape in ("side", "box"):
        page.check(f"[name=shape][value={shape}]")
        assert page.is_visible("[data-field=edge_mm]")
        assert page.is_visible("[data-field=lip_mm]")


def test_a_strap_is_drawn_where_it_is(page: Any) -> None:
    """Red where it pulls, from the body's own corner; grey where it is loose."""
    colours = page.evaluate(
        """async () => {
            const { draw } = await import("./static/scene.js");
            const canvas = document.createElement("canvas");
            Object.assign(canvas, { width: 800, height: 500 });
            const context = canvas.getContext("2d", { willReadFrequently: true });
            const beside = { wall_gap_mm: 300, strap_slack_mm: 5, edge_mm: 200 };
            const thing = {
                base_m: 0.3, height_m: 1.8, cg_share: 0.5, eccentricity: 0.5, tilt_deg: 0, beside,
            };
            const still = [0, 0];
            const frames = { rotation_deg: still, x_m: still, y_m: [0.9, 0.9], ground_m: still };
            return [0, 0.5].map((force) => {
                const film = { outcome: "standing", frames: { ...frames, strap: [force, force] } };
                draw(canvas, thing, film, 0, () => "");
                const reach = 1.25 * Math.hypot(0.3, 1.8);
                const scale = Math.min(0.82 * 500 / reach, 0.45 * 800 / reach);
                const at = (x, y) => [...context.getImageData(
                    Math.round(400 + x * scale), Math.round(450 - y * scale), 1, 1).data];
                return [at(0.30, 1.8), at(0.46, 1.0), at(-0.5, -0.01), at(-0.2, -0.01)];
            });
        }"""
    )
    (loose, wall, void, shelf), (taut, *_) = colours
    assert loose != taut
    assert taut[0] > 2 * taut[1]  # red
    assert wall[3] == shelf[3] == 255
    assert void[3] < 255  # the support ends before it


def test_without_webgl_words_remain(page: Any) -> None:
    page.evaluate("HTMLCanvasElement.prototype.getContext = () => null")
    page.check("[name=shape][value=box]")
    page.wait_for_selector("text=cannot draw in three dimensions")
    page.click("#shake")
    page.wait_for_selector(".trace svg")
    assert page.inner_text("#verdict").startswith("It ")


def test_time_is_scrubbed(page: Any) -> None:
    page.click("#shake")
    page.wait_for_selector(".trace svg")
    page.locator(".time").fill("3")
    assert page.inner_text(".now") == "3.00 s"
    assert page.inner_text(".play") == "Play"
    page.click(".play")
    page.wait_for_timeout(400)
    assert float(page.input_value(".time")) > 3.1
    with page.expect_response("**/api/simulate"):
        page.click("#shake")  # another film plays by itself, whatever the one before did
    page.wait_for_timeout(200)
    begun = float(page.input_value(".time"))
    page.wait_for_timeout(400)
    assert float(page.input_value(".time")) > begun


def test_a_hundred_shakings_follow_the_sliders(page: Any) -> None:
    page.click("#many")
    page.wait_for_selector("#curve svg")
    before = page.inner_text("#share")
    assert "of 192 shakings" in before
    assert "independent recordings" in page.inner_text("#sure")
    with page.expect_response("**/api/many"):
        page.fill("#base_m", "120")
    page.wait_for_timeout(300)  # until the page has drawn the answer
    assert page.inner_text("#share") != before


def test_a_pulse_and_a_thing_that_cannot_slide(page: Any) -> None:
    page.check("[name=kind][value=pulse]")
    page.uncheck("#slides")
    page.fill("#peak_g", "0.6")
    page.fill("#period_s", "1.5")
    page.click("#shake")
    page.wait_for_selector(".trace svg")
    assert "It falls" in page.inner_text("#verdict")
    assert page.is_visible("#no-sliding")


def test_a_record_of_ones_own(page: Any, tmp_path: Path) -> None:
    record = tmp_path / "mine.csv"
    lines = [f"{0.01 * k:.2f},{6.0 * np.sin(4.0 * k * 0.01):.4f}" for k in range(400)]
    record.write_text("time_s,acceleration_m_s2\n" + "\n".join(lines))
    page.check("[name=kind][value=uploaded]")
    with page.expect_response("**/api/record*"):
        page.set_input_files("#file", str(record))
    page.wait_for_timeout(100)
    page.click("#shake")
    page.wait_for_selector(".trace svg")
    assert "It falls" in page.inner_text("#verdict")
    other = tmp_path / "other.csv"
    other.write_text(record.read_text().replace("acceleration_m_s2", "acceleration"))
    page.set_input_files("#file", str(other))
    page.wait_for_selector("text=names no unit")
    page.click("text=If the file does not say it")
    page.select_option("#file-units", "m/s2")
    page.wait_for_selector("text=In use: other.csv")
    assert "names no unit" not in page.inner_text("main")
    page.click("#shake")
    page.wait_for_selector("#verdict:has-text('It falls')")
    broken = tmp_path / "<b>broken.txt"
    broken.write_text("nothing")
    page.set_input_files("#file", str(broken))
    page.wait_for_selector("text=That did not work")
    assert page.locator("#verdict b").count() == 0  # names are text, never markup


def test_a_link_carries_everything(page: Any, address: str) -> None:
    page.fill("#height_m", "240")
    page.check("[name=kind][value=pulse]")
    page.check("#reverse")
    link = page.url
    assert "height_m=2.4" in link
    page.wait_for_load_state("networkidle")
    page.goto("about:blank")
    page.goto(link)
    page.wait_for_selector("#name option:nth-child(10)", state="attached")
    assert page.input_value("#height_m") == "240"
    assert page.is_checked("[name=kind][value=pulse]")
    assert page.is_checked("#reverse")


def test_spanish_and_metres(page: Any) -> None:
    page.select_option("#language", "es")
    page.select_option("#units", "m")
    page.wait_for_selector("text=Sacude tu propio estante")
    assert page.input_value("#base_m") == "0,32"  # with the page's decimal sign, not the browser's
    page.fill("#height_m", "2.4m")
    assert page.get_attribute("#height_m", "aria-invalid") == "true"
    page.fill("#height_m", "2,5")
    page.wait_for_url("**height_m=2.5**")
    page.fill("#height_m", "1.8")  # a point will do
    page.wait_for_function("!location.hash.includes('height_m')")
    page.click("#shake")
    page.wait_for_selector(".trace svg")
    assert "Se vuelca hacia la" in page.inner_text("#verdict")
    assert "8,32 s" in page.inner_text("#verdict")  # a comma, as Spanish writes it
    assert page.get_attribute("html", "lang") == "es"


def test_by_keyboard_alone(page: Any) -> None:
    page.focus("#base_m")
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.type("90")
    page.keyboard.press("Enter")
    page.wait_for_selector(".trace svg")
    assert "It stands" in page.inner_text("#verdict")
    page.focus(".time")
    page.keyboard.press("End")
    assert float(page.input_value(".time")) == pytest.approx(
        float(page.get_attribute(".time", "max"))
    )


def test_a_share_whose_curve_fails_stays(page: Any) -> None:
    def answer(route: Any) -> None:
        if route.request.post_data_json.get("curve", True):
            route.fulfill(body="not an answer", content_type="application/json")
        else:
            route.continue_()

    page.route("**/api/space/many", answer)
    page.check("[name=shape][value=cylinder]")
    page.click("#many")
    page.wait_for_selector("#curve-help:has-text('does not answer')", timeout=60_000)
    assert "of 96 shakings" in page.inner_text("#share")
    assert page.is_enabled("#worst")


def test_wrong_numbers_are_marked(page: Any) -> None:
    page.fill("#base_m", "-3")
    assert page.get_attribute("#base_m", "aria-invalid") == "true"
    assert "base_m" not in page.url


def test_nothing_is_wider_than_the_screen(page: Any) -> None:
    page.click("#shake")
    page.wait_for_selector(".trace svg")
    for width in (320, page.viewport_size["width"]):
        page.set_viewport_size({"width": width, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_serious_violation(page: Any, scheme: str) -> None:
    page.emulate_media(color_scheme=scheme)
    page.click("#shake")
    page.wait_for_selector(".trace svg")
    page.click("#many")
    page.wait_for_selector("#curve svg")
    page.click("#look summary")
    page.wait_for_selector("#spectrum svg")
    assert serious(page) == []


def test_a_list_from_file_to_report(page: Any, address: str, tmp_path: Path) -> None:
    """Read, corrected in its cells, assessed, sorted, and its result found again by its address."""
    mine = tmp_path / "mine.csv"
    mine.write_text("name,depth_m,width_m,height_m\nshelf,0.32,0.9,1.8.\n<b>box</b>,0.5,0.5,0.6\n")
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("#faults li")
    assert "expected a positive number, found '1.8.'" in page.inner_text("#faults")
    page.select_option("#language", "es")
    page.wait_for_selector("text=se esperaba un número positivo, hay '1.8.'")
    page.select_option("#language", "en")
    page.wait_for_selector("text=expected a positive number")
    assert page.is_disabled("#run")
    page.fill("#cells tbody tr:nth-child(1) td:nth-child(5) input", "1.8")
    page.click("#again")
    page.wait_for_selector("text=2 kinds of object were read")
    page.check("#planar")
    page.click("#run")
    page.wait_for_selector("#cards .card", timeout=300_000)
    assert page.inner_text("#cards .card strong >> nth=0") == "shelf"
    page.select_option("#sort", "name")
    assert page.inner_text("#cards .card strong >> nth=0") == "<b>box</b>"  # text, never markup
    page.click("#cards .card summary >> nth=1")
    assert "Anchor it" in page.inner_text("#cards")
    page.reload()
    page.wait_for_selector("#cards .card")
    assert serious(page) == []
    for width in (320, page.viewport_size["width"]):
        page.set_viewport_size({"width": width, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    shelf = page.locator("#cards .card", has_text="shelf")
    shelf.locator("summary").click()
    shelf.locator("button >> nth=0").click()
    page.wait_for_selector(".trace svg")
    assert "It falls" in shelf.locator("[role=status]").inner_text()
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert page.locator("#cards .card[open]").count() == 2
    page.emulate_media(media="print")
    assert not page.is_visible("#drop")
    page.emulate_media(media="screen")
    page.select_option("#language", "es")
    page.wait_for_selector("text=anclarlo o sujetarlo con correa")
    assert "Ánclalo, o sujétalo a una pared" in page.inner_text("#cards")
    assert "de cada 100 de estas sacudidas" in page.inner_text("#headline")
    assert page.get_attribute("#remarks", "href").endswith("/lista.csv")
    page.locator("#cards .card", has_text="shelf").locator("a").click()  # it is still open
    page.wait_for_selector("#name option:nth-child(10)", state="attached")
    assert page.input_value("#base_m") == "32"
    assert page.is_checked("[name=shape][value=side]")  # it was assessed in a plane


def test_sorting_keeps_a_film_and_places_are_told(page: Any, address: str, tmp_path: Path) -> None:
    mine = tmp_path / "mine.csv"
    mine.write_text(
        "name,quantity,depth_m,width_m,height_m,floor,location\n"
        "shelf,2,0.32,0.9,1.8,0,E12\nbox,3,0.5,0.5,0.6,0,E14\ntable,1,0.8,1.2,0.7,0,E12\n"
    )
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("text=3 kinds of object were read")
    curve = {"name": "site.csv", "mimeType": "", "buffer": CURVE}
    page.click("summary:has-text('How strong does it shake at my site?')")
    page.set_input_files("#hazard", curve)
    page.wait_for_selector("#told:has-text('The curve was read')")
    chosen = page.locator("#level option:checked").inner_text()
    assert chosen == (
        "shaking that comes once in some 475 years at the site of site.csv: PGA 0.48 g"
    )
    page.check("#planar")
    page.click("#run")
    page.wait_for_selector("#cards .card", timeout=300_000)
    page.click("#cards .card:has-text('shelf') summary")
    page.click("#cards .card:has-text('shelf') button >> nth=0")
    page.wait_for_selector("#cards .trace svg")
    page.select_option("#sort", "place")
    assert page.locator("#cards .trace svg").count() == 1
    titles = page.locator("#cards h3").all_inner_texts()
    assert [title.split(":")[0] for title in titles] == ["floor 0 · E12", "floor 0 · E14"]
    assert "of 3 pieces fall or go too far" in titles[0]
    page.select_option("#sort", "name")
    assert page.locator("#cards .trace svg").count() == 1
    assert page.locator("#cards h3").count() == 0
    assert serious(page) == []


def test_shake_is_seen_at_once(page: Any) -> None:
    """The button stands within the first screen, and nothing lies over what is below it."""
    box = page.locator("#shake").bounding_box()
    assert box["y"] + box["height"] <= page.viewport_size["height"]


def test_a_list_with_decimal_commas(page: Any, address: str, tmp_path: Path) -> None:
    """Excel's usual CSV in Spanish; what the page sends back means the same."""
    mine = tmp_path / "mía.csv"
    mine.write_text("nombre;fondo (cm);ancho (cm);alto (cm);piso\nestante;32,5;90;180;3\n", "utf-8")
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("text=1 kinds of object were read")
    assert "everything stands on the ground" in page.inner_text("#floors-unused")
    page.check("#planar")
    page.click("#run")
    page.wait_for_selector("#cards .card", timeout=300_000)
    page.click("#cards summary")
    assert "0.325" in page.get_attribute("#cards a", "href")
    assert "everything was simulated on the ground" in page.inner_text("#headline")
    page.select_option("#language", "es")
    page.wait_for_selector("#told:has-text('Listo')")
    page.set_input_files("#file", {"name": "b.csv", "mimeType": "", "buffer": b"nothing"})
    page.wait_for_selector("#faults li")
    assert not page.is_visible("#found")
    assert page.is_disabled("#run")


def test_headings_can_be_corrected(page: Any, address: str, tmp_path: Path) -> None:
    mine = tmp_path / "mine.csv"
    mine.write_text("name,deepness,width_m,height_m\nshelf,0.32,0.9,1.8\nbox,0.5,0.5,0.6\n")
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("text=3 of 4 columns are used. Not used: deepness")
    page.fill("#cells th:nth-child(3) input", "depth_m")
    page.click("#again")
    page.wait_for_selector("text=All 4 columns are used.")


CURVE = b"PGA [g],annual rate of exceedance\n0.01,0.1\n0.1,0.01\n1.0,0.001\n"
MESSY = """Inventar Labor,,,,
Gegenstand,Z,Breite,Höhe,Rollengröße
,mm,cm,cm,
Regal,320,90,180,50
Schrank,450,90,110,
"""


def test_what_columns_mean_is_chosen_and_kept(page: Any, address: str, tmp_path: Path) -> None:
    """From menus beside samples; a column that decides is asked; the file answers the next time."""
    mine = tmp_path / "Labor.csv"
    mine.write_text(MESSY, "utf-8")
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("#columns li.asked")
    asked = page.locator("#columns li.asked")
    assert asked.locator("strong").inner_text() == "Rollengröße"
    assert asked.locator("span.small >> nth=0").inner_text() == "50"
    assert "nothing gets a class" in page.inner_text("#notes")
    height = page.locator("#columns li", has_text="Höhe")
    assert height.locator("select >> nth=1").input_value() == "cm"  # as the row of units says
    page.set_viewport_size({"width": 400, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 400
    assert "Not used: Z, Rollengröße" in page.inner_text("#columns-told")
    assert serious(page) == []
    asked.locator("button").click()
    page.wait_for_selector("#columns:not(:has(.asked)) li")
    assert "nothing gets a class" not in page.inner_text("#notes")
    depth = page.locator("#columns li").filter(has=page.locator("strong:text-is('Z')"))
    depth.locator("select >> nth=0").select_option("width")
    page.wait_for_selector("#faults li:has-text('2 columns mean')")
    depth.locator("select >> nth=0").select_option("depth")
    page.wait_for_selector("text=2 kinds of object were read")
    with page.expect_download() as kept:
        page.click("#save-columns")
    assert kept.value.suggested_filename == "Labor.csv.columns.toml"
    said = tmp_path / "Labor.csv.columns.toml"
    kept.value.save_as(said)
    assert tomllib.loads(said.read_text("utf-8")) == {
        "columns": {
            "Gegenstand": "name", "Z": "depth_mm", "Breite": "width_cm", "Höhe": "height_cm",
            "Rollengröße": "",
        }
    }  # fmt: skip
    assert [item.body.base for item in read_inventory(mine)] == [0.32, 0.45]  # beside the list
    page.reload()
    page.set_input_files("#file", [str(mine), str(said)])
    page.wait_for_selector("text=2 kinds of object were read")
    assert page.locator("#columns li.asked").count() == 0
    page.check("#planar")
    page.click("#run")
    page.wait_for_selector("#cards .card", timeout=300_000)
    assert "0.32" in page.get_attribute("#cards .card:has-text('Regal') a", "href")


def test_the_sheet_is_chosen(page: Any, address: str, tmp_path: Path) -> None:
    book = Workbook()
    for title, rows in (("Old", 1), ("New", 2)):
        sheet = book.create_sheet(title)
        sheet.append(["name", "depth (cm)", "height (cm)"])
        for k in range(rows):
            sheet.append([f"{title} {k}", 30 + k, 180])
    del book["Sheet"]
    mine = tmp_path / "two.xlsx"
    book.save(mine)
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("text=Several sheets may hold the objects. Choose one.")
    assert "'New' has the most rows, 2" in page.inner_text("#faults")
    assert page.is_disabled("#run")
    page.select_option("#language", "de")
    page.wait_for_selector("#faults:has-text('hat die meisten Zeilen')")
    page.select_option("#language", "en")
    page.select_option("#sheet", "New")
    page.wait_for_selector("text=2 kinds of object were read")
    page.select_option("#sheet", "Old")
    page.wait_for_selector("text=1 kinds of object were read")
    assert page.input_value("#cells tbody td input >> nth=0") == "Old 0"


def test_the_building_is_asked_for_and_read_from_its_sheet(
    page: Any, address: str, tmp_path: Path
) -> None:
    """While floors are named and no building is, that is told in red above the button."""
    mine = tmp_path / "mine.xlsx"
    write_template(mine, inventory_template("de"))
    book = load_workbook(mine)
    book.worksheets[0].cell(2, 10, 2)
    book.save(mine)
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("text=4 kinds of object were read")
    assert page.is_visible("#floors-unused")
    page.select_option("#structure", "masonry")
    assert not page.is_visible("#floors-unused")
    page.select_option("#structure", "masonry")
    for k, value in enumerate(("Klinik", 5, "Stahlrahmen", 4.5), 1):
        book["Gebäude"].cell(k, 2, value)
    book.save(mine)
    page.reload()
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("text=4 kinds of object were read")
    assert (page.input_value("#structure"), page.input_value("#storeys")) == ("steel frame", "5")
    assert page.input_value("#storey-height") == "4.5"
    page.click("#again")
    page.wait_for_selector("text=4 kinds of object were read")
    assert page.input_value("#structure") == "steel frame"
    assert serious(page) == []
    page.click("#empty")  # another list is in no building, until it says one
    page.wait_for_selector("text=2 kinds of object were read")
    assert page.input_value("#structure") == ""


def test_sizes_that_are_missing_are_taken_from_the_catalogue(
    page: Any, address: str, tmp_path: Path
) -> None:
    """Only once it is asked for; the card says what was assumed."""
    mine = tmp_path / "names.csv"
    mine.write_text("Gegenstand,Anzahl\nBücherregal,3\nGasflasche,2\n", "utf-8")
    page.goto(f"{address}/list")
    page.set_input_files("#file", str(mine))
    page.wait_for_selector("#faults li:has-text('; or take usual sizes from the catalogue, below')")
    assert page.is_disabled("#run")
    page.check("#catalogue")
    page.wait_for_selector("text=2 kinds of object were read")
    assert "'Gasflasche' as 'gas cylinder large'" in page.inner_text("#notes")
    page.check("#planar")
    page.click("#run")
    page.wait_for_selector("#cards .card", timeout=300_000)
    page.click("#cards .card:has-text('Bücherregal') summary")
    assert "depth 25 cm (of 25 to 40)" in page.inner_text("#cards")
    page.select_option("#language", "de")
    page.wait_for_selector("text=Tiefe 25 cm (von 25 bis 40)")


def test_what_was_changed_is_told(page: Any) -> None:
    """No verdict stands beside another thing than its own, however late it comes."""
    page.fill("#base_m", "90")
    page.click("#shake")
    page.wait_for_selector(".verdict.stands")
    page.fill("#base_m", "5")
    assert page.inner_text("#verdict") == "You changed something: press Shake again."
    assert "stands" not in page.get_attribute("#verdict", "class")

    def late(route: Any) -> None:
        answer = route.fetch()
        page.wait_for_timeout(500)
        route.fulfill(response=answer)

    page.route("**/api/simulate", late)
    page.click("#shake")
    page.check("[name=shape][value=cylinder]")
    page.wait_for_timeout(1500)
    assert page.inner_text("#verdict") == "You changed something: press Shake again."


def test_a_share_that_could_not_be_asked_for_is_asked_again(page: Any) -> None:
    """And only the worst shaking of the thing that is shown can be shaken."""
    page.click("#many")
    page.wait_for_selector("#worst:enabled")
    page.fill("#base_m", "")
    page.click("#many")
    assert "a number from" in page.inner_text("#share")
    assert page.is_disabled("#worst")
    page.fill("#base_m", "32")
    page.wait_for_selector("#share:has-text('shakings')")
    page.wait_for_selector("#worst:enabled")
    page.select_option("#language", "es")
    page.wait_for_selector("#share:has-text('sacudidas')")


def test_what_cannot_be_used_is_not_shaken(page: Any, address: str) -> None:
    page.fill("#height_m", "99999")
    for button in ("#shake", "#many"):
        page.click(button)
        assert "Height: a number from 0.5 to 2,000" in page.inner_text("main")
        assert page.evaluate("document.activeElement.id") == "height_m"
    page.goto("about:blank")
    page.goto(f"{address}/#shape=toString&width_m=999&name=NOPE")
    page.wait_for_selector("text=Part of that link could not be used")


def test_the_link_to_the_result_keeps_what_was_entered(page: Any) -> None:
    page.fill("#height_m", "240")
    page.focus(".skip")
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.id") == "result-title"
    assert page.input_value("#height_m") == "240"
    assert "height_m=2.4" in page.url


def test_a_slider_moved_while_three_dimensions_are_fetched(page: Any) -> None:
    """They are fetched once, and leave no more on the graphics card for every step."""
    page.check("[name=shape][value=box]")
    for width in range(30, 60):
        page.fill("#depth_m", str(width))
    page.wait_for_selector("canvas:nth-child(2):visible")
    made = page.evaluate(
        """async () => {
            const { View } = await import("./static/solid.js");
            const view = new View(document.createElement("canvas"));
            const counts = [];
            for (let k = 0; k < 5; k += 1) {
                const depth_m = 0.3 + k / 10;
                const base = { shape: "box", depth_m, width_m: 0.9 };
                view.build({ ...base, height_m: 1, cg_share: 0.5, tilt_deg: 0 });
                view.renderer.render(view.scene, view.camera);
                counts.push(view.renderer.info.memory.geometries);
            }
            view.close();
            return counts;
        }"""
    )
    assert made[-1] == made[0]


def test_the_interface_is_shown(page: Any, address: str) -> None:
    """By files of its own, under the same policy; what is described can be tried."""
    page.goto(f"{address}/docs")
    page.wait_for_selector("[data-path='/api/simulate']")
    page.click("[data-path='/api/motions']")
    page.click("text=Try it out")
    page.click(".btn.execute")
    page.wait_for_selector("text=NORTHR/MUL009")


def test_languages_have_the_same_words() -> None:
    words = {path.stem: json.loads(path.read_text("utf-8")) for path in TEXTS.glob("*.json")}
    assert set(words) == set(LANGUAGES)
    for language in LANGUAGES:
        assert words["en"].keys() == words[language].keys()
        for key, english in words["en"].items():
            assert sorted(_holes(english)) == sorted(_holes(words[language][key])), (language, key)


def test_every_word_that_is_asked_for_is_there() -> None:
    words = json.loads((TEXTS / "en.json").read_text("utf-8"))
    asked = {f"risk_{name.replace(' ', '_')}" for name in (*RISK_CLASSES, NOT_CLASSED)}
    for path in STATIC.glob("*.js"):
        asked |= set(re.findall(r'\bsay\("(\w+)"', path.read_text("utf-8")))
        asked |= set(re.findall(r'\b(?:tell|drop)\("(\w+)"', path.read_text("utf-8")))
    for path in STATIC.glob("*.html"):
        asked |= set(re.findall(r'data-(?:text|help)="(\w+)"', path.read_text("utf-8")))
    asked |= {f"list_{name}" for name in get_args(Counts)}
    page = (STATIC / "list.js").read_text("utf-8")
    assert re.findall(r'"([^"]+)"', page.split("const STRUCTURES = ")[1].split(";")[0]) == [
        *STRUCTURES
    ]
    structures = {f"structure_{name.replace(' ', '_')}" for name in STRUCTURES}
    asked |= structures
    asked |= set(re.findall(r'text: "(\w+)"', (STATIC / "state.js").read_text("utf-8")))
    beside = set(re.findall(r'(\w+): \["\w+_mm"', (STATIC / "state.js").read_text("utf-8")))
    assert len(beside) == 3
    asked |= beside
    of_rooms = words_of_rooms()
    asked |= of_rooms
    assert len(asked) > 150
    assert sorted(asked - words.keys()) == []
    sources = "".join(path.read_text("utf-8") for path in STATIC.iterdir() if path.is_file())
    made = ("risk_", "list_falls", "list_on_", "falls_")  # of what the server answers
    unused = [
        key
        for key in words
        if f'"{key.removesuffix("_help")}"' not in sources
        and not key.startswith(made)
        and key not in beside | of_rooms | structures
    ]
    assert unused == []


def words_of_rooms() -> set[str]:
    """The words of a room's page that are put together from names."""
    state, fields = (
        (STATIC / f"room_{each}.js").read_text("utf-8") for each in ("state", "fields")
    )
    kinds = re.findall(r"^  (\w+): \{ section", state, re.MULTILINE)
    numbers = re.findall(r'(\w+): \[-?[\d.]+, \d+, "', fields)
    named = re.findall(r'(?:textField|choice|tick)\("(\w+)"', fields)
    choices = re.findall(r'words\("(\w+)", \[(.*?)\]', fields)
    assert len(kinds) > 10 and len(numbers) > 10 and len(choices) == 4  # noqa: PT018
    found = {f"room_{each}" for each in (*numbers, *named, "thing", "place", "door")}
    found |= {f"room_new_{kind}" for kind in kinds}
    found |= {f"room_{each}_once" for each in get_args(Way)}
    for name, given in choices:
        found |= {f"room_{name}_{each or 'none'}" for each in re.findall(r'"(\w*)"', given)}
    return found


def _holes(text: str) -> list[str]:
    return [part.split("}")[0] for part in text.split("{")[1:]]
