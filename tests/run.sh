#!/usr/bin/env bash
# Builds Vitrine, installing what is missing, and runs every test of the release build, with the golden images.
# --full: also the engine compiled in other ways, which must give the same bits, and under the address,
# undefined-behaviour and thread sanitizers.
set -u
# shellcheck source=samples/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../samples/setup.sh"

full=no
case "${1:-}" in
  "") ;;
  --full) full=yes ;;
  -h | --help) sed -n "2,4s/^# //p" "${BASH_SOURCE[0]}"; exit 0 ;;
  *) fail "tests/run.sh: unknown argument '$1'; see --help" 2 ;;
esac

summary=()
failed=0

# runTests PRESET [CTEST_ARGUMENT...]: runs the tests of a built preset, keeps ctest's closing lines for the end.
runTests() {
  local preset=$1 log=$project_root/build/$1/tests.log
  shift
  say "$preset: running the tests"
  ctest --test-dir "$project_root/build/$preset" -j "$jobs" --output-on-failure --no-tests=error "$@" 2>&1 | tee "$log" |
    grep --line-buffered -vE '^ *Start +[0-9]+:|Passed +[0-9.]+ sec$'
  [ "${PIPESTATUS[0]}" -eq 0 ] || failed=1
  summary+=("$preset: $(grep -E 'tests passed, [0-9]+ tests? failed out of|^No tests were found' "$log" || echo 'ctest did not finish')")
}

needPackages "${build_packages[@]}" "${test_packages[@]}" -- "${build_packages_optional[@]}" "${test_packages_optional[@]}"

variants=OFF
[ "$full" = yes ] && variants=ON
buildPreset release all -DVITRINE_TESTS=ON -DVITRINE_VIEWER=ON -DVITRINE_VARIANTS=$variants
runTests release

if [ "$full" = yes ]; then
  # The engine alone. The address sanitizer has every unit test and foreign input to look at, the thread sanitizer what
  # shares work between threads.
  buildPreset asan-ubsan sanitized_tests -DVITRINE_VIEWER=OFF
  runTests asan-ubsan -R '^(unit|fuzz|determinism|compat)/'
  buildPreset tsan sanitized_tests -DVITRINE_VIEWER=OFF
  runTests tsan -R '^determinism/|^unit/.*(Task|World|Worker|Parallel|Thread)|^compat/.*(Task|Worker|Parallel)'
fi

say "summary after $((SECONDS / 60)) min $((SECONDS % 60)) s"
printf '%s\n' "${summary[@]}"
[ "$failed" -eq 0 ] || say "the images that were compared: build/release/report/index.html"
exit "$failed"
