"""`blender -b` and `blender --command` of a whole Blender: files, exit codes, faults."""


import pytest

pytestmark = pytest.mark.gui

SCENE = "/project/sample_scenes/exercise_perspective.blend"
