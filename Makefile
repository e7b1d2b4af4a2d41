# The short commands; everything is done by cargo and CMake.

BUILD := build
PREFIX ?= /usr/local
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
# Read by ctest and by cmake --build, here and in tools/.
export CTEST_PARALLEL_LEVEL ?= $(JOBS)
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)

# Measurement data next to the checkout, if there is any; tests that need it say so when they skip.
ifeq ($(origin GENTRACK2_SHARED),undefined)
ifneq ($(wildcard ../shared/mot17),)
export GENTRACK2_SHARED := $(abspath ../shared)
endif
endif

.PHONY: help build install package docs demo test soak arm eval tune eval-check accuracy bench bench-instructions fuzz \
    sanitize deny reproducible lint fmt-check clean

help:
	@echo "make build      the library and the examples, in $(BUILD)/"
	@echo "make install    install it, PREFIX=/usr/local DESTDIR= (no tests, no examples)"
	@echo "make package    Debian packages and a .tar.gz, in $(BUILD)/packages/"
	@echo "make docs       the manual and the references of the C, C++ and Rust interfaces, in $(BUILD)/docs/"
	@echo "make demo       track OpenCV's sample video; results in out/"
	@echo "make test       all tests: Rust, C and C++"
	@echo "make soak       every tracker through a million frames, good and bad: FRAMES=1000000; some ten minutes"
	@echo "make arm        the library for ARM, 64 and 32 bits, and its tests under qemu"
	@echo "make eval DATA=FOLDER"
	@echo "                all trackers on your sequences in MOTChallenge's layout: a page, out/eval/index.html;"
	@echo "                EVAL='--split half --det det-frcnn.txt' and the like are options of eval/report.py"
	@echo "make tune DATA=FOLDER"
	@echo "                search gentrack2's parameters for your sequences, METRIC=HOTA TRIALS=60 TIME=MINUTES:"
	@echo "                out/tune/gentrack2.toml; TUNE='--folds 5' and the like are options of eval/tune.py"
	@echo "make eval-check reports of synthetic sequences and, where it is, of the measurement data, looked at in Chromium"
	@echo "make accuracy   a table of all trackers on all set-ups of eval/README.md, if GENTRACK2_SHARED names the data;"
	@echo "                ACCURACY='--entries gentrack2 --setups H,P' and the like are options of eval/evaluate.py"
	@echo "make bench      speed and memory beside other crates' trackers and OpenCV, in about ten minutes: out/bench.md;"
	@echo "                MOT17 is among it if GENTRACK2_SHARED names the data"
	@echo "make bench-instructions"
	@echo "                instructions per step against benches/instructions/baseline.txt; UPDATE=1 writes that file"
	@echo "make fuzz       the fuzzers of fuzz/, SECONDS=600 each; TARGETS='toml mot_reader' are some of them"
	@echo "make sanitize   the C and C++ tests under valgrind and GCC's sanitizers; CHECKERS='memcheck helgrind' are some of"
	@echo "                memcheck, helgrind, address, thread"
	@echo "make deny       licences and sources of all dependencies; ADVISORIES=1 for known vulnerabilities, from GitHub"
	@echo "make reproducible"
	@echo "                a second build elsewhere, which must have the same bits"
	@echo "make lint       formatting and clippy"
	@echo "make clean      remove $(BUILD)/, out/ and target/"
	@echo
	@echo "All but install and clean install the Debian packages they need and do not find."

build:
	@tools/install-needs.sh build
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=Release
	@cmake --build $(BUILD) $(if $(TARGET),--target $(TARGET))

# A configuration of its own, which needs neither OpenCV nor C++ programs; cargo's results are shared.
install:
	@cmake -S . -B $(BUILD)/install -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$(PREFIX)" \
	    -DGENTRACK2_BUILD_TESTS=OFF -DGENTRACK2_BUILD_EXAMPLES=OFF $(CMAKE_OPTIONS)
	@cmake --build $(BUILD)/install
	DESTDIR="$(DESTDIR)" cmake --install $(BUILD)/install

package:
	@tools/install-needs.sh package
	@tools/package.sh $(BUILD)

docs:
	@tools/install-needs.sh docs
	@tools/docs.sh $(BUILD)/docs

demo:
	@tools/install-needs.sh demo
	@$(MAKE) --no-print-directory build
	@tools/demo.sh

test:
	@tools/install-needs.sh test
	@$(MAKE) --no-print-directory build
	cargo test
	ctest --test-dir $(BUILD) --output-on-failure

FRAMES ?= 1000000

soak:
	@tools/install-needs.sh build
	@$(MAKE) --no-print-directory build
	$(BUILD)/ctest/soak tests/fixtures $(FRAMES) --judge-times

arm:
	@tools/install-needs.sh arm
	@$(MAKE) --no-print-directory build
	@tools/arm.sh $(BUILD) aarch64
	@if tools/arm-rust.sh armhf $(BUILD)/arm/rust >/dev/null 2>&1; then tools/arm.sh $(BUILD) armhf; \
	    else echo "32-bit ARM is left out: Rust's standard library for it is not here"; fi

# What eval and tune need before they run.
define evaluation
	@if [ -z "$(DATA)" ]; then \
	    echo "usage: make $@ DATA=FOLDER, a folder of sequences in MOTChallenge's layout; see eval/README.md" >&2; exit 2; fi
	@tools/install-needs.sh eval
	@$(MAKE) --no-print-directory build TARGET=gt2_mot
endef

eval:
	$(evaluation)
	@python3 eval/report.py "$(DATA)" $(EVAL)

tune:
	$(evaluation)
	@python3 eval/tune.py "$(DATA)" $(if $(METRIC),--metric $(METRIC)) $(if $(TRIALS),--trials $(TRIALS)) \
	    $(if $(TIME),--time $(TIME)) $(TUNE)

eval-check:
	@tools/install-needs.sh eval-check
	@$(MAKE) --no-print-directory build TARGET=gt2_mot
	@tools/eval-check.sh $(BUILD)

accuracy:
	@tools/install-needs.sh eval
	@$(MAKE) --no-print-directory build
	@python3 eval/evaluate.py $(ACCURACY)

bench:
	@tools/install-needs.sh bench
	@$(MAKE) --no-print-directory build
	@tools/bench.sh $(BUILD)

bench-instructions:
	@tools/install-needs.sh bench-instructions
	@cd benches && cargo run --quiet --release --locked --package instructions -- $(if $(UPDATE),--update)

SECONDS ?= 600

fuzz:
	@tools/install-needs.sh fuzz
	@tools/fuzz.sh $(SECONDS) $(TARGETS)

CHECKERS ?= memcheck helgrind address thread

sanitize:
	@tools/install-needs.sh sanitize
	@$(MAKE) --no-print-directory build
	@tools/sanitize.sh $(BUILD) $(CHECKERS)

deny:
	@tools/install-needs.sh deny
	@tools/deny.sh $(BUILD) $(if $(ADVISORIES),advisories)

reproducible:
	@tools/install-needs.sh package
	@$(MAKE) --no-print-directory build
	@tools/reproducible.sh $(BUILD)

lint: fmt-check
	cargo clippy --all-targets -- -D warnings
	cd benches && cargo clippy --locked --package scenes --package instructions --all-targets -- -D warnings

fmt-check:
	cargo fmt --check
	cd benches && cargo fmt --check

clean:
	rm -rf $(BUILD) out benches/target
	cargo clean
