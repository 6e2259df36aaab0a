#!/usr/bin/env bash
# Chromium, in which the tests open the page: Debian's package, installed where it is not there.
# The one without a window of its own takes half the time, so it is taken where Debian has it.
#
#   tools/browser.sh check  exits 0 if there is one or it can be installed, else says why not
#   tools/browser.sh setup  installs it
set -euo pipefail

say() { echo "browser: $*" >&2; }

shell=chromium-headless-shell

is_there() {
    command -v "$shell" >/dev/null || command -v chromium >/dev/null ||
        command -v chromium-browser >/dev/null || command -v google-chrome >/dev/null
}

may_install() { [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; }

check() {
    if ! is_there && ! may_install; then
        echo "no Chromium here; on Debian, install it with: sudo apt-get install chromium"
        return 1
    fi
}

setup() {
    if command -v "$shell" >/dev/null; then return; fi
    if may_install && apt-get update -qq && install "$shell"; then return; fi
    is_there || install chromium # a Debian without it
}

install() { [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; }

check() {
    if ! is_there && ! may_install; then
        echo "no Chromium here; on Debian, install it with: sudo apt-get install chromium"
        return 1
    fi
}

setup() {
    if command -v "$shell" >/dev/null || ! may_install; then return; fi
    if ! apt-cache show "$shell" >/dev/null 2>&1; then apt-get update -qq; fi
    if apt-cache show "$shell" >/dev/null 2>&1; then
        install "$shell"
    elif ! is_there; then
        install chromium
    fi
}

install() { # PACKAGE
    say "installing $1"
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        "$1" fonts-dejavu-core >/dev/null
}

case "${1:-}" in
    check) check ;;
    setup) check >&2 && setup ;;
    *)
        sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0" >&2
        exit 2
        ;;
esac
