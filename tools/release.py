"""Writes what a user downloads to dist/release/, of the last commit: same commit, same bytes.

The extension, the Python package (sdist and wheel), the notes, the checksums; and index.json, which
makes the folder's address one that Blender takes for a repository of extensions. `make release`
runs it, in a Python that has bpy.
"""

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


def build(work: Path) -> Path:
    """Build everything in a folder for the work; returns the folder of what is released."""
    source, out = work / "source", work / "release"
    out.mkdir()
    with tarfile.open(fileobj=io.BytesIO(git("archive", "HEAD"))) as committed:
        committed.extractall(source, filter="data")
    if (PROJECT / "wheels").exists():  # what was fetched once
        shutil.copytree(PROJECT / "wheels", source / "wheels")
    seconds = int(git("log", "-1", "--format=%ct"))
    os.environ["SOURCE_DATE_EPOCH"] = str(seconds)  # the wheel's date
    os.umask(0o022)  # the rights in the wheel

    run(source / "tools/build_extension.py", "--out", out)
    [extension] = out.glob("*.zip")
    date_zip(extension, seconds)
    page = source / "tools/release.html"
    run(blenders_tool(), "server-generate", "--repo-dir", out, "--html", "--html-template", page)

    sdist = [sys.executable, "setup.py", "--quiet", "sdist", "--dist-dir", out]
    subprocess.run(sdist, cwd=source, check=True)
    [sdist] = out.glob("*.tar.gz")
    date_tar(sdist, seconds)
    # From the sdist, which shows that it is whole.
    run("-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "-w", out, sdist)

    (out / "NOTES.md").write_bytes(newest(text_of("CHANGELOG.md"))[2].encode())
    sums = [(hashlib.sha256(p.read_bytes()).hexdigest(), p.name) for p in sorted(out.iterdir())]
    (out / "SHA256SUMS").write_bytes("".join(f"{s}  {name}\n" for s, name in sums).encode())
    return out


def main() -> int:
    out = PROJECT / "dist/release"
    try:
        status = git("status", "--porcelain").decode()
        tags = git("tag", "--points-at", "HEAD", "v*").decode().split()
        check(status, tags, text_of("blender_manifest.toml"), text_of("CHANGELOG.md"))
        with tempfile.TemporaryDirectory() as work:
            built = build(Path(work))
            shutil.rmtree(out, ignore_errors=True)
            shutil.copytree(built, out)
    except BuildError as error:
        print(f"release: {error}", file=sys.stderr)
        return 1
    except subprocess.CalledProcessError as error:
        return error.returncode  # the tool has said why
    print((out / "SHA256SUMS").read_text(encoding="ascii"), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
