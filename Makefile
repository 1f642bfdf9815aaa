# Every way to build, test and render Weft; docs/building.md says more.
# SETUP=true skips the installing of packages, on a distribution that tools/setup does not know.

SETUP ?= tools/setup
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 60
WEFT := build/release/weft

.DEFAULT_GOAL := help
.PHONY: help weft weights demo install package test-package figures test bench bench-peers docs format check dev asan tsan fuzz clean

help: ## Print this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-12s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

demo: ## Install what is missing, build, and render scenes/demo.xml to build/demo.exr and .png
demo: weft
	$(WEFT) render scenes/demo.xml -o build/demo.exr -o build/demo.png
	@echo "The pictures are build/demo.exr and build/demo.png"

# Without them the program denoises by other means, so that nothing fails for the want of them.
weights: ## Fetch the weights of the denoiser's network, if npm is there
	@$(SETUP) denoise || echo "Going on without the weights: 'weft denoise' will use non-local means."

install: ## Build, and install to PREFIX (/usr/local): make install PREFIX=~/.local
install: weft weights
	cmake --install build/release --prefix $(PREFIX)

package: ## Make a Debian package, build/weft_VERSION_ARCHITECTURE.deb
package: weft weights
	@$(SETUP) package
	cpack --config build/release/CPackConfig.cmake -B build/package
	cp build/package/weft_*.deb build/

test-package: ## Install the package in a new Debian made by debootstrap, and render there; as root
test-package: package
	tools/test_package build/weft_*.deb

figures: ## Render the figures of docs/figures.md to build/figures
figures: weft
	tools/render_figures build/figures

test: ## Install what is missing, build, and run every test
dev: ## The same in build/dev, with asserts and debug information
asan: ## The same in build/asan, under the address and undefined-behaviour sanitizers
tsan: ## The same in build/tsan, under the thread sanitizer
test: preset = release
dev asan tsan: preset = $@
test dev asan tsan:
	@$(SETUP) build test
	cmake --preset $(preset)
	cmake --build --preset $(preset)
	ctest --preset $(preset)

# The tests need packages that a renderer does not: without them, a first build leaves them out.
weft: ## Build only the renderer, build/release/weft
	@$(SETUP) build
	@test -f build/release/build.ninja || cmake --preset release -DWEFT_TESTS=OFF -DWEFT_BENCH=OFF
	cmake --build --preset release --target weft

bench: ## Run the benchmarks; figures go to build/bench.json
	@$(SETUP) build test
	cmake --preset release
	cmake --build --preset release --target weft_bench
	build/release/weft_bench build/bench.json

bench-peers: ## Render five scenes beside Cycles, where Blender is installed; pictures go to build/peers
	@$(SETUP) build test
	cmake --preset release
	cmake --build --preset release --target weft weft_bench
	bench/peers/run $(WEFT) build/release/weft_bench build/peers

docs: ## Regenerate docs/reference from the schemas, docs/materials.md from scenes/materials
docs: weft
	$(WEFT) docs docs/reference
	$(WEFT) help materials --markdown >docs/materials.md

format: ## Rewrite every C++ file to .clang-format
	@$(SETUP) check
	tools/check_format --fix

check: ## Check the direction of includes between rooms, and the format
	@$(SETUP) check
	tools/check_layers
	tools/check_format

fuzz: ## Run each fuzzer for FUZZ_SECONDS (60); inputs are kept in build/fuzz/corpus
	@$(SETUP) build fuzz
	cmake --preset fuzz
	cmake --build --preset fuzz
	@set -e; for fuzzer in build/fuzz/fuzz_*; do \
	    corpus=build/fuzz/corpus/$${fuzzer##*/}; mkdir -p $$corpus; echo "$$fuzzer"; \
	    $$fuzzer -max_total_time=$(FUZZ_SECONDS) -artifact_prefix=build/fuzz/ $$corpus; \
	done

clean: ## Remove build/
	rm -rf build
