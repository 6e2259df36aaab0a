"""What tests of data share: a scene, files of data, and their comparison."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.case import Case
from reference_tracer.comparison.comparing import compared
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.files.scenes import Account
from reference_tracer.opened import file_manifest
from reference_tracer.pictures.given import Making
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer_data.faults import DATA_FAULTS, faults_of_data
from reference_tracer_data.given import GivenData

MAKING = Making()
# The faults of data, and of others a few: all of them take a second for each picture.
BESIDE = "rows", "object_missing", "flipped_winding"
OF_DATA = faults_of_data(FAULTS)
CLIP = [f for f in OF_DATA if f.name.startswith("clip_")]
MOVED = [f for f in OF_DATA if f.name in ("object_moved", "object_missing", "data_scale")]
SOME = [f for f in OF_DATA if f in DATA_FAULTS or f.name in BESIDE]


@pytest.fixture(scope="session")
def solids(make):
    """A ball and a scaled, turned box on a floor, before nothing, from a tilted camera."""
    turned = trimesh.transformations.rotation_matrix(0.4, (1, 2, 3), (0.7, -0.4, -0.3))
    turned = turned @ np.diag((1.0, 0.5, 1.5, 1.0))
    shapes = (
        make.mesh(trimesh.creation.icosphere(2, radius=0.7).apply_translation((-0.6, 0.3, 0.4))),
        make.mesh(trimesh.creation.box((0.8, 0.9, 0.7)), turned),
        make.mesh(trimesh.creation.box((3, 3, 0.1)).apply_translation((0, 0, -0.9))),
    )
    camera = make.camera(32, 24, half=0.3, eye=(3, -4, 2), target=(0, 0, 0))
    return replace(make.scene(camera, *shapes), objects=("Ball", "Box", "Floor"))


@pytest.fixture(scope="session")
def traced(solids):
    return render(solids)


@pytest.fixture
def judged(solids, tmp_path):
    """Return the function that compares the scene with values of a kind, as .npy or by `save`."""

    def run(kind, values, scene=solids, name="data.npy", save=np.save, making=MAKING, **known):
        path = tmp_path / name
        save(path, values)
        shown = GivenData(kind, path, **known).picture(scene, making)
        manifest = file_manifest(path, scene, Account())
        case = Case(scene, manifest, Settings(), shown)
        return result_of(compared(case))

    return run


@pytest.fixture
def told(judged):
    """Return the function that compares likewise, for the names of what is told."""

    def run(*arguments, faults=OF_DATA, **known):
        found = judged(*arguments, **known)
        assert found.counts.unexplained > 10
        said = result_of(diagnose(found.case, found.frame, found.causes, faults, np.inf))
        return [one.fault.name for one in said.told]

    return run
