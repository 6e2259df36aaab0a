#!/usr/bin/env bash
# Chromium, in which the tests open the page: Debian's package, installed where it is not there.
#
#   tools/browser.sh check  exits 0 if there is one or it can be installed, else says why not
#   tools/browser.sh setup  installs it
set -euo pipefail

say() { echo "browser: $*" >&2; }

is_there() {
    command -v chromium >/dev/null || command -v chromium-browser >/dev/null ||
        command -v google-chrome >/dev/null
}

check() {
    if is_there; then return; fi
    if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null; then
        echo "no Chromium here; on Debian, install it with: sudo apt-get install chromium"
        return 1
    fi
}

setup() {
    if is_there; then return; fi
    say "installing chromium"
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        chromium fonts-dejavu-core >/dev/null
}

case "${1:-}" in
    check) check ;;
    setup) check >&2 && setup ;;
    *)
        sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0" >&2
        exit 2
        ;;
esac
