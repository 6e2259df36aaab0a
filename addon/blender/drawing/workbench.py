"""Workbench as a judge: a render by the engine that also draws the solid viewport."""

from __future__ import annotations

from .judge import Judge

WORKBENCH = Judge(
    name="workbench",
    label="Workbench",
    description="A Workbench render: render visibility and modifier levels",
    number=1,
    engine="BLENDER_WORKBENCH",
    ignores=("display type", "holdout", "not visible to the camera", "indirect only"),
)
