#!/bin/sh
# Fuzzes readers with coverage, each for so many seconds: fuzz/run.sh SECONDS READER...
# The corpus stays in build-fuzz/corpus/<reader>, so that the next call goes on with it; a find lies beside it.
set -e
build=build-fuzz/fuzz
seconds=$1
shift
"$build/fuzz_make_seeds" "$build/seeds"
for reader in "$@"; do
  corpus=build-fuzz/corpus/$reader
  mkdir -p "$corpus"
  # The seeds, files or folders of files, flat: a corpus has no folders.
  while read -r seed; do
    find "$seed" -type f | while read -r file; do
      cp "$file" "$corpus/seed-$(echo "$file" | tr '/' '_')"
    done
  done < "$build/$reader.seeds"
  echo "== $reader"
  RIPSTOP_DATA=$PWD "$build/fuzz_$reader" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 -max_len=65536 \
    -print_final_stats=1 -artifact_prefix="build-fuzz/find-$reader-" "$corpus" > "build-fuzz/$reader.log" 2>&1 ||
    { tail -40 "build-fuzz/$reader.log"; exit 1; }
  grep -E "stat::number_of_executed_units|stat::peak_rss_mb" "build-fuzz/$reader.log"
done
