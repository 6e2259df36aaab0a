# Only what pyproject.toml can't say: find the packages in a folder that bears another name.
from setuptools import find_packages, setup

PACKAGES = {  # by the folder that each stands in
    "addon": "reference_tracer",
    "packages/grading": "reference_tracer_grading",
    "packages/benchmarks": "reference_tracer_benchmarks",
    "packages/cameras": "reference_tracer_cameras",
    "packages/cluster": "reference_tracer_cluster",
    "packages/conformance": "reference_tracer_conformance",
    "packages/data": "reference_tracer_data",
    "packages/meshes": "reference_tracer_meshes",
    "packages/rays": "reference_tracer_rays",
    "packages/processes": "reference_tracer_processes",
    "packages/visible": "reference_tracer_visible",
    "packages/verify": "reference_tracer_verify",
    "packages/scene_diff": "reference_tracer_scene_diff",
}
found = [f"{name}.{sub}" for folder, name in PACKAGES.items() for sub in find_packages(folder)]
setup(packages=[*PACKAGES.values(), *found])
