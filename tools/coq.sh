#!/usr/bin/env bash
# Coq and Flocq, which read the proofs: Debian's packages, installed where they are not there.
#
#   tools/coq.sh check  exits 0 if they are there or can be installed, else says why not
#   tools/coq.sh setup  installs them
set -euo pipefail

say() { echo "coq: $*" >&2; }

is_there() {
    command -v coqc >/dev/null && command -v coq_makefile >/dev/null &&
        [ -e "$(coqc -where)/user-contrib/Flocq/Core/Core.vo" ]
}

check() {
    if is_there; then return; fi
    if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null; then
        echo "no Coq with Flocq here; on Debian or Ubuntu: sudo apt-get install coq libcoq-flocq;" \
            "with opam: opam install coq coq-flocq"
        return 1
    fi
}

setup() {
    if is_there; then return; fi
    say "installing coq and libcoq-flocq"
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        coq libcoq-flocq >/dev/null
    is_there || { say "installed, but Flocq is not where coqc looks"; exit 1; }
}

case "${1:-}" in
    check) check ;;
    setup) check >&2 && setup ;;
    *)
        sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0" >&2
        exit 2
        ;;
esac
