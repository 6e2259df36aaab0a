# Only what pyproject.toml can't say: find the packages in a folder that bears another name.
from setuptools import find_packages, setup

subpackages = [f"reference_tracer.{name}" for name in find_packages("addon")]
setup(packages=["reference_tracer", *subpackages])
