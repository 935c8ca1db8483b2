# From the geometries in geo/ to pictures in results/. `make help` lists the targets.
#
#   geo/<scene>/*.geo, scene.json ──midplane──► results/<scene>/ ──check──► ──draw──► pictures/
#
# Another scene file in the same folder, such as geo/cantilever/pointwise.json, is a variant: its results go to
# results/<scene>_<file>/, and the graphs of the scene show both. Files named *study.json or *path.json are no scenes.
# Options for the pictures of a scene, such as exact values and how near tractions come to them, stand in
# geo/<scene>/draw.args, those for its history, if
# that is to be drawn, in geo/<scene>/history.args, and those for the check of its results, the error that its energies
# may have and what is known of it, in geo/<scene>/check.args or, for a variant, geo/<scene>/<file>.check.args.

.SUFFIXES:
.DEFAULT_GOAL := all

TARGET := $(or $(CARGO_TARGET_DIR),target)
MIDPLANE := $(TARGET)/release/midplane
VENV := .venv/ready
PYTHON := .venv/bin/python
PIPELINE := $(PYTHON) -m midplane_pipeline

SCENES := $(patsubst geo/%/scene.json,%,$(wildcard geo/*/scene.json))
# variants $1: names of the results of a scene's other scene files
variants = $(patsubst geo/$1/%.json,$1_%,$(filter-out %/scene.json %study.json %path.json,$(wildcard geo/$1/*.json)))

all: $(SCENES) law  ## build, solve every scene of the gallery, check the results, draw the pictures
	@echo "up to date: results/<scene>/, its pictures in results/<scene>/pictures/"

# the package that reads results and draws them; the one in pipeline/ stands on it
PACKAGE := $(wildcard python/src/midplane/*.py python/src/midplane/pictures/*.py)
MODULES := pipeline/midplane_pipeline
DRAWING := $(PACKAGE) $(wildcard $(addprefix $(MODULES)/,exact/*.py results/*.py)) \
    $(addprefix $(MODULES)/draw/,__main__.py coupling.py deviation.py history.py measured.py view_options.py)
# beside $1: scene, $2: results to show beside those of the scene
beside = $(foreach run,$2,--compare $(run:$1_%=%)=results/$(run))

# limits $1, $2: options for the check of a scene, folder and name of the file
limits = $(addprefix @,$(firstword $(wildcard geo/$1/$2.check.args geo/$1/check.args)))
CHECKING := $(wildcard $(addprefix $(MODULES)/,check/*.py results/*.py)) \
    $(addprefix python/src/midplane/,scene_file.py stored.py vtu.py)

# $1: name of the results, $2: folder, $3: scene file, $4: results to show beside these
define results
results/$1/.solved: $(filter-out %.args,$(wildcard geo/$2/*)) $(MIDPLANE) | tools
	$(MIDPLANE) run $3 -o results/$1
	@touch $$@

results/$1/.checked: results/$1/.solved results/$2/.solved $(CHECKING) $(wildcard geo/$2/*check.args) $(VENV)
	$(PIPELINE).check $3 results/$1 $(call limits,$2,$(basename $(notdir $3)))
	@touch $$@

results/$1/.drawn: results/$1/.checked $(patsubst %,results/%/.checked,$4)
results/$1/.drawn: $(DRAWING) $(wildcard geo/$2/*.args)
	$(PIPELINE).draw $3 results/$1 $(call beside,$2,$4) \
	    $(addprefix @,$(wildcard geo/$2/draw.args)) $(if $(filter-out $2,$1),--label=$(1:$2_%=%))
	$(if $(and $(filter $2,$1),$(wildcard geo/$2/history.args)),\
	    $(PIPELINE).draw.history $3 results/$1 $(call beside,$2,$4) @geo/$2/history.args)
	@touch $$@
endef

# $1: scene
define scene
.PHONY: $1
$1: results/$1/.drawn $(patsubst %,results/%/.drawn,$(call variants,$1))
$(call results,$1,$1,geo/$1/scene.json,$(call variants,$1))
$(foreach variant,$(call variants,$1),
$(call results,$(variant),$1,geo/$1/$(variant:$1_%=%).json,))
endef
$(foreach name,$(SCENES),$(eval $(call scene,$(name))))

# Example 2 at several pressures, over the curves of one point of its law
shear: results/shear/.example2
results/shear/.example2: results/shear/.checked results/shear_as_printed/.checked geo/shear/path.json
results/shear/.example2: $(MODULES)/draw/example2.py $(DRAWING)
	$(PIPELINE).draw.example2 $(MIDPLANE) geo/shear/path.json results/shear \
	    geo/shear/scene.json geo/shear/as_printed.json --within=6e-6
	for run in results/shear/scene_*/; do \
	    $(PIPELINE).check $$run/scene.json $$run $(call limits,shear,scene) || exit; \
	done
	for run in results/shear/as_printed_*/; do \
	    $(PIPELINE).check $$run/scene.json $$run $(call limits,shear,as_printed) || exit; \
	done
	@touch $@

# the dam in three files, beside crack lengths that were published
dam: results/dam/.levels
results/dam/.levels: results/dam/.checked results/dam_flow/.checked results/dam_workshop/.checked $(MODULES)/draw/dam.py $(DRAWING)
	$(PIPELINE).draw.dam geo/dam/scene.json results/dam --compare=flow=results/dam_flow \
	    --compare=workshop=results/dam_workshop --within=1e-8
	@touch $@

# 24 courses of 12 bricks and half ones, as coarse as they may be
WALL := results/wall300
wall-300: $(MIDPLANE) $(VENV)  ## a wall of 300 bricks, each a mesh of its own, pushed to failure, some minutes: results/wall300/
	mkdir -p $(WALL)
	$(PIPELINE).scenes.wall --courses 24 --bricks 12 --edges 1 2 --rows 1 --push 4.5e-3 --fields last \
	    --geo ../../geo/masonry_wall/brick.geo > $(WALL)/scene.json
	$(MIDPLANE) run $(WALL)/scene.json -o $(WALL)
	$(PIPELINE).check $(WALL)/scene.json $(WALL) @geo/masonry_wall/wall300.args
	$(PIPELINE).draw $(WALL)/scene.json $(WALL)
	$(PIPELINE).draw.history $(WALL)/scene.json $(WALL) --x=push="push of the beam [m]" --y=force="force [MN]"

generated: $(VENV) # what programs have written into the gallery is what they write
	@for top in load height free; do \
	    $(PIPELINE).scenes.wall --top $$top | cmp - geo/masonry_wall/$$(echo $$top | sed s/load/scene/).json || exit; \
	done
	@mkdir -p $(TARGET)/aggregate && $(PIPELINE).scenes.aggregate $(TARGET)/aggregate > /dev/null
	@for file in scene slip; do \
	    ! $(PIPELINE).exact.lining geo/lining/$$file.json | \
	        grep -vxFf geo/lining/$$(echo $$file.check.args | sed s/scene.//) || exit; \
	done
	@! $(PIPELINE).exact.delamination geo/delamination | grep ^-- | \
	    grep -vxFf geo/delamination/check.args | grep -vxFf geo/delamination/enf.check.args
	@for file in aggregates mortar; do cmp $(TARGET)/aggregate/$$file.geo geo/aggregate/$$file.geo || exit; done

animate-%: results/%/.checked  ## results/<scene>/pictures/displacement.gif: the stored rows of its scene.json
	$(PIPELINE).draw.animate geo/$*/scene.json results/$*

law: $(addprefix results/law/,shear.png closing.png)  ## drive one point of the cracking law along geo/{shear,closing}/path.json and draw it
results/law/shear.png: SAYS := --title="A crack shears and loses its strength" --subtitle="one point of Example 2 under −5 MPa"
results/law/closing.png: SAYS := --title="A crack opens, closes, is sheared under pressure, and opens again" \
    --subtitle="one point of Example 2 along geo/closing/path.json; the numbers follow the path"
results/law/%.png: geo/%/path.json geo/shear/scene.json $(MODULES)/draw/law.py $(PACKAGE) $(MIDPLANE) $(VENV)
	@mkdir -p results/law
	$(MIDPLANE) law geo/shear joint $< --tolerance 1e-6 > results/law/$*.csv
	$(PIPELINE).draw.law results/law/$*.csv --scene geo/shear/scene.json --interface joint $(SAYS) -o $@

check-%: $(MIDPLANE) $(VENV)  ## look at the joints of a scene before it is solved: results/<scene>/check/*.png
	$(MIDPLANE) check geo/$* -o results/$* --plot
	$(PIPELINE).draw.check results/$*/check

study-%: $(MIDPLANE) $(VENV)  ## the study of a scene, geo/<scene>/study.json, drawn: results/<scene>_study/
	$(MIDPLANE) study geo/$*/study.json
	$(PIPELINE).draw.study results/$*_study/study.json

$(MIDPLANE): Cargo.toml Cargo.lock $(shell find src -name '*.rs') | tools
	cargo build --release --locked

# without resolving anything: requirements.txt is complete
$(VENV): pipeline/requirements.txt | tools
	python3 -m venv --clear .venv
	.venv/bin/pip install --quiet --disable-pip-version-check --no-deps --require-hashes -r $<
	.venv/bin/pip check --disable-pip-version-check
	printf '%s\n' "$(CURDIR)/python/src" "$(CURDIR)/pipeline" > "$$(.venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/midplane.pth"
	@touch $@

# the package as a stranger installs it, apart from the sources, with what its tests and notebooks need
NOTEBOOKS := .venv-notebooks/ready
$(NOTEBOOKS): python/requirements.txt | tools
	python3 -m venv --clear .venv-notebooks
	.venv-notebooks/bin/pip install --quiet --disable-pip-version-check --no-deps --require-hashes -r $<
	.venv-notebooks/bin/pip check --disable-pip-version-check
	@touch $@

notebooks: $(MIDPLANE) $(NOTEBOOKS)  ## the Python package: types, format, tests; its notebooks, run from an installed wheel: results/notebooks/
	cd python && ../.venv-notebooks/bin/ruff check . && ../.venv-notebooks/bin/ruff format --check . && ../.venv-notebooks/bin/mypy
	rm -rf results/notebooks && mkdir -p results/notebooks
	.venv-notebooks/bin/pip wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation -w results/notebooks ./python
	.venv-notebooks/bin/pip install --quiet --disable-pip-version-check --no-deps --force-reinstall results/notebooks/*.whl
	cd python && MIDPLANE="$(abspath $(MIDPLANE))" ../.venv-notebooks/bin/python -m pytest -q
	MIDPLANE="$(abspath $(MIDPLANE))" MIDPLANE_GEO="$(CURDIR)/geo" .venv-notebooks/bin/python python/notebooks/execute.py \
	    results/notebooks $(if $(docs),--keep)

# the book's own environment: nothing of it is needed for anything else
BOOK := .venv-book/ready
$(BOOK): docs/requirements.txt | tools
	python3 -m venv --clear .venv-book
	.venv-book/bin/pip install --quiet --disable-pip-version-check --no-deps --require-hashes -r $<
	@touch $@

keys: $(MIDPLANE) $(VENV)  ## renew the schemas in geo/ and docs/KEYS.md from the program
	$(MIDPLANE) schema --write geo/scene.schema.json
	$(MIDPLANE) schema study --write geo/study.schema.json
	$(PIPELINE).book.keys geo/scene.schema.json geo/study.schema.json > docs/KEYS.md

book: $(BOOK) $(VENV)  ## all documents as a site, every link checked: results/book/index.html
	$(PIPELINE).book.keys geo/scene.schema.json geo/study.schema.json | cmp - docs/KEYS.md
	test $$(wc -l < README.md) -le 120
	rm -rf results/book && .venv-book/bin/sphinx-build -W --keep-going -q -b html docs results/book
	@echo "results/book/index.html"

book-test: $(MIDPLANE) $(VENV)  ## run every command of README.md and docs/, in order, as a reader would
	$(PIPELINE).book.commands --program $(MIDPLANE) README.md $(filter-out docs/KEYS.md,$(wildcard docs/*.md))

# packages, from what stands in target/deb: manual pages, completions, the wheel
CARGO_DEB := $(TARGET)/tools/bin/cargo-deb
$(CARGO_DEB): | tools
	cargo install --quiet --locked --no-default-features --root $(TARGET)/tools cargo-deb@3.8.0

wheel: $(NOTEBOOKS)  ## the Python package: target/deb/midplane-*.whl
	rm -f $(TARGET)/deb/*.whl && mkdir -p $(TARGET)/deb
	.venv-notebooks/bin/pip wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation -w $(TARGET)/deb ./python

deb: $(MIDPLANE) $(CARGO_DEB) wheel book  ## a Debian package: target/debian/midplane_*.deb
	rm -rf $(TARGET)/deb/man && $(MIDPLANE) manual $(TARGET)/deb/man
	$(MIDPLANE) completions bash > $(TARGET)/deb/midplane.bash
	$(MIDPLANE) completions zsh > $(TARGET)/deb/_midplane
	$(MIDPLANE) completions fish > $(TARGET)/deb/midplane.fish
	rm -f $(TARGET)/debian/*.deb && $(CARGO_DEB) --no-build --no-strip

package-test: deb $(VENV)  ## unpack .deb and wheel into empty places and run the first scene from there; `root=DIR`: in a Debian of their own
	$(PIPELINE).house.packages $(TARGET)/debian/*.deb $(TARGET)/deb/*.whl -o results/packages $(if $(root),--root $(root))

tools:            ## install what is missing on the system, or say what it is
	@pipeline/tools.sh

browser:          # for the page of `make trade`, if it can be had
	@pipeline/tools.sh browser

build: $(MIDPLANE)  ## the program only, target/release/midplane

test: $(VENV)     ## all tests, in release, so that dependencies compile once; those of pipeline/
	cargo test --release --locked
	cargo test --release --locked --manifest-path patches/lexical-core/Cargo.toml --target-dir $(TARGET)/patches
	cd pipeline && ../$(PYTHON) -m pytest -q

# the program of another commit, such as the one before a redesign, is built beside this one
identical: $(MIDPLANE) $(VENV)  ## run the gallery with the program of commit `before` and with this one, compare bit by bit
	rm -rf $(TARGET)/before && git worktree prune && git worktree add --force --detach $(TARGET)/before $(before)
	cargo build --release --locked --manifest-path $(TARGET)/before/Cargo.toml --target-dir $(TARGET)/before/target
	$(PIPELINE).robust.identical $(TARGET)/before/target/release/midplane $(MIDPLANE)

confinement: | tools  ## the long tests: boxes at every confinement on fine meshes, and 200 random ones, some minutes
	cargo test --release --locked --test equilibrium confinement:: -- --ignored --nocapture

BENCHED := results/bench/scenes.csv $(wildcard results/bench/peers*.csv)

# every row of docs/EXTREMES.md; `rows=B9` or `rows="B1 B2"` tries these only, without touching the docs
extremes: $(MIDPLANE) $(VENV)  ## try every extreme, write docs/EXTREMES.md and results/extremes/report.html, ten minutes
	$(PIPELINE).extremes $(MIDPLANE) -o results/extremes $(or $(rows),--docs docs)

extremes-quick: $(MIDPLANE) $(VENV)  ## the same with shorter sweeps: results/extremes-quick/report.html
	$(PIPELINE).extremes $(MIDPLANE) -o results/extremes-quick --quick $(rows)

hostile-test: | tools  ## geometries from strangers: all are contained and say why
	cargo test --release --locked --test program hostile:: -- --nocapture

damage-test: $(MIDPLANE) $(VENV)  ## ten thousand damaged scenes, geometries, meshes, studies and paths, a quarter of an hour
	$(PIPELINE).robust.damage $(MIDPLANE) -o results/damage

damage-test-quick: $(MIDPLANE) $(VENV)  ## a few hundred of them
	$(PIPELINE).robust.damage $(MIDPLANE) --count 400 -o results/damage-quick

# a screen that is not there yet when it is asked for is asked for once more
test-paraview: $(addprefix results/,masonry/.solved tension/.solved)  ## open and play results in ParaView, save pictures; installs it
	pipeline/tools.sh paraview
	play() { xvfb-run -a pvpython $(MODULES)/check/in_paraview.py results/$$1 results/paraview; }; \
	for scene in tension masonry; do play $$scene || play $$scene || exit; done

# the targets share all that they depend on with the program; only the crates of this workspace have the fuzzer's counters
fuzz-build: $(MIDPLANE) $(VENV)
	pipeline/tools.sh compiler
	RUSTC_WORKSPACE_WRAPPER=$(CURDIR)/tests/fuzz/instrument.sh cargo build --release --locked -p midplane-fuzz --bins

fuzz: fuzz-build  ## ten million inputs made by libFuzzer to meshes, scenes, studies, paths, formulas and pairing, some minutes
	$(PIPELINE).robust.fuzz $(dir $(MIDPLANE)) $(if $(minutes),--seconds $$(($(minutes) * 60)) --runs 1000000000) -o results/fuzz

fuzz-quick: fuzz-build  ## the same with a hundred thousand or so each, never quite the same ones
	$(PIPELINE).robust.fuzz $(dir $(MIDPLANE)) --runs 100000 -o results/fuzz-quick

robustness-docs: $(VENV)  ## put what damage-test and fuzz have found into docs/ROBUSTNESS.md
	$(PIPELINE).robust.docs results/damage/report.json results/fuzz/report.json docs/ROBUSTNESS.md

mutants: $(VENV)  ## 200 places of pairing, projection, laws and load history made wrong, an hour: results/mutants/report.md
	cargo build --release --locked -p midplane-mutants
	$(PIPELINE).robust.mutants $(TARGET)/release/mutants -o results/mutants $(if $(again),--again) $(if $(docs),--docs docs)

kill-test: $(MIDPLANE) $(VENV)  ## 200 kills, 60 signals, 20 full disks, 50 pairs of runs, some minutes
	$(PIPELINE).robust.kill $(MIDPLANE) -o results/kill-test

kill-test-quick: $(MIDPLANE) $(VENV)  ## a few of each
	$(PIPELINE).robust.kill $(MIDPLANE) -o results/kill-test-quick --kills 24 --signals 12 --disks 5 --pairs 6

cluster-test: $(MIDPLANE) $(VENV)  ## a study in shards, as a Slurm array (by a stand-in) and by Snakemake if `python` has it, compared with one process
	$(PIPELINE).robust.cluster $(MIDPLANE) -o results/cluster-test $(if $(python),--python $(python))

bench-growth: $(MIDPLANE) $(VENV)  ## what 10 000 increments write, and the price of checkpoints, five minutes
	$(PIPELINE).bench.growth $(MIDPLANE)

bench: $(MIDPLANE) $(VENV)  ## whole runs of 10 000 to 1 000 000 dofs, then the kernels: results/bench/, some minutes
	$(PIPELINE).bench.scenes $(MIDPLANE)
	$(PIPELINE).bench.plot $(BENCHED) -o results/bench/bench.png
	cargo bench --locked --bench kernels --bench law

bench-quick: $(MIDPLANE) $(VENV)  ## the same at 10 000 dofs only, in seconds
	$(PIPELINE).bench.scenes $(MIDPLANE) --sizes 10k --repeat 2 -o results/bench-quick
	$(PIPELINE).bench.plot results/bench-quick/scenes.csv -o results/bench-quick/bench.png
	$(PIPELINE).bench.below $(MIDPLANE) --repeat 3
	$(PIPELINE).bench.growth $(MIDPLANE) --increments 1000 --repeat 3 -o results/bench-quick/growth
	$(PIPELINE).bench.walls $(MIDPLANE) --sizes 100 --increments 5 -o results/bench-quick/walls
	cargo bench --locked --bench kernels -- '10000$$'
	cargo bench --locked --bench law
	cargo bench --locked --bench pairing

# NGSolve and scikit-fem go to .venv-peers; GetFEM and CalculiX are those of the system, skipped where it has none:
# apt-get install python3-getfem python3-meshio calculix-ccx
bench-peers: $(MIDPLANE) $(VENV)  ## the same runs beside NGSolve, scikit-fem, GetFEM, CalculiX: results/bench/peers.csv
	test -d .venv-peers || python3 -m venv .venv-peers
	for peer in ngsolve scikit-fem pypardiso; do .venv-peers/bin/pip install --quiet $$peer \
	    -c $(MODULES)/bench/peers/requirements.txt meshio scipy || echo "$$peer: cannot be installed, skipped"; done
	$(PIPELINE).bench.peers.compare $(MIDPLANE) .venv-peers/bin/python

bench-strategies: $(MIDPLANE) $(VENV)  ## `strategy: auto` beside all others, on the gallery and walls up to a thousand bricks, ten minutes
	$(PIPELINE).bench.strategies $(MIDPLANE)

bench-walls: $(MIDPLANE) $(VENV)  ## walls of 100 to 10 000 bricks, how they grow, beside scikit-fem, half an hour: results/bench/walls/
	test -d .venv-peers || python3 -m venv .venv-peers
	.venv-peers/bin/pip install --quiet scikit-fem pypardiso -c $(MODULES)/bench/peers/requirements.txt meshio scipy
	$(PIPELINE).bench.walls $(MIDPLANE) --large --peer .venv-peers/bin/python

bench-docs: $(VENV)  ## put the tables and the plot of results/bench/ into docs/BENCH.md
	$(PIPELINE).bench.plot $(BENCHED) -o docs/bench.png
	$(PIPELINE).bench.table docs/BENCH.md $(BENCHED)
	mkdir -p docs/bench && cp $(BENCHED) docs/bench/

TRADE := $(wildcard $(MODULES)/trade/*.py)

trade: results/trade/trade.html  ## speed against accuracy of six scenes, measured afresh, half an hour: results/trade/trade.html

results/trade/trade.html: $(MIDPLANE) $(VENV) $(TRADE) .FORCE | browser
	$(PIPELINE).trade $(MIDPLANE) --fresh $(if $(FULL),--form full) -o results/trade
	cargo bench --locked --bench elastic > results/trade/elastic.txt
	cargo bench --locked --bench precision > results/trade/precision.txt
	$(PIPELINE).trade.page results/trade/trade.json
	$(PIPELINE).trade.browser $@

# and with every point of the front on moved nodes, turned, and under a counter of instructions
trade-full:       ## the same with 64 points of the hypercube and checks of the front, hours
	$(MAKE) trade FULL=1

trade-robust: $(MIDPLANE) $(VENV)  ## these checks for the fronts that `make trade` has measured
	$(PIPELINE).trade $(MIDPLANE) --robust -o results/trade
	$(PIPELINE).trade.page results/trade/trade.json

trade-compare: $(VENV)  ## whether the fronts of two campaigns agree: make trade-compare with=<an earlier trade.json>
	$(PIPELINE).trade.compare results/trade/trade.json $(with)

trade-quick: $(MIDPLANE) $(VENV) | browser  ## the same on four scenes with coarse meshes, in 3 minutes
	$(PIPELINE).trade $(MIDPLANE) --fresh --form reduced -o results/trade-quick
	$(PIPELINE).trade.page results/trade-quick/trade.json
	$(PIPELINE).trade.browser results/trade-quick/trade.html

trade-docs: $(VENV)  ## put what `make trade` has measured into docs/trade/ and docs/CHOOSING.md
	$(PIPELINE).trade.page results/trade/trade.json -o docs/trade
	$(PIPELINE).trade.docs results/trade docs/trade docs/CHOOSING.md

verify: | tools   ## errors and rates against exact solutions, written to docs/VERIFICATION.md
	@rm -rf results/verify && mkdir -p results/verify
	MIDPLANE_TABLES=$(CURDIR)/results/verify cargo test --release --locked --test coupling -- example1:: patch:: round:: verify::
	@{ printf '# Verification\n\nWritten by `make verify`; the tests that make these tables assert their claims.\n'; \
	    for table in results/verify/*.md; do echo; sed 's,^### ,## ,' $$table; done; } > docs/VERIFICATION.md

lint: generated   ## format, clippy, ruff and mypy, warnings are errors; advisories and licences of what is used
	cargo fmt --check -p midplane -p midplane-fuzz -p midplane-mutants
	for folder in pipeline python; do \
	    (cd $$folder && ../.venv/bin/ruff check . && ../.venv/bin/ruff format --check . && ../.venv/bin/mypy) || exit; \
	done
	$(PIPELINE).house.advisories check
	$(PIPELINE).house.licences check
	cargo clippy --release --locked --workspace --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --quiet --release --locked --no-deps -p midplane

docs: $(SCENES) law check-four_blocks  ## renew the pictures of the README
	cp results/compression/pictures/coupling_joint.png docs/compression_coupling.png
	cp results/compression/pictures/principal_stress.png docs/compression_stress.png
	cp results/cantilever/pictures/traction_joint.png docs/cantilever_traction.png
	cp results/ring/pictures/coupling_joint.png docs/ring_coupling.png
	cp results/four_blocks/pictures/displacement.png docs/four_blocks.png
	cp results/four_blocks/check/joints~sw~nw.png docs/four_blocks_check.png
	cp results/law/shear.png docs/law_shear.png
	cp results/law/closing.png docs/law_closing.png
	cp results/shear/pictures/example2.png docs/shear_example2.png
	cp results/shear_box/pictures/traction_joint.png docs/shear_box_traction.png
	cp results/bar/pictures/history.png docs/bar_path.png
	cp results/dcb/pictures/history.png docs/dcb_path.png
	cp results/dcb/pictures/traction_joint.png docs/dcb_traction.png
	cp results/friction_block/pictures/traction_joint.png docs/friction_block_traction.png
	mkdir -p docs/gallery
	cp results/dam/pictures/dam.png docs/gallery/dam.png
	cp results/masonry_wall_height/pictures/interfaces.png docs/gallery/masonry_wall.png
	cp results/aggregate/pictures/interfaces.png docs/gallery/aggregate.png
	cp results/aggregate_shear/pictures/interfaces.png docs/gallery/aggregate_shear.png
	cp results/mixed_beam/pictures/displacement.png docs/gallery/mixed_beam.png
	cp results/sneddon/pictures/displacement.png docs/gallery/sneddon.png
	cp results/hertz/pictures/traction_joint.png docs/gallery/hertz.png
	cp results/lining/pictures/principal_stress.png docs/gallery/lining.png
	for scene in half_notched_beam pull_out delamination notched_beam; do \
	    cp results/$$scene/pictures/history.png docs/gallery/$$scene.png || exit; \
	done

clean:            ## remove everything made here: results, build, Python environment
	rm -rf results .venv .venv-notebooks .venv-book
	cargo clean

help:             ## this list
	@echo "make [target]; without one: all"
	@sed -nE 's/^([a-z0-9%-]+):[^#]*## /  \1\t/p' Makefile | expand -t 18
	@for name in $(SCENES); do \
	    printf '  %s\t%s\n' "$$name" "$$(sed -nE 's/^ *"title": "(.*)",/\1/p' geo/$$name/scene.json)"; \
	done | expand -t 18

# what depends on it is made whenever it is asked for
.FORCE:


.PHONY: keys book book-test wheel deb package-test all notebooks bench-walls wall-300 generated test-paraview tools browser build test confinement extremes extremes-quick hostile-test damage-test damage-test-quick fuzz-build fuzz fuzz-quick robustness-docs mutants kill-test kill-test-quick cluster-test bench-growth trade trade-full trade-quick trade-robust trade-compare trade-docs bench bench-quick bench-peers bench-docs law verify lint docs clean help
