# raingauge: `make look` draws pictures and shows what was found, `make tables` regenerates the papers'
# tables, `make test` runs every test. All install what Debian packages are missing, build, say what they
# do, and can be run again at no cost. What apt and the compilers print lies in build/*.log.
# `make results` replaces the tables that the repository keeps, of which `make printed` makes those that do as much work as
# the papers; `make thorough` runs the tests that
# take too long for every change; `make mutants` tries the tests themselves, with faults, and `make gate-selftest` the gate, with
# builds that are the same and that are slower; `make claims` decides what papers claim, in a night, and
# `make claims-selftest` tries that on cells whose truth is known; `make lint` has tools look for faults in the sources;
# `make deb` builds Debian packages, and `make image` of these an image for containers (VARIANT=small: without PoCL and OpenImageIO).
.POSIX:
.PHONY: all setup build whole look tables committed printed results claims test thorough test-farm mutants gate-selftest claims-selftest lint deb image clean format

BUILD = build
ASAN = build-asan
TSAN = build-tsan
TABLES = $(BUILD)/tables
LOOK = $(BUILD)/look
# How long they may take together.
BUDGET = 4m
RESULTS = results/tables
# Tables with the papers' own settings, each cell timed in three launches.
PRINTED = results/printed
# Launches for claims, and what `make claims` measures: names of tables, --device, --full, --budget 8h.
CLAIMS = results/claims
KEPT = $$(! ls $(CLAIMS)/*.json >/dev/null 2>&1 || echo "--kept $(CLAIMS)")
# What `make results` measures: names of tables, --quick or --full; all tables, quick, where it is
# empty. What `make mutants` tries: areas, as images, all unless it has any.
WHAT =
MODELS = /usr/share/doc/libcgal-dev/data.tar.gz
JOBS = $$(nproc)
STEPS = python3 tests/tools/steps.py
# Warnings of a compiler that nobody has tried stop no user. Builds for sanitizers and those of meson by hand have them as errors.
USERS = -Dwerror=false
# `make look` builds for one level of processors alone, which is sooner done.
ALL_LEVELS = test ! -e $(BUILD)/one-level || \
  { meson configure $(BUILD) -Dlevels=v2,v3,v4 && rm $(BUILD)/one-level; }

all: build

# Installs the packages of packages.txt that are missing, with sudo unless root. An optional one is
# asked for once the lists are fetched, for a Debian may have none of its name. Images for containers
# leave out /usr/share/doc, where libcgal-demo keeps its models: they are let through, and the package
# is installed again where it came without. Those of tests alone are left out unless FOR is tests.
setup:
	@lacks() { ! dpkg-query -W -f '$${Status}' $$1 2>/dev/null | grep -q 'ok installed'; }; \
	case "$(FOR)" in tests) kept='s/ test$$//';; *) kept='/ test$$/d';; esac; \
	missing=; for package in $$(sed "s/#.*//; / optional$$/d; $$kept" packages.txt); do \
	  ! lacks $$package || missing="$$missing $$package"; \
	done; \
	case "$$missing" in \
	  *libcgal-demo*) ;; \
	  *) test -e $(MODELS) || missing="$$missing libcgal-demo";; \
	esac; \
	as_root=; [ "$$(id -u)" = 0 ] || as_root=sudo; \
	said() { mkdir -p $(BUILD) && "$$@" >>$(BUILD)/packages.log 2>&1 || \
	  { tail -n 30 $(BUILD)/packages.log; echo "$(BUILD)/packages.log has all that apt said"; exit 1; }; }; \
	[ -z "$$missing" ] || said $$as_root apt-get update -q; \
	for package in $$(sed -n 's/^\([^#]*\) optional$$/\1/p' packages.txt); do \
	  ! lacks $$package || ! apt-cache show $$package >/dev/null 2>&1 || \
	    missing="$$missing $$package"; \
	done; \
	if [ -n "$$missing" ]; then \
	  echo "== installing $$(echo $$missing | wc -w) Debian packages:$$missing"; \
	  said $$as_root env DEBIAN_FRONTEND=noninteractive \
	    apt-get install -qy --no-install-recommends --reinstall \
	    -o 'Dpkg::Options::=--path-include=/usr/share/doc/libcgal-dev/*' $$missing; \
	fi

$(BUILD)/build.ninja:
	@$(MAKE) --no-print-directory setup
	@echo "== configuring $(BUILD)"
	@meson setup $(BUILD) $(USERS) >/dev/null || { cat $(BUILD)/meson-logs/meson-log.txt; exit 1; }

$(ASAN)/build.ninja:
	@echo "== configuring $(ASAN), with address and undefined-behaviour sanitizers"
	@meson setup $(ASAN) -Doptimization=1 -Ddebug=true -Db_sanitize=address,undefined \
	  -Db_lundef=false -Ddrivers=false >/dev/null || { cat $(ASAN)/meson-logs/meson-log.txt; exit 1; }

$(TSAN)/build.ninja:
	@echo "== configuring $(TSAN), with the thread sanitizer"
	@meson setup $(TSAN) -Doptimization=1 -Ddebug=true -Db_sanitize=thread \
	  -Db_lundef=false -Ddrivers=false >/dev/null || { cat $(TSAN)/meson-logs/meson-log.txt; exit 1; }

build: setup $(BUILD)/build.ninja
	@$(ALL_LEVELS)
	@echo "== building the program in $(BUILD)"
	@$(STEPS) $(BUILD)/build.log ninja -C $(BUILD) program

# The program, and what tests it.
whole: $(BUILD)/build.ninja
	@$(MAKE) --no-print-directory setup FOR=tests
	@$(ALL_LEVELS)
	@echo "== building the program and its tests in $(BUILD)"
	@$(STEPS) $(BUILD)/build.log ninja -C $(BUILD)

look: setup
	@test -e $(BUILD)/build.ninja || { echo "== configuring $(BUILD) for one level of processors"; mkdir -p $(BUILD); \
	  meson setup $(BUILD) $(USERS) -Dlevels=v3 >$(BUILD)/build.log 2>&1 || { cat $(BUILD)/build.log; exit 1; }; \
	  touch $(BUILD)/one-level; }
	@echo "== building the program in $(BUILD)"
	@$(STEPS) $(BUILD)/build.log ninja -C $(BUILD) program
	@echo "== drawing three pictures into $(LOOK)"
	@mkdir -p $(LOOK)
	@for name in streaks flow drops; do $(BUILD)/harness/raingauge render $$name -o $(LOOK)/$$name.png; done
	@echo "== what the papers claim, and what was found of it, by the records in $(RESULTS)"
	@$(BUILD)/harness/raingauge table --claims --from $(RESULTS) $(KEPT)
	@$(BUILD)/harness/raingauge report $(RESULTS) docs/pictures.md $(KEPT) -o $(LOOK)/page.html
	@echo "== look at $(LOOK)/streaks.png, flow.png and drops.png, and at $(LOOK)/page.html in a browser"

# What was measured by this build before, within the same time, is printed again.
tables: build
	@kept="$(KEPT)"; \
	if test "$$(cat $(TABLES)/done 2>/dev/null)" = "$(BUDGET)" && \
	  test -z "$$(find $(BUILD)/harness $(BUILD)/backends $(BUILD)/kernels -type f -newer $(TABLES)/done)"; then \
	  echo "== the tables in $(TABLES) are of this build; rm -r $(TABLES) has them measured anew"; \
	  $(BUILD)/harness/raingauge table --claims $$kept --from $(TABLES); \
	else \
	  echo "== having drivers compile what the tables draw with, which they keep"; \
	  $(BUILD)/harness/raingauge table --compile; \
	  echo "== regenerating the tables on every device, within $(BUDGET), into $(TABLES)"; \
	  rm -rf $(TABLES); \
	  $(BUILD)/harness/raingauge table --budget $(BUDGET) --claims $$kept -o $(TABLES) && echo "$(BUDGET)" >$(TABLES)/done; \
	fi
	@$(BUILD)/harness/raingauge report $(TABLES) docs/pictures.md $(KEPT) -o $(BUILD)/page.html

# A record names the commit that it was measured with.
committed:
	@changes=$$(git status --porcelain) && test -z "$$changes" || { \
	  echo "make results: the tree has changes that no commit holds, so that records could not name" \
	    "what they measured; commit them, or put them by with git stash -u" >&2; exit 2; }

# Goes on where it was interrupted.
printed: committed build
	@echo "== measuring on cpu what the papers print, with their settings, into $(PRINTED): hours"
	@$(BUILD)/harness/raingauge table $(WHAT) --full --work paper --device cpu --launches 3 -o $(BUILD)/printed
	@python3 results/keep.py $(BUILD)/printed $(PRINTED)

results: committed build
	@echo "== regenerating the tables on every device, $(or $(WHAT),--quick), into $(RESULTS)"
	@$(BUILD)/harness/raingauge table $(or $(WHAT),--quick) -o $(BUILD)/results
	@python3 results/keep.py $(BUILD)/results $(RESULTS)
	@python3 results/figures.py $(RESULTS)
	@python3 results/walk.py $(BUILD)/harness/raingauge
	@$(BUILD)/harness/raingauge report $(RESULTS) docs/pictures.md $(KEPT) -o $(BUILD)/results.html

# Goes on where it was interrupted. A record of launches names the commit and the machine.
claims: committed build
	@echo "== deciding what papers claim, $(or $(WHAT),--quick), by launches, into $(CLAIMS): a night"
	@$(BUILD)/harness/raingauge claims $(or $(WHAT),--quick) -o $(BUILD)/claims
	@mkdir -p $(CLAIMS)
	@python3 results/keep.py $(BUILD)/claims $(CLAIMS)

# One test more than there are cores, since some wait: for drivers that hang, and for locks.
AT_ONCE = --num-processes $$(($$(nproc) + 1))

# Tests of host code run under sanitizers alone, and only what each build tests is built in it.
DRIVEN = --no-suite host
SANITIZED = --suite sanitized --suite host
NEEDED = python3 tests/tools/needed.py
# Under sanitizers the test of the atlas traces one. The other, of measured drops, which the same code makes, is the build's.
ATLASES = tests/cache/raingauge

test: $(BUILD)/build.ninja $(ASAN)/build.ninja
	@$(MAKE) --no-print-directory setup FOR=tests
	@$(ALL_LEVELS)
	@echo "== building the program and its tests in $(BUILD)"
	@$(STEPS) $(BUILD)/build.log ninja -C $(BUILD) program $$($(NEEDED) $(BUILD) $(DRIVEN))
	@echo "== building in $(ASAN)"
	@$(STEPS) $(ASAN)/build.log ninja -C $(ASAN) $$($(NEEDED) $(ASAN) $(SANITIZED))
	@echo "== testing, all devices"
	@meson test -C $(BUILD) --no-rebuild --print-errorlogs $(AT_ONCE) $(DRIVEN) || true
	@mkdir -p $(ASAN)/$(ATLASES) && cp -p $(BUILD)/$(ATLASES)/streaks-measured-small.atlas $(ASAN)/$(ATLASES) 2>/dev/null || true
	@echo "== testing under sanitizers, the CPU devices and the harness"
	@meson test -C $(ASAN) --no-rebuild --print-errorlogs $(AT_ONCE) $(SANITIZED) || true
	@python3 tests/tools/summary.py $(BUILD)/meson-logs/testlog.json $(ASAN)/meson-logs/testlog.json

thorough: whole $(TSAN)/build.ninja
	@echo "== testing at length, all devices"
	@meson test -C $(BUILD) --no-rebuild --print-errorlogs --setup thorough --suite thorough || true
	@echo "== testing in $(TSAN): whether threads race"
	@meson test -C $(TSAN) --print-errorlogs --suite watched || true
	@python3 tests/tools/summary.py $(BUILD)/meson-logs/testlog-thorough.json $(TSAN)/meson-logs/testlog.json

# With daemons of its own in a temporary folder. These packages are of this test alone.
test-farm: build
	@echo "== running a plan on two nodes of a Slurm that lives here, one of which falls; two minutes"
	@python3 tests/harness/farm/slurm.py $(BUILD)/harness/raingauge

mutants: whole
	@echo "== trying the tests with faults in host code and kernels, one at a time"
	@python3 tests/mutants/mutants.py $(BUILD) $(WHAT)

gate-selftest: whole
	@echo "== gating what is the same, and what does 5 % more, while another process is busy; an hour or two"
	@python3 tests/harness/gate/selftest.py $(BUILD) --keep $(BUILD)/selftest

claims-selftest: whole
	@echo "== deciding claims whose truth is known, while another process is busy; hours"
	@python3 tests/harness/results/launching/selftest.py $(BUILD)

# `make test` has cppcheck look; the others take minutes. clang-tidy is of the version that formats.
LINTERS = clang-tidy cppcheck
lint: build
	@lacks() { ! dpkg-query -W -f '$${Status}' $$1 2>/dev/null | grep -q 'ok installed'; }; \
	missing=; for package in $(LINTERS); do ! lacks $$package || missing="$$missing $$package"; done; \
	as_root=; [ "$$(id -u)" = 0 ] || as_root=sudo; \
	[ -z "$$missing" ] || $$as_root apt-get install -qy --no-install-recommends $$missing
	@echo "== looking for faults in core, harness and backends: gcc's analyzer, cppcheck and clang-tidy, some minutes"
	@python3 tests/tools/lint.py $(BUILD) gcc cppcheck clang-tidy

# Of the last commit, with the packages of debian/control and lintian, in $(BUILD)/deb. The ITP is a bug that an upload closes.
deb:
	@echo "== building a Debian package in $(BUILD)/deb"
	@rm -rf $(BUILD)/deb && git clone --quiet . $(BUILD)/deb/raingauge
	@$(STEPS) $(BUILD)/deb/build.log sh -c 'cd $(BUILD)/deb/raingauge && dpkg-buildpackage -b -us -uc -j$(JOBS)'
	@lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs $(BUILD)/deb/*.changes
	@ls $(BUILD)/deb/*.deb

# Of the packages that `make deb` left, without Docker; it needs mmdebstrap and network.
VARIANT = full
IMAGE = $(BUILD)/raingauge-$(VARIANT).tar
image:
	@ls $(BUILD)/deb/raingauge-oiio_*.deb >/dev/null 2>&1 || $(MAKE) --no-print-directory deb
	@echo "== making an image for containers, some minutes"
	@python3 docs/ci/image/make.py $(VARIANT) --debs $(BUILD)/deb -o $(IMAGE) 2>$(BUILD)/image.log || \
	  { tail -n 30 $(BUILD)/image.log; exit 1; }

format:
	@git ls-files '*.c' '*.h' '*.cpp' | xargs clang-format -i

clean:
	rm -rf $(BUILD) $(ASAN) $(TSAN)
