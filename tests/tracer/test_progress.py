"""Work that yields its share."""

from __future__ import annotations

from reference_tracer.tracer.progress import Found, Meter, Progress, result_of, scaled


def work():
    yield None
    yield Progress(0.25)
    yield Found("first")
    yield Progress(0.5, "the rest")
    return "done"


def events_of(work):
    events = []
    assert result_of(work, events.append) == "done"
    return events


def test_events_are_passed_on_and_the_result_returned():
    assert events_of(work()) == [None, (0.25, ""), ("first", ""), (0.5, "the rest")]
    assert result_of(work()) == "done"


def test_a_part_of_a_larger_work():
    """Its first step says what it is; its own words stand behind."""
    assert events_of(scaled(work(), 0.5, 0.2)) == [
        None,
        (0.55, ""),
        ("first", ""),
        (0.6, "the rest"),
    ]
    found = events_of(scaled(scaled(work(), 0.5, 0.2, "part"), 0.0, None, "all"))
    words = ["all: part", "all: part", "all: part: the rest"]
    assert [e for e in found if isinstance(e, Progress)] == [(None, w) for w in words]
    assert found[2] == Found("first")


def test_what_is_shown_of_work_never_falls():
    meter = Meter()
    for event in (Progress(0.5, "a"), None, Progress(0.4, "b"), Found(1), Progress(None, "c")):
        meter.read(event)
        assert meter.share == 0.5
    assert meter.words == "c" and meter.seconds(10.0) is None
