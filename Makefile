# Ripstop's commands. On a fresh Debian 12 or 13, as root or with sudo: `make demo` and `make check` do everything.

JOBS := $(shell nproc)
SUDO := $(shell [ $$(id -u) = 0 ] || echo sudo)
PREFIX ?= /usr/local

# Packages for building and running, and those only for the tests and benchmarks.
PACKAGES := build-essential cmake ninja-build pkg-config libtomlplusplus-dev libcli11-dev libfmt-dev \
  libeigen3-dev nlohmann-json3-dev libnlopt-dev libhwy-dev libpng-dev libcairo2-dev fonts-dejavu-core libxxhash-dev zlib1g-dev \
  libpugixml-dev libminizip-dev libcpp-httplib-dev \
  openfoam openmpi-bin
SLURM_PACKAGES := slurmctld slurmd slurm-client munge
FUZZ_PACKAGES := clang libclang-rt-dev
# What puts libraries beside a program that leaves this machine.
PORTABLE_PACKAGES := patchelf
# What the Python package needs, and what a wheel of it needs beyond that.
PYTHON_PACKAGES := python3-dev pybind11-dev python3-numpy
WHEEL_PACKAGES := python3-pip python3-setuptools python3-wheel $(PORTABLE_PACKAGES)
CHECK_PACKAGES := libgtest-dev libbenchmark-dev python3 python3-jsonschema python3-vtk9 python3-venv clang-format chromium \
  zsh fish python3-nbconvert python3-ipykernel $(PYTHON_PACKAGES) $(WHEEL_PACKAGES)

# Programs of other people that open the cutting patterns.
DRAWING_PACKAGES := librecad inkscape python3-lxml python3-cssselect python3-numpy
DOCS_PACKAGES := mkdocs-material libjs-katex fonts-katex doxygen

# The same where there is no apt, by the names in public package files (RPM specs, PKGBUILDs); not tested. Neither has OpenFOAM.
FEDORA := gcc-c++ make cmake ninja-build pkgconf-pkg-config tomlplusplus-devel cli11-devel fmt-devel eigen3-devel json-devel \
  NLopt-devel highway-devel libpng-devel cairo-devel dejavu-sans-fonts xxhash-devel zlib-devel \
  pugixml-devel minizip-ng-compat-devel cpp-httplib-devel
FEDORA_CHECK := gtest-devel google-benchmark-devel python3-devel pybind11-devel python3-numpy python3-jsonschema
ARCH := base-devel cmake ninja tomlplusplus cli11 fmt eigen nlohmann-json nlopt highway libpng cairo ttf-dejavu xxhash zlib pugixml minizip
ARCH_CHECK := gtest benchmark python pybind11 python-numpy python-jsonschema

export PATH := /usr/bin:$(PATH)

.PHONY: help deps check-deps build demo check room sanitize sanitize-thread fuzz mutants coverage tidy bench validate validate-ojf validate-families validate-families-in-time validate-symmetry validate-openings validate-filling validate-regimes validate-convergence validate-flights validate-stability validate-clusters judge torture test-sizes test-studio test-tutorials test-drawings test-slurm test-hosts test-debian12 test-debian13 scaling docs reference report-libraries format format-check install-build install wheel tarball test-portable container package release clean

help:  ## This list
	@grep -hE '^[a-z0-9-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14

define other_systems
echo "Packages are installed automatically with apt only (Debian 12 and 13). Elsewhere install them first; CMake names what is missing."; \
  echo "  Fedora:     sudo dnf install $(FEDORA)"; \
  echo "  Arch Linux: sudo pacman -S --needed $(ARCH), and cpp-httplib from the AUR"; \
  echo "For the tests also:"; \
  echo "  Fedora:     sudo dnf install $(FEDORA_CHECK)"; \
  echo "  Arch Linux: sudo pacman -S --needed $(ARCH_CHECK)"; \
  echo "OpenFOAM is optional, for --flow openfoam: https://www.openfoam.com/download"
endef

define install_missing
	@if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then $(other_systems); exit 0; fi; \
	missing=""; for p in $(1); do \
	  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'install ok installed' || missing="$$missing $$p"; done; \
	if [ -n "$$missing" ]; then echo "Installing:$$missing"; $(SUDO) apt-get -o DPkg::Lock::Timeout=600 update -q && \
	  DEBIAN_FRONTEND=noninteractive $(SUDO) apt-get -o DPkg::Lock::Timeout=600 install -y -q --no-install-recommends $$missing; fi
endef

deps:  ## Install what building and running need (apt), or list the packages of Fedora and Arch Linux
	$(call install_missing,$(PACKAGES))

check-deps: deps
	$(call install_missing,$(CHECK_PACKAGES))

build: deps  ## Release build; the program is build/bin/ripstop
	@cmake --preset program -DCMAKE_INSTALL_PREFIX=$(PREFIX) > build.configure.log || { cat build.configure.log; exit 1; }
	@cmake --build --preset program -j $(JOBS)

demo: build  ## Stratos IV at 30 m/s on the printed grid with the built-in flow engine: one or two minutes
	build/bin/ripstop steady examples/stratos-iv/case.toml --speed 30 --out runs/demo
	@echo "The same with OpenFOAM (about eleven minutes on two cores):"
	@echo "  build/bin/ripstop steady examples/stratos-iv/case.toml --speed 30 --flow openfoam --ranks 2 --out runs/demo-openfoam"

check: check-deps format-check  ## Check the format, build everything and run the tests
	@cmake --preset release > build-check.configure.log || { cat build-check.configure.log; exit 1; }
	@cmake --build --preset release -j $(JOBS)
	@ctest --preset release -j $(JOBS)

ROOMS := $(notdir $(patsubst %/,%,$(dir $(wildcard tests/*/*_test.cpp))))
room: check-deps  ## Build and run the tests of one room, or some of them: make room ROOM=cloth [TESTS='ClothLaws|ClothKernel']
	@test -n "$(filter $(ROOM),$(ROOMS))" || { echo "make room ROOM=... is one of: $(sort $(ROOMS))"; exit 2; }
	@cmake --preset release > build-check.configure.log || { cat build-check.configure.log; exit 1; }
	@cmake --build --preset release -j $(JOBS) --target test_$(ROOM)
	@ctest --preset release -j $(JOBS) --no-tests=error -R '^$(ROOM)\.([^/]*/)?($(TESTS))'

sanitize: check-deps  ## All tests under the address and undefined-behaviour sanitizers
	@cmake --preset sanitize > /dev/null
	@cmake --build --preset sanitize -j $(JOBS)
	@ctest --preset sanitize

sanitize-thread: check-deps  ## All tests under the thread sanitizer
	@cmake --preset sanitize-thread > /dev/null
	@cmake --build --preset sanitize-thread -j $(JOBS)
	@ctest --preset sanitize-thread

READERS ?=
SECONDS ?= 60
LONGEST ?= 65536
FUZZ = fuzz$(if $(FAST),-fast)
fuzz: check-deps  ## Fuzz every reader with coverage, into docs/tables: make fuzz [SECONDS=60] [READERS='case chute'] [LONGEST=65536] [FAST=1]; continues with its corpus
	$(call install_missing,$(FUZZ_PACKAGES))
	@cmake --preset $(FUZZ) > /dev/null
	@cmake --build --preset $(FUZZ) -j $(JOBS) $(if $(READERS),--target $(addprefix fuzz_,$(READERS)))
	@/usr/bin/python3 validation/reliability/fuzz.py --seconds $(SECONDS) --jobs $(JOBS) --longest $(LONGEST) $(if $(FAST),--fast) $(READERS)

mutants: check-deps  ## Change the sources in some 460 places and count the changes that tests detect, into docs/tables: hours; resumable
	@/usr/bin/python3 validation/reliability/mutants.py --jobs $(JOBS) $(MUTANTS)

coverage: check-deps  ## Lines of src/ that the tests run, without those for OpenFOAM, into docs/tables
	@cmake --preset coverage > /dev/null
	@cmake --build --preset coverage -j $(JOBS)
	@find build-coverage -name '*.gcda' -delete
	@ctest --preset coverage -j $(JOBS)
	@/usr/bin/python3 validation/reliability/coverage.py

bench: check-deps  ## Run the benchmarks, some four hours; their figures are in docs/tables
	@cmake --preset release > /dev/null
	@cmake --build --preset release -j $(JOBS)
	@build-check/bench/bench_bodies sides | tee docs/tables/sides.md
	@build-check/bench/bench_bodies 32 | tee docs/tables/bodies.md
	@build-check/bench/bench_bodies in-time 16 | tee docs/tables/bodies-in-time.md
	@build-check/bench/bench_bodies in-time 25 all des | tee docs/tables/bodies-in-time-fine.md
	@build-check/bench/bench_bodies places 16 | tee docs/tables/bodies-places.md
	@build-check/bench/bench_bodies openfoam 8 | tee docs/tables/bodies-openfoam.md
	@build-check/bin/ripstop steady examples/flat-circular/case.toml --grid 40,40,50 --set parachute.mesh.cloth_nodes=1500 \
	  --out runs/turned
	@{ build-check/bench/bench_turned disk 8 16 24 && echo && \
	  build-check/bench/bench_turned runs/turned/canopy.stl 8169.3 0 20:0 45:0 90:0 8 16 24 && echo && \
	  build-check/bench/bench_turned runs/turned/canopy.stl 245 0 20:0 45:0 90:0 8 16 24; } | tee docs/tables/turned.md
	@build-check/bin/ripstop steady examples/flat-circular/case.toml --grid 64,64,78 --set parachute.mesh.cloth_nodes=3000 \
	  --set flow.symmetry=quarter --out runs/settling
	@build-check/bench/bench_settling runs/settling 600 50 | tee docs/tables/settling.md
	@build-check/bench/bench_attack plate 12 0 30 45 60 | tee docs/tables/plates.md
	@build-check/bench/bench_attack between-walls 2.5 8 0 30 45 60 | tee docs/tables/plate.md
	@build-check/bench/bench_behind 6 wake 2 4 6 8 12 | tee docs/tables/behind.md
	@build-check/bench/bench_behind 10 pair 1.25 1.5 2 3 6 | tee docs/tables/pair.md
	@build-check/bench/bench_sheet 28 4 | tee docs/tables/sheet-shifts.md
	@build-check/bench/bench_cloth
	@build-check/bench/bench_relaxation | tee docs/tables/relaxation.md
	@build-check/bench/bench_relaxation --ratio --pressures 80 stratos-iv flat-circular
	@build-check/bench/bench_inflation
	@build-check/bench/bench_flow --openfoam --large
	@build-check/bench/bench_flow --in-time
	@{ build-check/bench/bench_in_time runs/in-time/16-2 16 2 2 && echo && \
	  build-check/bench/bench_in_time runs/in-time/25-2 25 0.5 2 && echo && \
	  build-check/bench/bench_in_time runs/in-time/32-2 32 0.25 2; } | tee docs/tables/pimplefoam.md
	@build-check/bench/bench_in_time runs/in-time/8 8 60 1 | tee docs/tables/pimplefoam-mean.md
	@build-check/bench/bench_openfoam_baffle runs/baffle | tee docs/tables/openfoam-baffle.md

VALIDATE := build/bin/ripstop steady examples/stratos-iv/case.toml

validate: build  ## Stratos IV at five speeds on the printed grid with both engines, into docs/tables: hours; resumable
	@for v in 10 15 20 25 30; do $(VALIDATE) --speed $$v --out runs/validate/builtin-$$v || exit; done
	@for v in 30 25 20 15 10; do \
	  $(VALIDATE) --speed $$v --flow openfoam --ranks $(JOBS) --out runs/validate/openfoam-$$v || exit; done
	@/usr/bin/python3 validation/stratos-iv/table.py runs/validate

validate-ojf: build  ## Calibrate on Stratos IV, predict WALRUS and ADEPT, score the blind predictions, into docs/tables: hours; resumable
	@/usr/bin/python3 validation/ojf/campaign.py --ripstop build/bin/ripstop $(STAGES)

validate-families: build  ## Drag of every family's example compared with Knacke's values, into docs/tables: ten minutes; resumable
	@/usr/bin/python3 validation/families/families.py --ripstop build/bin/ripstop

validate-families-in-time: build  ## The same with unsteady wakes, averaged in time, for the types in Knacke's manual: half an hour; resumable
	@/usr/bin/python3 validation/families/families.py --ripstop build/bin/ripstop --in-time

validate-symmetry: build  ## Steady drag of every example in the full flow domain and in a quarter, into docs/tables: half an hour; resumable
	@/usr/bin/python3 validation/families/families.py --ripstop build/bin/ripstop --runs runs/symmetry --symmetry $(if $(GRID),--grid $(GRID))

validate-openings: build  ## Coupled inflation of the same types, infinite mass, into docs/tables: half an hour; resumable
	@/usr/bin/python3 validation/families/families.py --ripstop build/bin/ripstop --openings

validate-filling: build  ## Openings of one canopy with one parameter changed at a time, into docs/tables: ten minutes; resumable
	@/usr/bin/python3 validation/opening/filling.py --ripstop build/bin/ripstop

validate-regimes: build  ## Openings over mass, size, speed and cloth compared with the handbook, into docs/tables: an hour; resumable
	@/usr/bin/python3 validation/opening/regimes.py --ripstop build/bin/ripstop

validate-convergence: build  ## Mean peak of openings on finer cloth and cells, into docs/tables: two hours; resumable
	@/usr/bin/python3 validation/opening/convergence.py --ripstop build/bin/ripstop

validate-flights: build  ## Free flights of eleven families, vents, cloths and grids compared with Knacke's values, into docs/tables: three hours; resumable
	@/usr/bin/python3 validation/flight/campaign.py --ripstop build/bin/ripstop
	@/usr/bin/python3 validation/flight/shipped.py

validate-stability: build  ## Static coefficients of three families over the angle of attack, into docs/tables: 10 minutes; resumable
	@/usr/bin/python3 validation/flight/static.py --ripstop build/bin/ripstop

validate-clusters: build  ## Force angle and cluster factor over spread angle and domain, into docs/tables: a quarter of an hour; resumable
	@/usr/bin/python3 validation/clusters/clusters.py --ripstop build/bin/ripstop

judge: check-deps build  ## Cross-validation of the built-in engine with OpenFOAM on fitted meshes, into docs/tables: an hour and more
	@cmake --preset release > /dev/null
	@cmake --build --preset release -j $(JOBS) --target bench_judge
	@/usr/bin/python3 validation/openfoam/judge.py --ripstop build/bin/ripstop

torture: build  ## Tiny runs with kills, failing writes, damaged files and wrong programs, into docs/tables: hours; resumable
	@/usr/bin/python3 validation/reliability/torture.py --ripstop build/bin/ripstop $(TORTURE)

test-sizes: build  ## ripstop size for 1,000 payloads, rates and heights, into docs/tables: a minute
	@/usr/bin/python3 validation/reliability/size_grid.py --ripstop build/bin/ripstop

test-studio: build  ## Times and memory of Studio over an hour of changes of all families, into docs/tables: an hour and more
	@/usr/bin/python3 bench/live_shape.py build/bin/ripstop | tee docs/tables/live-shape.md
	@/usr/bin/python3 bench/studio_memory.py build/bin/ripstop | tee docs/tables/studio-memory.md

test-tutorials: check-deps  ## Follow every tutorial from its page in a fresh clone, times into docs/tables: some minutes
	@cmake --preset release > /dev/null
	@cmake --build --preset release -j $(JOBS) --target ripstop_program ripstop_python
	@/usr/bin/python3 -B validation/tutorials/follow.py --ripstop build-check/bin/ripstop --python build-check/python

test-drawings: build  ## Cutting patterns opened by LibreCAD and Inkscape, and measured there
	$(call install_missing,$(DRAWING_PACKAGES))
	@/usr/bin/python3 validation/drawings/measure.py --ripstop build/bin/ripstop

test-slurm: build  ## Batch scripts through a real Slurm of two nodes on this machine (as root), into docs/tables: some minutes
	$(call install_missing,$(SLURM_PACKAGES))
	@/usr/bin/python3 validation/cluster/slurm.py --ripstop build/bin/ripstop $(SLURM)

test-hosts: build  ## OpenFOAM's ranks on two hosts, network namespaces of this machine (as root)
	$(call install_missing,iproute2)
	@/usr/bin/python3 validation/cluster/hosts.py --ripstop build/bin/ripstop

define test_debian
	$(call install_missing,debootstrap iproute2 git)
	@/usr/bin/python3 validation/systems/debian.py $(1) --jobs $(JOBS) $(SYSTEMS)
endef

test-debian13:  ## Build, tests and demo in an empty root of Debian 13, made by debootstrap (as root), into docs/tables: an hour
	$(call test_debian,13)

wheel-debian13:  ## The wheel for Python 3.13, made in an empty root of Debian 13 (as root), into build/wheel-debian13
	$(call test_debian,13 --wheel)

test-debian12:  ## The same in an empty root of Debian 12
	$(call test_debian,12)

scaling: build  ## OpenFOAM's time an iteration on 1, 2, 4 ... ranks up to the cores, into docs/tables; on an idle machine
	@/usr/bin/python3 validation/cluster/ranks.py --ripstop build/bin/ripstop

docs:  ## Build the documentation as a site for the browser, in build-docs/site, and check its links
	$(call install_missing,$(DOCS_PACKAGES))
	@/usr/bin/python3 -B docs/site/build.py

reference: check-deps  ## Write the generated pages of docs/reference: keys, commands, Python package
	@cmake --preset release > build-check.configure.log || { cat build-check.configure.log; exit 1; }
	@cmake --build --preset release -j $(JOBS) --target ripstop_program ripstop_python
	@/usr/bin/python3 docs/site/reference.py --program build-check/bin/ripstop --stub build-check/python/ripstop/_ripstop.pyi

report-libraries:  ## Rebuild three.js and uPlot of the report from npm, as package-lock.json pins them (needs node)
	@cd src/ripstop/report/vendor && npm ci --silent && npm run --silent build && rm -rf node_modules

format:  ## Format the sources
	@git ls-files '*.h' '*.cpp' | xargs clang-format -i

tidy: check-deps  ## clang-tidy over src and apps, on all cores (no part of check: some ten minutes)
	$(call install_missing,clang-tidy)
	@cmake --preset debug > /dev/null
	@run-clang-tidy -quiet -p build-debug -j $(JOBS) '^$(CURDIR)/(src|apps)/'

# Other versions of clang-format break some lines differently; the format is that of Debian 12's.
format-check:
	@case "$$(clang-format --version)" in *"version 14."*) git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run -Werror;; \
	  *) echo "The format of the sources is not checked: it is that of clang-format 14 (Debian 12).";; esac

install-build: deps
	$(call install_missing,$(PYTHON_PACKAGES))
	@cmake --preset program -DCMAKE_INSTALL_PREFIX=$(PREFIX) -DRIPSTOP_PYTHON=ON > build.configure.log || { cat build.configure.log; exit 1; }
	@cmake --build --preset program -j $(JOBS)

install: install-build  ## Install program, library and Python package below PREFIX (/usr/local)
	@$(SUDO) cmake --install build

wheel: install-build  ## The Python package as a wheel in build/wheel/
	$(call install_missing,$(WHEEL_PACKAGES))
	@cmake --build --preset program -j $(JOBS) --target wheel
	@ls build/wheel/*.whl

tarball: install-build docs  ## A portable archive in build/portable/: program, its libraries, materials, examples, documentation
	$(call install_missing,$(PORTABLE_PACKAGES))
	@/usr/bin/python3 -B packaging/tarball.py --build build --site build-docs/site --out build/portable

test-portable: tarball wheel package  ## Archive, wheel, packages and container in empty roots of Debian 12 and 13 (as root, by debootstrap), into docs/tables; PORTABLE=--coarse
	$(call install_missing,debootstrap iproute2 buildah)
	@/usr/bin/python3 validation/systems/portable.py --ripstop build/bin/ripstop --image $(PORTABLE) \
	  build/portable/*.tar.gz build/wheel/*.whl build/*.deb

IMAGE ?=
container: tarball  ## The image localhost/ripstop of the archive (buildah); IMAGE=FILE writes it; CONTAINER='--build-arg BASE=...'
	$(call install_missing,buildah)
	@buildah build $(CONTAINER) -f packaging/Containerfile -t localhost/ripstop build/portable
	@test -z "$(IMAGE)" || buildah push localhost/ripstop oci-archive:$(IMAGE)

package: docs install-build  ## Debian packages in build/, examined by lintian
	$(call install_missing,lintian)
	@cmake build > build.configure.log || { cat build.configure.log; exit 1; }  # the site of the documentation may be newer
	@rm -f build/*.deb && cd build && cpack -G DEB
	@lintian --tag-display-limit 0 --fail-on error,warning build/*.deb

release: wheel tarball package  ## All artefacts with SHA256SUMS in build/release, and the wheel of wheel-debian13 if it was made; a tree that is no release: RELEASE=--draft
	@/usr/bin/python3 -B packaging/release.py --build build --out build/release $(RELEASE)

clean:  ## Remove the build folders
	rm -rf build build-* build.configure.log
