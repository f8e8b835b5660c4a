"""The page of a room, as people use it, in headless Chromium."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shaketable.language import LANGUAGES
from shaketable.rooms import read_room
from tests.web.test_page import PHONE, QUIET, WIDE, serious
from tests.web.test_rooms import EXAMPLE

pytestmark = pytest.mark.web

MOST_ACTIONS = 40  # from an empty plan to the ranked changes


@pytest.fixture(params=[WIDE, PHONE], ids=["wide", "phone"])
def page(request: pytest.FixtureRequest, browser: Any, address: str) -> Iterator[Any]:
    """The page of a room at a size, which must tell no error."""
    width, height = request.param
    context = browser.new_context(
        viewport={"width": width, "height": height},
        locale="en-GB",
        has_touch=request.param is PHONE,
    )
    opened, told = context.new_page(), []
    opened.on(
        "console",
        lambda message: any(each in message.text for each in QUIET) or told.append(message.text),
    )
    opened.on("pageerror", lambda error: told.append(str(error)))
    visit(opened, f"{address}/room")
    yield opened
    context.close()
    assert told == []


def visit(page: Any, address: str) -> None:
    page.goto(address)
    page.wait_for_selector("#name option:nth-child(2)", state="attached")


def add(page: Any, *kinds: str) -> None:
    for kind in kinds:
        page.click(f"[data-kind={kind}]")


def room_of(page: Any) -> dict[str, Any]:
    """The room that is edited, as the link has it."""
    text = page.evaluate(
        """async () => {
            document.getElementById("link").click();
            await new Promise((done) => setTimeout(done, 200));
            const { unpacked } = await import("./static/room_state.js");
            return unpacked(location.hash.slice(1));
        }"""
    )
    import tomllib

    return tomllib.loads(text)


def faults(page: Any) -> list[str]:
    """What is wrong with the plan, once it has been looked at."""
    page.wait_for_timeout(700)  # it is looked at some time after the last change
    page.wait_for_load_state("networkidle")
    return [each for each in page.inner_text("#faults").splitlines() if each]


def middle(page: Any, key: str) -> tuple[float, float]:
    page.locator(f"[data-key={key}]").scroll_into_view_if_needed()
    box = page.locator(f"[data-key={key}] .shape").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page: Any, start: tuple[float, float], by: tuple[float, float]) -> None:
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + by[0] / 2, start[1] + by[1] / 2)
    page.mouse.move(start[0] + by[0], start[1] + by[1])
    page.mouse.up()


def test_from_an_empty_plan_to_the_ranked_changes(page: Any) -> None:
    """Each press, drag and entry counts; what is found is what the room's own file gives."""
    actions = 0

    def act(does: Any, *args: Any) -> None:
        nonlocal actions
        actions += 1
        does(*args)

    for kind in ("door", "bed", "desk", "bookcase", "gas", "filing", "monitor"):
        act(page.click, f"[data-kind={kind}]")
    act(drag, page, middle(page, "thing-0"), (-15.0, 0.0))
    assert faults(page) == []
    act(page.fill, "#scale", "1.5")
    act(page.click, "#design")
    page.wait_for_selector("#found:not([hidden])", timeout=300_000)
    assert actions <= MOST_ACTIONS
    rows = page.locator("#tables table").first.locator("tbody tr").all_inner_texts()
    assert len(rows) > 2
    saves = [float(row.split("\t")[-1]) for row in rows]
    assert saves[:-1] == sorted(saves[:-1], reverse=True)
    assert saves[-1] >= saves[0]  # the best pair
    assert re.search(r"from \d+ to (less than 1|\d+) of 100 \(\d+–\d+\)", rows[0])
    assert page.locator(".plan .heat").count() == 1
    assert page.locator(".plan [data-often]").count() >= 4
    assert page.locator(".plan .fall").count() >= 2  # arrows to where things fall
    page.click("#worst")
    page.wait_for_selector(".trace svg")
    assert page.is_visible("#tables")  # what was found stays
    assert re.match(r"[1-4] of 4 things fall", page.inner_text("#told"))


def test_things_are_placed_without_a_fault(page: Any) -> None:
    """Whatever is pressed finds room, with its back to a wall."""
    add(
        page,
        "door",
        "bed",
        "desk",
        "wardrobe",
        "locker",
        "fridge",
        "rack",
        "gas",
        "drip",
        "cupboard",
    )
    assert faults(page) == []
    room = room_of(page)
    assert len(room["thing"]) == 7
    for thing in room["thing"]:
        assert min(*thing["at_m"], 5 - thing["at_m"][0], 4 - thing["at_m"][1]) < 0.5


def test_a_thing_is_dragged_to_a_wall_and_faces_the_room(page: Any) -> None:
    add(page, "door", "bookcase")
    left, top = middle(page, "thing-0")
    walls = page.locator(".plan .walls").bounding_box()
    # to the wall above, which is the north as nothing else is said
    drag(page, (left, top), (walls["x"] + walls["width"] / 2 - left, walls["y"] + 12 - top))
    (thing,) = room_of(page)["thing"]
    assert thing["facing_deg"] == 180
    assert thing["at_m"][1] == pytest.approx(4 - 0.32 / 2 - 0.02)
    page.click("#undo")
    assert (
        room_of(page)["thing"][0]["facing_deg"] != 180
        or room_of(page)["thing"][0]["at_m"] != thing["at_m"]
    )
    page.click("#redo")
    assert room_of(page)["thing"] == [thing]


def test_new_things_are_dragged_out_of_the_catalogue(page: Any) -> None:
    button = page.locator("[data-kind=showcase]")
    page.evaluate("scrollTo(0, 0)")
    box = button.bounding_box()
    floor = page.locator(".plan .floor").bounding_box()
    start = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    end = (floor["x"] + floor["width"] / 2, floor["y"] + floor["height"] / 2)
    drag(page, start, (end[0] - start[0], end[1] - start[1]))
    (thing,) = room_of(page)["thing"]
    np.testing.assert_allclose(thing["at_m"], [2.5, 2.0], atol=0.1)


def test_each_thing_is_dragged_by_itself_and_undone_by_itself(page: Any) -> None:
    """What had the focus before stays where it is; Delete and Escape choose nothing new."""
    add(page, "door", "bookcase", "filing")
    first, second = room_of(page)["thing"]
    drag(page, middle(page, "thing-0"), (-30.0, 0.0))
    drag(page, middle(page, "thing-1"), (30.0, 0.0))
    moved = room_of(page)["thing"]
    assert moved[0]["at_m"] != first["at_m"]
    assert moved[1]["at_m"] != second["at_m"]
    page.click("#undo")
    assert [each["at_m"] for each in room_of(page)["thing"]] == [moved[0]["at_m"], second["at_m"]]
    middle(page, "thing-0")
    page.focus("[data-key=thing-0]")
    page.keyboard.press("Delete")
    assert page.locator("[data-chosen]").count() == 0
    page.focus("[data-key=thing-0]")
    page.keyboard.press("Escape")
    assert page.locator("[data-chosen]").count() == 0
    assert page.locator(".plan .corner").count() == 4


def test_a_change_stops_what_is_computed(page: Any) -> None:
    add(page, "door", "bed", "bookcase")
    page.click("#many")
    page.wait_for_selector("#running:not([hidden])")
    page.focus("[data-key=thing-0]")
    page.keyboard.press("ArrowLeft")
    page.wait_for_selector("#told:has-text('changed the plan')")
    assert page.is_enabled("#many")
    assert page.is_hidden("#running")


def test_the_keyboard_does_it_all(page: Any) -> None:
    page.focus("[data-kind=bookcase]")
    page.keyboard.press("Enter")
    before = room_of(page)["thing"][0]
    page.focus("[data-key=thing-0]")
    for key in ("ArrowUp", "ArrowUp", "Shift+ArrowRight"):
        page.keyboard.press(key)
    moved = room_of(page)["thing"][0]
    np.testing.assert_allclose(np.subtract(moved["at_m"], before["at_m"]), [0.5, 0.1], atol=1e-6)
    page.focus("[data-key=thing-0]")
    page.keyboard.press("r")
    assert room_of(page)["thing"][0]["facing_deg"] == (moved["facing_deg"] + 90) % 360
    page.focus("[data-key=thing-0]")
    page.keyboard.press("Control+z")
    assert room_of(page)["thing"][0]["facing_deg"] == moved["facing_deg"]
    page.focus("[data-key=thing-0]")
    page.keyboard.press("Delete")
    assert "thing" not in room_of(page)


def test_a_room_is_saved_opened_and_shared(page: Any, address: str, tmp_path: Path) -> None:
    page.set_input_files("#file", str(EXAMPLE))
    page.wait_for_selector("[data-key=thing-4]")
    with page.expect_download() as download:
        page.click("#save")
    saved = tmp_path / "room.toml"
    download.value.save_as(saved)
    again, first = read_room(saved), read_room(EXAMPLE)
    assert (again.outline, again.doors, again.places) == (first.outline, first.doors, first.places)
    assert [each.at for each in again.things] == [each.at for each in first.things]
    assert [each.item.body for each in again.things] == [each.item.body for each in first.things]
    page.click("#link")
    page.wait_for_selector("#linked:not(:empty)")
    link = page.evaluate("location.href")
    other = page.context.new_page()
    other.goto(link)
    other.wait_for_selector("[data-key=thing-4]")
    assert other.text_content("[data-key=place-0]").strip() == "bed at the window"
    other.close()


def test_what_is_no_room_is_told(page: Any, tmp_path: Path) -> None:
    add(page, "bookcase")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text("outline_m = [[0, 0], [3, 0]]\n", encoding="utf-8")
    page.set_input_files("#file", str(wrong))
    page.wait_for_selector("#told:has-text('no room')")
    assert "three corners" in page.inner_text("#faults")
    assert len(room_of(page)["thing"]) == 1  # what was there stays


def test_faults_are_drawn_where_they_are(page: Any) -> None:
    """In a wall, before a door, and in each other: all at once, each with a number."""
    add(page, "door", "wardrobe", "bookcase")
    for name, value in (("depth_m", "2"), ("width_m", "3")):
        page.locator(f"#field-{name}").fill(value)
        page.locator(f"#field-{name}").blur()
    told = faults(page)
    assert len(told) >= 1
    assert any("stands in a wall" in each for each in told), told
    assert page.locator(".plan .fault").count() == len(told)


def test_a_film_of_the_room(page: Any) -> None:
    """It begins where the plan has things, and shows the one that falls as fallen."""
    add(page, "door", "gas", "bookcase")
    page.fill("#scale", "2")
    with page.expect_response("**/api/room/simulate") as answer:
        page.click("#shake")
    page.wait_for_selector(".trace svg")
    film = answer.value.json()
    places = page.evaluate(
        """async (film) => {
            const { poseAt } = await import("./static/room_view.js");
            return film.things.map((each) => poseAt(film, each, 0).position);
        }""",
        film,
    )
    for thing, place in zip(room_of(page)["thing"], places, strict=True):
        np.testing.assert_allclose(place[:2], thing["at_m"], atol=1e-3)
    assert re.match(r"\d of 2 things fall", page.inner_text("#told"))
    gas = next(each for each in film["things"] if each["name"] == "Gas cylinder")
    assert gas["outcome"] == "falls"
    assert f"Gas cylinder: falls after {gas['time_s']:.3g} s" in page.inner_text("#outcomes")


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_language_says_it_all(page: Any, language: str) -> None:
    add(page, "door", "bed", "bookcase")
    page.click("#many")
    page.wait_for_selector("#found:not([hidden])", timeout=120_000)
    page.select_option("#language", language)
    word = {"en": "The plan", "es": "El plano", "de": "Der Plan"}[language]
    page.wait_for_selector(f"#plan-title:has-text('{word}')")
    summary = {"en": "independent", "es": "independientes", "de": "unabhängigen"}[language]
    page.wait_for_selector(f"#summary:has-text('{summary}')")
    assert serious(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
