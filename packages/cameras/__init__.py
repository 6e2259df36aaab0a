"""Cameras of more programs: records like the add-on's, which finds them by an entry point."""

from .bop import BOP
from .kubric import KUBRIC
from .mitsuba import MITSUBA
from .mvsnet import MVSNET
from .open3d import OPEN3D
from .pytorch3d import PYTORCH3D
from .splatting import SPLATTING

CONVENTIONS = MITSUBA, PYTORCH3D, OPEN3D, BOP, SPLATTING, KUBRIC, MVSNET
