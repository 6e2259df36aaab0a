"""Writes what a user downloads to dist/release/, of the last commit: same commit, same bytes.

The extension, the Python package (sdist and wheel), the notes, the checksums; index.json, which
makes the folder's address one that Blender takes for a repository of extensions; index.html, the
page of it all, which links only to what is beside it; and two that have other bytes each time:
try.html, the page of a comparison, which says how long that took, and the lesson pack, if
`make lessons` has built it of this commit. `make release ADDRESS=https://...` runs it, in a Python
that has bpy: the project's address, where its files have a placeholder.
"""

import argparse
import base64
import gzip
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import tomllib
import zipfile
from pathlib import Path

from build_extension import PROJECT, BuildError, blenders_tool, run, text_of

PLACEHOLDER = "https://example.org/reference-tracer"
# What has it: the files that users see.
ADDRESSED = "README.md", "CITATION.cff", "blender_manifest.toml", "pyproject.toml"
# The comparison to try is the one of the moving picture: another angle of view than the scene's.
TRIED = ("sample_scenes/suzanne.blend", "--set", "eye=4,-7.5,3.6", "target=0,0,1", "width=320",
         "height=180")  # fmt: skip
ANGLES = "38", "40"
COURSE = """<h2>In a course</h2>
<p><a href="{0}">{0}</a> has all that four lessons need: unpack it, and open its index.html.</p>

"""


def git(*arguments: str) -> bytes:
    return subprocess.run(
        ["git", *arguments], cwd=PROJECT, check=True, stdout=subprocess.PIPE
    ).stdout


def newest(changelog: str) -> tuple[str, str, str]:
    """The version, the date in brackets and the text of the newest section of CHANGELOG.md."""
    _, heading, text, *_ = re.split(r"^## (.+)\n", changelog, flags=re.MULTILINE)
    version, _, date = heading.partition(" ")
    return version, date.strip("()"), text.strip() + "\n"


def check(status: str, tags: list[str], manifest: str, changelog: str) -> None:
    """Refuse what nobody could tell by its version or make again.

    Takes what git says of the folder and of the last commit, and the texts of the two files.

    Raises
    ------
    BuildError
        Where something is not committed, or the names of the version differ.
    """
    if status:
        raise BuildError(f"not committed, so not in a release: commit or stash\n{status}")
    version, date, _ = newest(changelog)
    named = tomllib.loads(manifest)["version"]
    if named != version:
        raise BuildError(
            f"version {named} in blender_manifest.toml, but {version} is the newest in CHANGELOG.md"
        )
    if tags and f"v{version}" not in tags:
        raise BuildError(f"the commit's tag is {tags[0]}, but its version {version}")
    if tags and date == "unreleased":
        raise BuildError(f"CHANGELOG.md says that {version}, which is tagged, is unreleased")


def date_zip(path: Path, seconds: int) -> None:
    """Write a zip anew: in the order of names, with one date and the same rights everywhere."""
    with zipfile.ZipFile(path) as old:
        contents = {name: old.read(name) for name in sorted(old.namelist())}
    with zipfile.ZipFile(path, "w") as new:
        for name, content in contents.items():
            entry = zipfile.ZipInfo(name, time.gmtime(seconds)[:6])
            entry.create_system, entry.external_attr = 3, 0o100644 << 16
            packed = zipfile.ZIP_STORED if name.endswith(".whl") else zipfile.ZIP_DEFLATED
            new.writestr(entry, content, packed, 9)


def date_tar(path: Path, seconds: int) -> None:
    """Write a .tar.gz anew, likewise, and without the owner's name."""
    plain = io.BytesIO()
    plainly = {"fileobj": plain, "mode": "w", "format": tarfile.USTAR_FORMAT}
    with tarfile.open(path) as old, tarfile.open(**plainly) as new:
        for entry in sorted(old, key=lambda entry: entry.name):
            rights = 0o755 if entry.isdir() else 0o644
            same = {"mtime": seconds, "mode": rights, "uid": 0, "gid": 0, "uname": "", "gname": ""}
            new.addfile(entry.replace(**same), old.extractfile(entry))
    path.write_bytes(gzip.compress(plain.getvalue(), mtime=seconds))


def addressed(source: Path, address: str) -> None:
    """Put the project's address in the place of the placeholder, in each file that has it.

    Raises
    ------
    BuildError
        Where it is no address.
    """
    if not re.fullmatch(r"https?://[\w.-]+(:\d+)?(/[\w.~-]+)*", address):
        raise BuildError(f"ADDRESS is no https://... without a slash at its end: {address}")
    for path in (source / name for name in ADDRESSED):
        path.write_bytes(path.read_bytes().replace(PLACEHOLDER.encode(), address.encode()))


def build(work: Path, address: str, tried: bool) -> Path:
    """Build everything in a folder for the work; returns the folder of what is released."""
    source, out = work / "source", work / "release"
    out.mkdir()
    with tarfile.open(fileobj=io.BytesIO(git("archive", "HEAD"))) as committed:
        committed.extractall(source, filter="data")
    addressed(source, address)
    if (PROJECT / "wheels").exists():  # what was fetched once
        shutil.copytree(PROJECT / "wheels", source / "wheels")
    seconds = int(git("log", "-1", "--format=%ct"))
    os.environ["SOURCE_DATE_EPOCH"] = str(seconds)  # the wheel's date
    os.umask(0o022)  # the rights in the wheel

    run(source / "tools/build_extension.py", "--out", out)
    [extension] = out.glob("*.zip")
    date_zip(extension, seconds)

    sdist = [sys.executable, "setup.py", "--quiet", "sdist", "--dist-dir", out]
    subprocess.run(sdist, cwd=source, check=True)
    [sdist] = out.glob("*.tar.gz")
    date_tar(sdist, seconds)
    # From the sdist, which shows that it is whole.
    run("-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "-w", out, sdist)

    lessons = lesson_pack(work, out)
    page = work / "page.html"
    page.write_text(template(source, out, address, lessons), encoding="utf-8")
    run(blenders_tool(), "server-generate", "--repo-dir", out, "--html", "--html-template", page)
    for path in lessons:  # not before, since it is no extension
        shutil.move(path, out)
    notes = newest(text_of("CHANGELOG.md"))[2]
    notes = re.sub(r"\[([^]]+)\]\((?!https?:)[^)]+\)", r"\1", notes)  # no document is beside it
    (out / "NOTES.md").write_bytes(notes.encode())
    (out / "SHA256SUMS").write_bytes(sums(sorted(out.iterdir())).encode())
    if tried:
        shutil.copy(compared(work, source), out / "try.html")
    return out


def lesson_pack(work: Path, out: Path) -> list[Path]:
    """Zip the lesson pack, with what is released in it; none if it is not of the last commit."""
    built = PROJECT / "dist/lessons"
    of = built / "commit.txt"
    if not of.exists() or of.read_bytes() != git("rev-parse", "HEAD"):
        return []
    pack = work / "lessons"
    shutil.copytree(built, pack)
    [extension], [wheel] = out.glob("*.zip"), out.glob("*.whl")
    for path in (extension, wheel):
        shutil.copy(path, pack)
    lite = pack / "lite"
    index = lite / "pypi/all.json"
    text = replaced(lite / "pypi" / wheel.name, wheel.read_bytes(), index)
    settings = lite / "jupyter-lite.json"
    settings.write_text(replaced(index, text.encode(), settings), encoding="utf-8")
    return [Path(shutil.make_archive(str(work / f"{extension.stem}-lessons"), "zip", pack))]


def replaced(path: Path, content: bytes, index: Path) -> str:
    """Write a file anew; return the text that lists it, with its new digests and size."""
    old, text = path.read_bytes(), index.read_text(encoding="utf-8")
    path.write_bytes(content)
    for digest in (hashlib.md5, hashlib.sha256):
        text = text.replace(digest(old).hexdigest(), digest(content).hexdigest())
    return text.replace(f'"size": {len(old)}', f'"size": {len(content)}')


def sums(files: list[Path]) -> str:
    """The checksums of files, as `sha256sum --check` reads them."""
    return "".join(f"{hashlib.sha256(p.read_bytes()).hexdigest()}  {p.name}\n" for p in files)


def template(source: Path, out: Path, address: str, lessons: list[Path]) -> str:
    """The page of the release, into which Blender's tool then puts its table of extensions."""
    [extension], [wheel] = out.glob("*.zip"), out.glob("*.whl")
    picture = (source / "docs/images/diagnosis.gif").read_bytes()
    values = {
        "picture": base64.b64encode(picture).decode(),
        "extension": extension.name,
        "wheel": wheel.name,
        "version": wheel.name.split("-")[1],
        "address": address,
        "lessons": "".join(COURSE.format(path.name) for path in lessons),
        "sums": sums(sorted([*out.iterdir(), *lessons], key=lambda path: path.name)).rstrip(),
    }
    text = (source / "tools/release.html").read_text(encoding="utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda found: values[found[1]], text)


def compared(work: Path, source: Path) -> Path:
    """Compare a picture of a wrong camera, by the wheel itself; return the page."""
    [wheel] = (work / "release").glob("*.whl")
    with zipfile.ZipFile(wheel) as packed:
        packed.extractall(work / "site")
    wrong, right = ANGLES
    scene, *camera = TRIED
    render, out = work / "render.png", work / "compared"
    for words, code in (
        (("trace", scene, *camera, f"angle={wrong}", "--out", render), 0),
        (("compare", scene, *camera, f"angle={right}", "--against", render, "--out", out), 2),
    ):
        command = [sys.executable, "-m", "reference_tracer.cli", *words]
        env = os.environ | {"PYTHONPATH": str(work / "site")}
        done = subprocess.run(command, cwd=source, env=env, capture_output=True, text=True)
        if done.returncode != code:
            raise BuildError(f"the comparison to try ended with {done.returncode}: {done.stderr}")
    return out / "page.html"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--address", default=PLACEHOLDER, help="the project's, https://...")
    parser.add_argument("--no-try", action="store_true", help="leave out try.html: 20 seconds less")
    given = parser.parse_args()
    out = PROJECT / "dist/release"
    try:
        status = git("status", "--porcelain").decode()
        tags = git("tag", "--points-at", "HEAD", "v*").decode().split()
        check(status, tags, text_of("blender_manifest.toml"), text_of("CHANGELOG.md"))
        with tempfile.TemporaryDirectory() as work:
            built = build(Path(work), given.address, not given.no_try)
            shutil.rmtree(out, ignore_errors=True)
            shutil.copytree(built, out)
    except BuildError as error:
        print(f"release: {error}", file=sys.stderr)
        return 1
    except subprocess.CalledProcessError as error:
        return error.returncode  # the tool has said why
    print((out / "SHA256SUMS").read_text(encoding="ascii"), end="")
    if not [*out.glob("*-lessons.zip")]:
        say = (
            "no lesson pack of this commit is in it: make lessons builds it, make release takes it"
        )
        print(f"release: {say}", file=sys.stderr)
    if given.address == PLACEHOLDER:
        say = "make release ADDRESS=https://... puts the project's address in its place"
        print(f"release: the address is still {PLACEHOLDER}: {say}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
