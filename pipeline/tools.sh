#!/bin/sh
# What midplane needs from the system, beside Rust: gmsh, Python with venv, and a library for off-screen rendering.
# Missing packages are installed if we may (root on Debian), else one line says which.
# `tools.sh compiler` adds a compiler of C++, which libFuzzer is made with.
# `tools.sh paraview` adds ParaView and a screen for it that nobody sees, some 800 MB.
# `tools.sh browser` adds a browser without a window, some 60 MB, in which `make trade` opens its page; nothing fails
# without it.
set -eu

packages=""
need() { # package, command that succeeds where it is not needed
    package=$1
    shift
    "$@" >/dev/null 2>&1 || packages="$packages $package"
}
finds_library() { /sbin/ldconfig -p | grep -qE "$1"; }

need gcc command -v cc
if [ "${1:-}" = paraview ]; then
    need paraview command -v pvpython
    need python3-paraview test -d /usr/lib/python3/dist-packages/paraview
    need xvfb command -v xvfb-run
    need xauth command -v xauth
fi
[ "${1:-}" != compiler ] || need g++ command -v c++
need libc6-dev test -e /usr/include/stdio.h
need gmsh command -v gmsh
need python3-venv python3 -c 'import ensurepip, venv'
if [ -x /sbin/ldconfig ]; then
    need libosmesa6 finds_library 'libOSMesa\.so|libEGL\.so' # pictures only
fi

if ! command -v cargo >/dev/null; then
    echo "midplane needs Rust: install it from https://rustup.rs" >&2
    exit 1
fi

may_install() { [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; }
install() {
    echo "installing $*"
    apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends "$@"
}
finds_browser() { PYTHONPATH=pipeline python3 -m midplane_pipeline.trade.browser --find; } # before there is a venv

if [ "${1:-}" = browser ] && ! finds_browser >/dev/null; then
    if ! may_install || ! install chromium-headless-shell; then
        echo "no chromium or chrome, and none could be installed: the page of make trade will not be opened" >&2
    fi
fi
[ -n "$packages" ] || exit 0

if may_install; then
    # shellcheck disable=SC2086
    install $packages
elif [ "$packages" != " libosmesa6" ]; then
    echo "midplane needs more programs. On Debian: apt-get install$packages" >&2
    exit 1
fi
