"""Read hostile files in a process whose memory is limited; run by test_hostile_files.py.

In come a folder of valid files, a seed, and which cases; out goes a line of JSON for each case that
went wrong, and one for all. The number of the case at work is in the file `at`: if this process
dies, that one has killed it.
"""

from __future__ import annotations

import json
import resource
import signal
import sys
import traceback
import warnings
from collections import Counter
from contextlib import redirect_stdout
from dataclasses import replace
from pathlib import Path

import numpy as np

MEMORY = 2 << 30  # bytes of address space beyond what the libraries take
PATIENCE = 60  # seconds for one file, so that a hang is found; what it costs is no question here
TRACED = 8  # one scene of so many that can be read

FOLDER, SEED, FIRST, COUNT = sys.argv[1], *map(int, sys.argv[2:5])
sys.path.insert(0, str(Path(__file__).parent))
from mutations import mutated  # noqa: E402
from reference_tracer.cli.opening import load  # noqa: E402
from reference_tracer.derivation import document, reproducer  # noqa: E402
from reference_tracer.derivation.derivation import derive_pixel  # noqa: E402
from reference_tracer.errors import EXPECTED, words  # noqa: E402
from reference_tracer.files.images import open_picture  # noqa: E402
from reference_tracer.framing import Choice  # noqa: E402
from reference_tracer.rendering import render  # noqa: E402
from reference_tracer.scene import Region  # noqa: E402
from reference_tracer_data.depth import DEPTH  # noqa: E402
from reference_tracer_data.files import read as read_data  # noqa: E402
from reference_tracer_rays.files import load_rays  # noqa: E402
from reference_tracer_verify.verify import RefusedError, verified  # noqa: E402

PICTURES = ".png", ".exr"
OTHERS = {  # by the begin of a file's name
    "depth": lambda path: read_data(path, DEPTH),
    "rays": load_rays,
    "certificate": verified,
}


def read(path: Path, thorough: bool) -> None:
    """Read a file as the commands do, and use what it holds."""
    if (kind := path.stem.partition(" ")[0]) in OTHERS:
        OTHERS[kind](path)
    elif path.suffix in PICTURES:
        picture = open_picture(path).read()
        assert picture.color.dtype == np.float32 and picture.color.shape[2:] == (4,)
    elif path.suffix == ".json":
        pixel = reproducer.read(path)
        if thorough:
            document.document_markdown(derive_pixel(pixel))
    else:
        with redirect_stdout(sys.stderr):  # what is said of it
            scene, _ = load(path, Choice(width=8, height=8))
        for mesh in scene.meshes:
            assert np.isfinite(mesh.vertices).all()
        if thorough:
            small = replace(scene.camera, width=8, height=8, region=Region(0, 0, 8, 8))
            frame = render(replace(scene, camera=small))
            assert frame.color.shape == (8, 8, 4)


def main() -> None:
    valid = sorted(Path(FOLDER, "valid").iterdir())
    contents = [path.read_bytes() for path in valid]
    found: Counter[str] = Counter()
    for path in valid:  # also loads every library before memory is limited
        read(path, True)
    limited = (
        int(Path("/proc/self/statm").read_text("utf-8").split()[0]) * resource.getpagesize()
        + MEMORY
    )
    resource.setrlimit(resource.RLIMIT_AS, (limited, limited))
    warnings.simplefilter("error", RuntimeWarning)
    warnings.simplefilter("error", UserWarning)
    for case in range(FIRST, FIRST + COUNT):
        Path(FOLDER, "at").write_text(str(case), "utf-8")
        rng = np.random.default_rng((SEED, case))
        number = case % len(valid)
        suffix = valid[number].suffix
        other = contents[rng.integers(len(contents))]
        path = Path(FOLDER, f"{valid[number].stem} hostile{suffix}")
        path.write_bytes(mutated(suffix, contents[number], rng, other))
        signal.alarm(PATIENCE)
        try:
            read(path, case // len(valid) % TRACED == 0)
            found[f"{suffix} read"] += 1
        except Exception as error:
            said = words(error)
            names = path.name in said or isinstance(error, (MemoryError, RefusedError))
            if isinstance(error, (*EXPECTED, RefusedError)) and names:
                found[f"{suffix} refused"] += 1
            else:
                lines = traceback.format_exception(error)[-4:]
                print(json.dumps({"case": case, "suffix": suffix, "error": lines}), flush=True)
        signal.alarm(0)
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(json.dumps({"found": found, "memory": most}), flush=True)


main()
