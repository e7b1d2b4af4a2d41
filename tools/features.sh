#!/bin/sh
# Each tracker compiles as the only one, without a warning; a library of none is refused. The feature that injects faults
# does so, and only in debug builds. Run by `make test`.
set -eu
cd "$(dirname "$0")/.."

# These checks have results of their own.
check() { RUSTFLAGS="-D warnings" cargo check --quiet --lib --locked --target-dir target/features --no-default-features "$@"; }

trackers=$(sed -n 's/^default = \[\(.*\), "toml", "snapshot"\]$/\1/p' Cargo.toml | tr -d '",')
[ "$(echo "$trackers" | wc -w)" -ge 8 ]
for tracker in $trackers; do check --features "$tracker"; done
check --features gentrack2,toml
check --features gentrack2,snapshot
check --features sort,snapshot
if check --features toml,snapshot 2>/dev/null; then
    echo "a library without a tracker was made" >&2
    exit 1
fi
echo "features: $trackers compile alone"

if ! check --release --features sort,fault-injection 2>&1 | grep -q "fault-injection is for tests"; then
    echo "a library for use can be made to fail" >&2
    exit 1
fi
RUSTFLAGS="-D warnings" cargo check --quiet --lib --locked --target-dir target/features --features fault-injection
# With what the other tests have compiled.
cargo test --quiet --locked --features fault-injection --test fault_injection
