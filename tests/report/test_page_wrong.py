"""The page of a comparison with something wrong: map, marks, frames and the diagnosis."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import jsonschema
import numpy as np
import pytest
from reference_tracer.causes.cause import UNEXPLAINED
from reference_tracer.comparison.comparing import compare
from reference_tracer.comparison.comparing import diagnosed as find_diagnosis
from reference_tracer.diagnosis.diagnosis import Diagnosis, Told
from reference_tracer.diagnosis.faults.fault import Fault, Numbers, of_camera
from reference_tracer.diagnosis.regions import regions
from reference_tracer.files.images import to_display
from reference_tracer.report import page
from reference_tracer.report.page.content import content
from reference_tracer.tracer.progress import result_of

from .browser import both, color_at, settled, shown, state
from .conftest import FOREIGN
from .test_page import validator

RED = (255, 0, 0)
SENTENCE = "the camera's rays pass the pixels' corners, not their centres: (+0.500, +0.500) px"


@pytest.fixture
def wrong(compared, room):
    """Return a comparison in which a block, or more, of the picture has a colour of no surface."""

    def made(*blocks):
        def change(picture):
            for rows, columns in blocks:
                picture[rows, columns] = FOREIGN

        return compared(room(), change)

    return made


BLOCKS = (slice(4, 8), slice(30, 40)), (slice(20, 22), slice(5, 7)), (slice(34, 35), slice(44, 45))


FAULT = Fault(
    "pixel_offset",
    SENTENCE,
    "Corners are taken for centres.",
    "Add half a pixel.",
    of_camera(lambda camera: None),
)


def diagnosed(comparison, told=1, side="traced", **changed):
    """Return the comparison with a diagnosis, and the pictures with its faults put right."""
    frame, picture = comparison.frame, comparison.picture
    color = frame.color if side == "traced" else picture
    pictures = [np.roll(color, k + 1, axis=0) for k in range(told)]
    faults = []
    for k, right in enumerate(pictures):
        traced = replace(frame, color=right) if side == "traced" else frame
        shown = right if side == "blender" else picture
        fault = replace(FAULT, numbers=("dx", "dy"), sentence="<b>another</b>" if k else SENTENCE)
        guess = Numbers((0.5, 0.25), (0.498, 0.25), (0.502, 0.25))
        of = Told(fault, guess, 3307, 3300, 515093, k, traced, shown, alternative=bool(k))
        faults.append(replace(of, **changed))
    left = regions(comparison.causes.cause == UNEXPLAINED)[1:2]
    found = Diagnosis(tuple(faults), 41, 900, 3.2, (), sum(r.pixels for r in left), tuple(left))
    return replace(comparison, diagnosis=found), pictures


def test_a_diagnosis_is_as_the_schema_says(wrong):
    for told in (0, 1, 2):
        comparison, _ = diagnosed(wrong(*BLOCKS), told)
        held = json.loads(page.json_text(content(comparison)))
        validator().validate(held)
    held["comparison"]["diagnosis"]["told"][0].pop("settled")
    with pytest.raises(jsonschema.ValidationError):
        validator().validate(held)


def test_a_real_diagnosis_is_on_the_page(compared, room):
    """Rows from top to bottom are either side's fault: each is put right to be the other's."""

    def flipped(picture):
        picture[:] = picture[::-1].copy()

    comparison = result_of(find_diagnosis(compared(room(), flipped)))
    held = json.loads(page.json_text(content(comparison)))
    validator().validate(held)
    found = held["comparison"]["diagnosis"]["told"]
    told = [one["fault"] for one in found]
    assert set(told) == {"mirrored_y", "rows"}
    rows = found[told.index("rows")]
    assert rows["sentence"] == "the picture is upside down" and "first-row=top" in rows["advice"]
    pictures = {p["id"]: p for p in held["pictures"]}
    for fault, of, other in (("rows", "blender", "traced"), ("mirrored_y", "traced", "blender")):
        right = pictures[f"put_right_{told.index(fault)}"]
        assert right["of"] == of and right["png"] == pictures[other]["png"]


def test_what_changes_no_picture_has_none(wrong):
    comparison, _ = diagnosed(wrong(*BLOCKS))
    same = replace(comparison.diagnosis.told[0], frame=comparison.frame)
    comparison = replace(comparison, diagnosis=replace(comparison.diagnosis, told=(same,)))
    shown: Any = content(comparison)["pictures"]
    assert [p["id"] for p in shown] == ["traced", "blender"]


@pytest.mark.browser
def test_differences_open_on_the_map_with_every_region_framed(show, wrong):
    tab = show(wrong(*BLOCKS))
    assert (state(tab, "right"), state(tab, "split")) == ("causes", 0)
    r, g, b = color_at(tab, 35, 5, v=0.05)
    assert r > 200 and max(g, b) < 50
    settled(tab)
    boxes = tab.evaluate("() => page.regions.map((r) => frameOf(panes()[0], r))")
    for box, (rows, columns) in zip(boxes, BLOCKS, strict=True):
        left, bottom = tab.evaluate(
            "([x, y]) => toPane(panes()[0], x, y)", [columns.start, rows.start]
        )
        right, top = tab.evaluate("([x, y]) => toPane(panes()[0], x, y)", [columns.stop, rows.stop])
        assert box["x"] < left and box["x"] + box["width"] > right
        assert box["y"] < top and box["y"] + box["height"] > bottom
        # The frame's line, beside its middle.
        drawn = tab.evaluate(
            """([x, y]) => {
              const some = new OffscreenCanvas(5, 1).getContext("2d");
              some.drawImage(document.getElementById("canvas"), x - 2, y, 5, 1, 0, 0, 5, 1);
              return [...some.getImageData(0, 0, 5, 1).data];
            }""",
            [round(box["x"]), round(box["y"] + box["height"] / 2)],
        )
        assert any(r > 200 and max(g, b) < 60 for r, g, b, _ in np.reshape(drawn, (5, 4)))
    said = tab.locator("#regions").inner_text()
    assert "3 regions" in said and "40 px" in said
    tab.locator("#regions button").nth(1).click()
    assert (state(tab, "x"), state(tab, "y")) == (5, 20)
    assert state(tab, "view")["scale"] > 1


@pytest.mark.browser
def test_agreement_opens_on_the_pictures_without_a_frame(show, wrong):
    tab = show(wrong())
    assert (state(tab, "left"), state(tab, "right")) == ("traced", "blender")
    assert not tab.locator("#regions").is_visible()
    assert not tab.locator("#diagnosis").is_visible() and not tab.locator("#told").is_visible()


@pytest.mark.browser
def test_colours_that_are_changed_as_a_whole_are_what_is_wrong(show, compared, room):
    """And both pictures are seen, not the marks that would cover them."""

    def brighter(picture):
        picture[..., :3] *= 1.25

    plain = compared(room(), brighter)
    comparison = result_of(compare(replace(plain.case, curves=()), plain.frame))
    assert comparison.causes.transform and not comparison.counts.unexplained
    tab = show(comparison)
    said = tab.locator("#told").inner_text()
    assert said.startswith(f"Diagnosis: the picture's colours: {comparison.causes.transform}. ")
    assert "check the colour space of each file" in said
    glance = tab.locator("header").inner_text()
    assert "are explained" not in glance and "as it should be" not in glance
    shown = [state(tab, k) for k in ("left", "right", "mode", "marks")]
    assert shown == ["traced", "blender", "pair", False]


@pytest.mark.browser
@pytest.mark.parametrize("only", [False, True])
def test_marks_too_dense_for_one_each_are_painted_and_it_says_so(show, wrong, only):
    tab = show(wrong((slice(3, 33), slice(4, 44))))
    assert (state(tab, "mode"), state(tab, "marks")) == ("pair", False)  # no wall of red
    both(tab)
    tab.evaluate("() => { select(0, 35); change({ view: { ...state.view } }); }")
    if only:
        tab.locator('[data-cause="unexplained"]').click()
    # From afar the marks of 48 x 36 pixels are near ones on a large stage: a small one is far.
    tab.evaluate("() => { stage.style.minHeight = 0; stage.style.height = '200px'; redraw(); }")
    settled(tab)
    assert tab.evaluate("() => scaleNow()") < 10
    for x, y in ((10, 10), (30, 20), (40, 31)):
        assert color_at(tab, x, y, v=0.5) == RED
    note = tab.locator("#marks-note").inner_text()
    assert "Unexplained (1,200 px)" in note and "painted" in note
    tab.locator("#marks").uncheck()
    settled(tab)
    assert color_at(tab, 10, 10) != RED


@pytest.mark.browser
def test_from_near_dense_marks_leave_the_pixels_colour_to_be_seen(show, wrong):
    comparison = wrong((slice(3, 33), slice(4, 44)))
    tab = show(comparison)
    both(tab)
    tab.evaluate("() => { select(0, 35); change({ split: 0 }); setView(24, 18, 30); }")
    settled(tab)
    expected = shown(comparison.picture[18, 20])
    assert color_at(tab, 20, 18, u=0.6, v=0.6) == expected
    assert color_at(tab, 20, 18, u=0.2, v=0.2) != expected  # the mark in the corner
    assert "small one in a corner" in tab.locator("#marks-note").inner_text()


@pytest.mark.browser
def test_marks_that_stand_for_several_pixels_say_so(show, wrong):
    tab = show(wrong((slice(4, 5), slice(5, 9))))
    tab.evaluate("() => { stage.style.minHeight = 0; stage.style.height = '200px'; redraw(); }")
    settled(tab)
    assert "stands for all pixels of its cause" in tab.locator("#marks-note").inner_text()
    tab.evaluate("() => setView(7, 5, 40)")
    settled(tab)
    assert not tab.locator("#marks-note").is_visible()


@pytest.mark.browser
def test_a_diagnosis_is_a_card_with_its_figures(show, wrong):
    comparison, _ = diagnosed(wrong(*BLOCKS), told=2)
    tab = show(comparison, held=content(comparison))
    assert SENTENCE in tab.locator("#told").inner_text()
    card = tab.locator("#diagnosis")
    first, second = (f.inner_text() for f in card.locator(".fault").all())
    assert "3,300 of 3,307 unexplained pixels agree, and none that agreed is lost." in first
    assert (
        second.startswith("Or, as likely: ")
        and "1 that agreed is lost" in second
        and "<b>another</b>" in second
    )
    rows = first.replace("\t", "\n")
    assert "dx\n0.5" in rows and "dy\n0.25" in rows
    assert "0.498" not in rows  # pixels are left: nothing is known of how far it may be off
    assert "41 guesses" in card.inner_text() and "Nothing accounts for 4 px, in one region" in (
        card.inner_text()
    )


@pytest.mark.browser
@pytest.mark.parametrize("side", ["traced", "blender"])
def test_its_slider_uncovers_the_picture_put_right(show, wrong, side):
    comparison, [right] = diagnosed(wrong(*BLOCKS), side=side)
    tab = show(comparison, held=content(comparison))
    ends = ["put_right_0", "blender"]  # theirs as it is, whichever side is put right
    assert [state(tab, k) for k in ("left", "right", "mode", "marks")] == [*ends, "pair", False]
    said = tab.locator("#regions")
    assert "41 of 45 unexplained" in said.inner_text() and not said.locator("button").count()
    first, second, _ = tab.locator(".put-right .views figure").all()
    own = {"traced": comparison.frame.color, "blender": comparison.picture}[side]
    for figure in (first, second):  # 48 x 36 pixels are all in the close-up
        as_it_is, put_right = (
            np.reshape(
                canvas.evaluate(
                    """c => [...c.getContext("2d").getImageData(0, 0, c.width, c.height).data]"""
                ),
                (36, 48, 4),
            )[::-1]
            for canvas in figure.locator("canvas").all()
        )
        assert np.array_equal(as_it_is, to_display(own))
        assert np.array_equal(put_right, to_display(right))
    slider = tab.locator(".put-right input")
    clip = "c => getComputedStyle(c).clipPath"
    for value in (0, 50, 100):
        slider.fill(str(value))
        assert f"{value}%" in first.locator("canvas").nth(1).evaluate(clip) or value == 0
    tab.locator(".put-right button").click()
    assert state(tab, "left") == "put_right_0" and state(tab, "mode") == "pair"


@pytest.mark.browser
def test_nothing_found_is_said(show, wrong):
    comparison, _ = diagnosed(wrong(*BLOCKS), told=0)
    tab = show(comparison, held=content(comparison))
    assert "None accounts for" in tab.locator("#diagnosis").inner_text()
    assert "no known fault accounts for 4 px, the most" in tab.locator("#told").inner_text()


@pytest.mark.browser
def test_a_clear_colour_names_the_pictures_object(show, wrong):
    comparison = wrong(*BLOCKS)
    tab = show(comparison)
    found = tab.evaluate("() => Array.from(pixels.surface, (_, pixel) => objectByColor(pixel))")
    frame = comparison.frame
    names = [*comparison.scene.objects, "nothing"]  # the last: that of -1
    for name, index in zip(found, frame.object_index.ravel(), strict=True):
        assert name in (f"{names[index]}, by its colour", "not known")
    known = np.reshape([name != "not known" for name in found], frame.object_index.shape)
    assert known.mean() > 0.5 and not any(known[block].any() for block in BLOCKS)


LONG = "/home/someone/projects/2026/a very long folder's name/shots/scene_with_a_name_012.blend"


@pytest.mark.browser
@pytest.mark.parametrize(
    "size",
    [
        (1280, 800),
        (390, 844),
        *(
            pytest.param(size, marks=pytest.mark.torture)
            for size in ((1280, 720), (1366, 768), (1024, 700), (1920, 1080))
        ),
    ],
)
@pytest.mark.parametrize("large", [False, True])
def test_nothing_in_the_header_overlaps(show, wrong, size, large):
    comparison = wrong(*BLOCKS)
    case = comparison.case
    manifest = replace(case.manifest, file=LONG)
    comparison, _ = diagnosed(replace(comparison, case=replace(case, manifest=manifest)))
    tab = show(
        comparison,
        held=content(comparison),
        viewport=dict(zip(("width", "height"), size, strict=True)),
    )
    if large:
        tab.locator("#large").click()
    names = ".brand", ".tools", "#title", "#subtitle", "#verdict", "#headline", "#told", "#score"
    boxes = {name: tab.locator(name).bounding_box() for name in names}
    assert tab.locator("#title").inner_text() == "scene_with_a_name_012.blend"
    for k, one in enumerate(names):
        for other in names[k + 1 :]:
            a, b = boxes[one], boxes[other]
            assert (
                a["x"] + a["width"] <= b["x"] + 0.5
                or b["x"] + b["width"] <= a["x"] + 0.5
                or a["y"] + a["height"] <= b["y"] + 0.5
                or b["y"] + b["height"] <= a["y"] + 0.5
            ), (one, other)


BROKEN = """() => {
  const found = [];
  const walk = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  for (let node; (node = walk.nextNode()); ) {
    if (!node.parentElement.checkVisibility()) continue;
    for (const { 0: text, index } of node.data.matchAll(/[−\\d][\\d.,]*\\d(e[−+]?\\d+)?/g)) {
      const range = document.createRange();
      range.setStart(node, index);
      range.setEnd(node, index + text.length);
      if (new Set([...range.getClientRects()].map((r) => Math.round(r.top))).size > 1)
        found.push(text);
    }
  }
  return found;
}"""


@pytest.mark.browser
@pytest.mark.parametrize("width", [360, 390, 768, 1280])
def test_no_number_is_broken_and_wide_tables_say_that_they_scroll(show, wrong, width):
    comparison = wrong(*BLOCKS)
    tab = show(comparison, viewport={"width": width, "height": 844})
    tab.evaluate("() => document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    settled(tab)
    assert tab.evaluate(BROKEN) == []
    tables = tab.evaluate(
        """() => [...document.querySelectorAll(".scroll:has(> table)")].map((box) => [
          box.scrollWidth > box.clientWidth, box.querySelector(".scrolls").checkVisibility()])"""
    )
    assert len(tables) > 2 and all(wide == said for wide, said in tables)
    assert any(said for _, said in tables) or width > 400
