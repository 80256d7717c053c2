# The two commands. Both install what is missing first (Debian and Ubuntu; elsewhere they say what to install).
.PHONY: demo test

# Builds in release, scores the demo set, and writes a report to look at.
demo:
	@.ci/setup any
	cargo build --release --locked
	@target/release/dejag doctor >/dev/null 2>&1 || .ci/setup software
	target/release/dejag score --size 320x180 --report captures/out/report

# Every test. DEJAG_TEST_ADAPTER=software (the default) or auto.
test:
	@.ci/setup $(if $(filter auto,$(DEJAG_TEST_ADAPTER)),any,software) browser
	@.ci/test
