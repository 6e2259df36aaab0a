"""All attacks, and which cause each imitates."""

from __future__ import annotations

import numpy as np
from reference_tracer.causes.cause import Cause
from reference_tracer.causes.explain import (
    ANTI_ALIASING,
    CAUSES,
    CLIP_PLANE,
    COLOR,
    DEPTH_TIE,
    EDGE,
    HIDDEN,
    NOT_DECIDABLE,
    NOT_MODELLED,
)

from .blocks import blocks_of_another, blocks_of_what_is_behind, grown, shrunk
from .colors import (
    SHADES,
    all_but_one,
    half_pixel,
    moved,
    noise,
    one_recoloured,
    rearranged,
)
from .mixes import beyond_the_filter, of_no_one_near, overshot
from .one_sided import another_is_gone, beside_the_box, gone_and_moved, partly_gone
from .subject import Attack
from .surfaces import a_frame_off, clipped, dropped_instance, object_moved, swapped_depth

ATTACKS = (
    *(Attack(f"moved_{n}", EDGE, f"the picture moved by {n} px", moved(n)) for n in (1, 2, 3)),
    *(
        Attack(f"object_moved_{n}", EDGE, f"one object moved by {n} px", object_moved(n))
        for n in (1, 2, 3)
    ),
    Attack("grown", EDGE, "a line one pixel wide around an object", grown),
    Attack("shrunk", EDGE, "an object's outermost pixels left out", shrunk),
    Attack("half_pixel", ANTI_ALIASING, "the picture resampled by half a pixel", half_pixel),
    Attack("overshot", ANTI_ALIASING, "sharpened edges in an anti-aliased picture", overshot),
    Attack(
        "beyond_the_filter",
        ANTI_ALIASING,
        "edges smeared farther than the filter reaches",
        beyond_the_filter,
    ),
    Attack(
        "of_no_one_near",
        ANTI_ALIASING,
        "edges in a colour that no filter reaches",
        of_no_one_near,
    ),
    Attack("swapped_depth", DEPTH_TIE, "the farther of two objects shown", swapped_depth),
    Attack(
        "blocks_of_what_is_behind",
        DEPTH_TIE,
        "holes that show what lies behind",
        blocks_of_what_is_behind,
    ),
    Attack("blocks_of_another", EDGE, "blocks in another object's colour", blocks_of_another),
    Attack("clip_start", CLIP_PLANE, "surfaces cut behind the clip start", clipped(False)),
    Attack("clip_end", CLIP_PLANE, "surfaces cut before the clip end", clipped(True)),
    *(
        Attack(f"one_{name}", COLOR, f"one object of many {words}", one_recoloured(of))
        for (name, of), words in zip(
            SHADES.items(),
            (
                "half as bright",
                "brighter by 0.75 stops",
                "with a gamma of 1.8",
                "with red and blue swapped",
                "with sRGB's curve twice",
            ),
            strict=True,
        )
    ),
    *(
        Attack(
            f"all_but_one_{name}",
            COLOR,
            "one object left out of a transform",
            all_but_one(of),
        )
        for name, of in SHADES.items()
    ),
    Attack("beside_the_box", NOT_MODELLED, "damage beside a feature's box", beside_the_box),
    Attack("dropped_instance", HIDDEN, "an instance left out", dropped_instance),
    Attack("a_frame_off", HIDDEN, "the frame after this one", a_frame_off),
    Attack("another_is_gone", HIDDEN, "not the object that a flag hides", another_is_gone),
    Attack("partly_gone", HIDDEN, "holes in an object that a flag hides", partly_gone),
    Attack("gone_and_moved", HIDDEN, "damage besides an object that is gone", gone_and_moved),
    Attack(
        "mirrored_x",
        NOT_DECIDABLE,
        "the picture mirrored left to right",
        rearranged(np.fliplr),
    ),
    Attack(
        "mirrored_y",
        NOT_DECIDABLE,
        "the picture mirrored upside down",
        rearranged(np.flipud),
    ),
    Attack("noise", NOT_DECIDABLE, "random colours of random objects", noise),
)


def withstood() -> dict[Cause, tuple[str, ...]]:
    """Return which attacks each cause withstands, in words: for the documents."""
    return {
        cause: tuple(dict.fromkeys(a.text for a in ATTACKS if a.imitates is cause))
        for cause in CAUSES
        if cause.explains or cause is NOT_DECIDABLE
    }
