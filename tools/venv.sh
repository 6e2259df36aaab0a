#!/usr/bin/env bash
# Makes the virtual environment .venv with the project, a real bpy and all pinned packages.
#
#   tools/venv.sh            picks a Python: 3.13 (bpy 5.2.3), else 3.11 (bpy 5.0.1), else fetches one
#   PYTHON=... tools/venv.sh takes that one
#   tools/venv.sh which [VERSION]  only says which
#   tools/venv.sh libraries PYTHON  only installs what that Python's bpy needs
#
# Safe to run again: an environment that works is kept and brought up to date.
set -euo pipefail
cd "$(dirname "$0")/.."

versions="3.13 3.11" # of Python, for which there is a bpy: the first one there is, is taken

say() { echo "venv: $*" >&2; }

# A Python counts when it starts, has the wanted version and can make environments. It is asked
# rather than judged by its name: pyenv's `python3.13` is there also where no 3.13 is switched on.
is_python() { # COMMAND VERSION
    "$1" -c '
import sys, sysconfig, ensurepip, venv
ok = "%d.%d" % sys.version_info[:2] == sys.argv[1]
sys.exit(not ok or bool(sysconfig.get_config_var("Py_GIL_DISABLED")))  # bpy has no such build
' "$2" 2>/dev/null
}

find_python() { # VERSION...
    local version candidate wanted="$*" pyenv_versions=""
    if command -v pyenv >/dev/null; then pyenv_versions="$(pyenv root)/versions"; fi
    for version in "$@"; do
        for candidate in ${PYTHON:-"python$version" "$pyenv_versions/$version".*/bin/python python3 python}; do
            if is_python "$candidate" "$version"; then
                echo "$candidate"
                return
            fi
        done
    done
    if [ -z "${PYTHON:-}" ] && fetch_python "$1" 2>/dev/null; then return; fi
    say "no ${PYTHON:-Python ${wanted// / or }} with its venv module, which Blender's module needs:" \
        "install one (Debian 12 and 13: apt install python3-venv), or name it:" \
        "make PYTHON=/path/to/python3.13 demo"
    return 1
}

# uv knows Pythons of its own, and fetches one into the folder .python; any Python can fetch uv.
fetch_python() { # VERSION
    local uv=uv python
    export UV_PYTHON_INSTALL_DIR="$PWD/.python"
    if ! command -v uv >/dev/null; then
        python="$(command -v python3 || command -v python)" &&
            "$python" -m venv --clear .python/uv >&2 || return
        uv=.python/uv/bin
        if [ -d .python/uv/Scripts ]; then uv=.python/uv/Scripts; fi # Windows
        "$uv/python" -m pip install --quiet uv >&2 || return
        uv+=/uv
    fi
    "$uv" python find "$1" && return
    "$uv" python install --quiet "$1" >&2 && "$uv" python find "$1"
}

# bpy needs some of the system's libraries, and without them dies with a bare linker error.
check_libraries() { # PYTHON
    local packages
    if "$1" tools/check_libraries.py; then return; fi
    packages="$("$1" tools/check_libraries.py --packages || true)"
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        say "installing: $packages"
        apt-get update -qq
        # shellcheck disable=SC2086  # a list of names
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages
        "$1" tools/check_libraries.py
    else
        say "on Debian and Ubuntu, install them with: sudo apt-get install $packages"
        return 1
    fi
}

case "${1:-}" in
    libraries) check_libraries "$2"; exit ;;
    which)
        if [ -n "${2:-}" ]; then PYTHON=; fi
        # shellcheck disable=SC2086  # a list of versions
        find_python ${2:-$versions}
        exit
        ;;
esac

if ! is_python .venv/bin/python 3.13 && ! is_python .venv/bin/python 3.11; then
    # shellcheck disable=SC2086  # a list of versions
    python="$(find_python $versions)"
    say "making .venv with $("$python" --version)"
    "$python" -m venv --clear .venv
    if [ -d .venv/Scripts ]; then # Windows: let it have the name that it has elsewhere
        cmd //c mklink //J '.venv\bin' '.venv\Scripts' >&2
    fi
fi

# setuptools comes first and pinned, so that nothing unpinned is fetched to build the project.
.venv/bin/python -m pip install --quiet --constraint constraints.txt setuptools
.venv/bin/python -m pip install --quiet --constraint constraints.txt --no-build-isolation \
    --editable '.[blender,images,progress,test]'
check_libraries .venv/bin/python
touch .venv/.stamp
say "ready: $(.venv/bin/python --version), $(.venv/bin/python -m pip list 2>/dev/null | awk '$1 == "bpy" { print $1, $2 }')"
