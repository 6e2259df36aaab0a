#!/usr/bin/env bash
# A whole Blender with a window, in a root folder of its own: a package of Debian's, which the bpy
# wheels can't replace, since they have no window, no `blender -b` and no `--command`.
#
#   tools/whole_blender.sh check           exits 0 if this machine can do it, else says why not
#   tools/whole_blender.sh ready           exits 0 if it is set up, else says why not
#   tools/whole_blender.sh setup           makes the root folder (a minute or two, 1.4 GB), once
#   tools/whole_blender.sh run COMMAND...  runs a command in it, in a virtual screen of 1600×900,
#                                          with this project at /project; sets up first if needed
#
# BLENDER_VERSION=...  5.2, the default, of Debian's unstable; or 4.3, of Debian 13
# BLENDER_ROOT=...     where its root folder is kept (default: under ~/.cache)
# DEBIAN_MIRROR=...    where its packages come from: unstable changes, a day in Debian's archive of
#                      snapshots does not
#
# A command sees no variable of yours and an empty /tmp, and reaches no network; pass on what it
# needs with env, and leave results somewhere below /project/out:
#   tools/whole_blender.sh run env BLENDER_USER_RESOURCES=/project/out/user blender --version
set -euo pipefail

project="$(cd "$(dirname "$0")/.." && pwd)"
version="${BLENDER_VERSION:-5.2}"
root="${BLENDER_ROOT:-${XDG_CACHE_HOME:-$HOME/.cache}/reference-tracer/blender-$version}"
packages=(
    blender python3-numpy python3-requests               # Blender and what its own add-ons import
    xvfb xauth libgl1-mesa-dri libegl1 libgl1            # a screen and OpenGL in software
    xdotool imagemagick                                  # press keys, take screenshots
    slurm-wlm iproute2                                   # a render farm on one machine
)
# Each version, the Debian that has it, and what else it needs there.
case "$version" in
    4.3) debian=trixie more=() ;;
    5.2) debian=sid more=(python3-cattr mesa-vulkan-drivers) ;;
    *) echo "whole_blender: no Debian is known to have Blender $version: 4.3 or 5.2" >&2 && exit 2 ;;
esac
packages+=("${more[@]}")

say() { echo "whole_blender: $*" >&2; }

check() {
    local why=""
    if [ "$(uname -s)" != Linux ]; then
        why="needs Linux"
    elif [ "$(id -u)" != 0 ]; then
        why="needs root, for a root folder of its own"
    elif ! unshare --mount --net --pid --fork true 2>/dev/null; then
        why="this root may not mount (a container without that right?)"
    elif ! command -v debootstrap >/dev/null && ! command -v apt-get >/dev/null; then
        why="needs debootstrap, and there is no apt-get to install it"
    fi
    if [ -n "$why" ]; then
        echo "no whole Blender here: $why"
        return 1
    fi
}

# Two stamps mark what is complete: the bare system, and the packages in it (their list is the
# stamp's text, so that a longer list is noticed). Whatever was interrupted is done again.
is_set_up() { [ "$(cat "$root/.packages" 2>/dev/null)" = "${packages[*]}" ]; }

setup() {
    if is_set_up; then return; fi
    mkdir -p "$(dirname "$root")"
    exec 9>"$root.lock"
    flock 9 # two runs at once: the second waits and finds it done
    if is_set_up; then return; fi
    if ! command -v debootstrap >/dev/null; then
        say "installing debootstrap"
        apt-get update -qq
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq debootstrap debian-archive-keyring
    fi
    say "setting up Blender in $root; log: $root.log"
    if ! (in_private_mounts _setup) >"$root.log" 2>&1; then
        tail -n 30 "$root.log" >&2
        say "setting up failed; the whole log is $root.log"
        return 1
    fi
    local found
    found="$(chroot "$root" blender --version 2>/dev/null | head -n 1)"
    say "ready: $found"
    case "$found" in
        "Blender $version"*) ;;
        *) say "it is not $version: Debian's $debian has another by now; see DEBIAN_MIRROR" ;;
    esac
}

# Mounts made from here on are seen by this process and its children alone, and end with them,
# however they end: nothing is left to unmount, and no `rm` can ever reach through a mount.
# A namespace for processes ends those that a command leaves behind, such as its X server, also
# where a test's time limit kills this script: by exec, it is unshare itself that is killed.
# (Kill it for good, with SIGKILL: unshare takes no notice of SIGTERM.)
in_private_mounts() { # [unshare's options] SUB-COMMAND...
    local options=(--mount --pid --fork --kill-child)
    while [[ "$1" == --* ]]; do options+=("$1") && shift; done
    exec unshare "${options[@]}" "$0" "$@"
}

mount_system() {
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
}

_setup() {
    if [ ! -e "$root/.bare" ]; then
        rm -rf --one-file-system "$root"
        debootstrap --variant=minbase "$debian" "$root" ${DEBIAN_MIRROR:+"$DEBIAN_MIRROR"}
        touch "$root/.bare"
    fi
    mount_system
    cp -L /etc/resolv.conf "$root/etc/resolv.conf"
    ln -sf /proc/self/mounts "$root/etc/mtab" # Blender looks there for its file browser
    # A mirror may be some days behind; and a root folder that is not whole is made again, so that
    # nothing need wait for the disk.
    echo 'Acquire { Check-Valid-Until "false"; Languages "none"; };' >"$root/etc/apt/apt.conf.d/90quick"
    printf 'force-unsafe-io\npath-exclude=/usr/share/doc/*\n' >"$root/etc/dpkg/dpkg.cfg.d/quick"
    in_root apt-get update
    in_root dpkg --configure -a # after an interruption
    in_root apt-get install -y --no-install-recommends "${packages[@]}"
    in_root apt-get clean
    echo "${packages[*]}" >"$root/.packages"
}

_run() {
    mount_system
    mount -t tmpfs tmpfs "$root/tmp"
    mkdir -p "$root/project"
    mount --bind "$project" "$root/project"
    in_root xvfb-run --auto-servernum --server-args='-screen 0 1600x900x24' "$@"
}

# A fixed environment: what the caller has in its own must not change a test's outcome.
in_root() {
    env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive LIBGL_ALWAYS_SOFTWARE=1 PYTHONDONTWRITEBYTECODE=1 \
        chroot "$root" "$@"
}

case "${1:-}" in
    check) check ;;
    setup) check >&2 && setup ;;
    ready) check && { is_set_up || { echo "no whole Blender is set up: $0 setup" && false; }; } ;;
    run)
        check >&2
        setup
        shift
        in_private_mounts --net _run "$@"
        ;;
    _setup | _run) "$@" ;; # this script called by itself
    *)
        sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0" >&2
        exit 2
        ;;
esac
