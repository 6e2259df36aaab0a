"""Names the system libraries that bpy needs and this machine lacks, before bpy is imported.

Without this an `import bpy` ends in a linker error, or a render in no picture at all. Prints each
missing library with its Debian package and exits 1; with --packages only the packages' names.
"""

import ctypes
import importlib.util
import re
import subprocess
import sys
from pathlib import Path

# Library -> Debian's package. Others are named too, only without a package.
DEBIAN_PACKAGES = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libICE.so.6": "libice6",
    "libSM.so.6": "libsm6",
    "libX11.so.6": "libx11-6",
    "libXext.so.6": "libxext6",
    "libXfixes.so.3": "libxfixes3",
    "libXi.so.6": "libxi6",
    "libXrender.so.1": "libxrender1",
    "libXxf86vm.so.1": "libxxf86vm1",
    "libgomp.so.1": "libgomp1",
    "libxkbcommon.so.0": "libxkbcommon0",
}
EGL_DRIVER = "an OpenGL driver for EGL"
DRIVER_PACKAGES = ["libegl-mesa0", "libgl1-mesa-dri"]

EGL_PLATFORM_SURFACELESS = 0x31DD  # Mesa's platform without any screen


def linked_libraries_missing(bpy_folder: Path) -> list[str]:
    """Libraries that the linker does not find for bpy itself."""
    [module] = bpy_folder.glob("__init__*.so")
    lines = subprocess.run(["ldd", module], capture_output=True, text=True, check=True).stdout
    return sorted(set(re.findall(r"^\s*(\S+) => not found", lines, flags=re.MULTILINE)))


def egl_missing() -> list[str]:
    """Blender opens EGL only when it draws: see that it opens, and that a driver answers."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError:
        return ["libEGL.so.1", EGL_DRIVER]
    egl.eglGetDisplay.restype = egl.eglGetPlatformDisplay.restype = ctypes.c_void_p
    displays = [
        egl.eglGetDisplay(None),
        egl.eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS, None, None),
    ]
    for display in displays:
        if display and egl.eglInitialize(ctypes.c_void_p(display), None, None):
            return []
    return [EGL_DRIVER]


def packages_of(library: str) -> list[str]:
    """Debian's packages for a library; none where it isn't known."""
    if library == EGL_DRIVER:
        return DRIVER_PACKAGES
    return [DEBIAN_PACKAGES[library]] if library in DEBIAN_PACKAGES else []


def main() -> int:
    if not sys.platform.startswith("linux"):
        return 0  # elsewhere the wheel brings all it needs
    spec = importlib.util.find_spec("bpy")  # finds, does not import
    if spec is None or spec.origin is None:
        print("check_libraries: bpy is not installed in this Python", file=sys.stderr)
        return 1
    missing = linked_libraries_missing(Path(spec.origin).parent) + egl_missing()
    if "--packages" in sys.argv[1:]:
        print(*[package for library in missing for package in packages_of(library)])
    else:
        for library in missing:
            packages = " ".join(packages_of(library)) or "not known"
            print(f"bpy needs {library} (Debian package: {packages})", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
