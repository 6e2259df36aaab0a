#!/usr/bin/env bash
# Other Pythons with other numpys and trimeshes: environments of their own in .venv/others. The tests
# hold certified pictures equal there, to the bit, and run the wheel, for each Python that is there.
#
#   tools/others.sh check  exits 0 if there is one or it can be made, else says why not
#   tools/others.sh setup  makes those that are not there: some seconds and 80 MB each, once
#   tools/others.sh daily  likewise the oldest and the newest alone, which `make test` needs
set -euo pipefail
cd "$(dirname "$0")/.."

# Python-numpy-trimesh: the oldest that pyproject.toml allows, what older Blenders have, the newest
# for Python 3.11, and the newest for each other one.
others=(
    3.11-1.24.0-4.0.0
    3.11-1.26.4-4.4.0
    3.11-2.4.6-5.2.0
    3.12-2.5.5-5.2.0
    3.13-2.5.5-5.2.0
    3.14-2.5.5-5.2.0
)

say() { echo "others: $*" >&2; }

# As in tools/venv.sh: it is asked rather than judged by its name.
is_python() { # COMMAND VERSION
    "$1" -c '
import sys, venv
sys.exit("%d.%d" % sys.version_info[:2] != sys.argv[1])
' "$2" 2>/dev/null
}

find_python() { # VERSION
    local candidate pyenv_versions=""
    if command -v pyenv >/dev/null; then pyenv_versions="$(pyenv root)/versions"; fi
    for candidate in .venv/bin/python "python$1" "$pyenv_versions/$1".*/bin/python python3; do
        if is_python "$candidate" "$1"; then
            echo "$candidate"
            return
        fi
    done
    if command -v uv >/dev/null && uv python find "$1" 2>/dev/null; then return; fi
    of_maven "$1"
}

# Where no Python that new is installed: a build of it that Maven has, for programs in Java.
of_maven() { # VERSION
    local folder=.venv/others/maven
    local python="$folder/org/bytedeco/cpython/linux-x86_64/bin/python3.14"
    [ "$1 $(uname -sm)" = "3.14 Linux x86_64" ] && command -v mvn >/dev/null || return
    if ! is_python "$python" "$1"; then
        mvn --quiet --batch-mode dependency:copy -DoutputDirectory="$folder" \
            -Dartifact=org.bytedeco:cpython:3.14.3-1.5.13:jar:linux-x86_64 >&2 &&
            .venv/bin/python -m zipfile -e "$folder"/cpython-*.jar "$folder" &&
            chmod +x "$python" || return
    fi
    echo "$PWD/$python"
}

own() { # the project's own Python is one of them
    .venv/bin/python -c '
import sys, numpy, trimesh
print("{}.{}".format(*sys.version_info), numpy.__version__, trimesh.__version__, sep="-")
'
}

# The stamp marks what is complete: whatever was interrupted is done again.
is_there() { [ -e ".venv/others/$1/.ready" ] || [ "$1" = "$(own)" ]; }

check() {
    local other
    for other in "${others[@]}"; do
        if is_there "$other" || find_python "${other%%-*}" >/dev/null; then return; fi
    done
    echo "no other Python here: none of 3.11 to 3.14 with its venv module"
    return 1
}

setup() { # NAME...
    local other python folder numpy trimesh
    for other in "$@"; do
        folder=".venv/others/$other"
        if is_there "$other" || ! python="$(find_python "${other%%-*}")"; then continue; fi
        IFS=- read -r _ numpy trimesh <<<"$other"
        say "making $folder"
        "$python" -m venv --clear --without-pip "$folder"
        .venv/bin/python -m pip --python "$folder/bin/python" install --quiet \
            --only-binary=:all: "numpy==$numpy" "trimesh==$trimesh"
        touch "$folder/.ready"
    done
}

case "${1:-}" in
    check) check ;;
    setup) check >&2 && setup "${others[@]}" ;;
    daily) check >&2 && setup "${others[0]}" "${others[-1]}" ;;
    *)
        sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0" >&2
        exit 2
        ;;
esac
