#!/usr/bin/env bash
# The command line as a user meets it: every command once, in an empty folder.
# Usage: tests/smoke.sh FOLDER_OF_THE_PROGRAM
set -uo pipefail
bin=$(cd "$1" && pwd) || exit 1
topomap=$bin/topomap

folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

expect() { # expect CODE ARGUMENTS...: run the program, hold its exit code to CODE
    local code=$1 found
    shift
    "$topomap" "$@" >out 2>err </dev/null
    found=$?
    if [ "$found" -ne "$code" ]; then
        fail "topomap $*: exit code $found, expected $code"
        cat out err
    elif grep -q Traceback out err; then
        fail "topomap $*: a traceback"
        cat err
    fi
    return 0
}

wrote() { # wrote FILE...: each is there and not empty
    local file
    for file in "$@"; do [ -s "$file" ] || fail "$file was not written"; done
}

field() { # field NAME VALUE: the JSON object on standard output says so
    "$bin/python" - "$1" "$2" out <<'PYTHON' || fail "--json: $1 is not $2"
import json, pathlib, sys
name, value, path = sys.argv[1:]
sys.exit(json.loads(pathlib.Path(path).read_text())[name] != json.loads(value))
PYTHON
}

one_line() { # one_line WORD: standard error is one line and has WORD in it
    [ "$(grep -c . err)" -eq 1 ] && grep -qF -- "$1" err ||
        { fail "expected one line with '$1' on standard error; got:"; cat err; }
}

expect 0 --version
expect 0 --help

expect 0 world list
expect 0 world make l --seed 1 -o l.json
expect 0 world make random --corners 12 --seed 3 -o hall.json
expect 0 world show hall.json -o hall.svg
wrote l.json hall.json hall.svg

# The same seed makes the same file.
expect 0 world make random --corners 12 --seed 3 -o again.json
cmp -s hall.json again.json || fail "world make: two files of one seed differ"

for body in ideal physical; do
    expect 0 build l.json -o "$body.json" --body "$body" --sigma 0.05 --seed 2 \
        --plot "$body.svg" --json
    field closed true
    field correct true
    field collisions 0
    wrote "$body.json" "$body.svg"
    expect 0 compare "$body.json" --world l.json --json
    field correct true
    field missing_vertices 0
done
expect 0 compare ideal.json physical.json --json
field correct true
expect 0 show ideal.json -o map.png
expect 0 show ideal.json -o map.html
expect 0 build l.json -o paged.json --sigma 0.05 --seed 2 --page run.html
cmp -s paged.json ideal.json || fail "build --page: another map than without"
wrote map.png map.html run.html

# Other formats, there and back.
for name in map.graphml map.node-link.json map.tmap2.yaml map.g2o; do
    expect 0 convert ideal.json "$name"
    expect 0 convert "$name" back.json
    wrote "$name" back.json
done
for name in map.yaml map.geojson map.tum; do
    expect 0 convert ideal.json "$name"
    wrote "$name"
done
wrote map.pgm
expect 0 convert l.json l.yaml
expect 0 convert l.yaml back.json --json
field target_format '"world"'

expect 0 doctor --json
expect 0 --show-completion bash

# Islands and routes.
expect 0 world make random --corners 8 --islands 1 --seed 5 -o island.json
expect 0 build island.json -o better.json --improve active --sigma 0.02 --json
field correct true
field islands 1
expect 0 compare better.json --world island.json --json
field correct true
for body in ideal physical; do
    expect 0 route better.json 0 9 --world island.json --body "$body" --json
    field arrived true
done
expect 2 route better.json 0 999
one_line target
expect 3 route better.json 0 1 --world l.json
one_line "not that of the world"

# Bad input: exit code 2, one line that names the file and what is wrong.
expect 2 build nowhere.json -o map.json
one_line nowhere.json
head -c 40 l.json >cut.json
expect 2 build cut.json -o map.json
one_line cut.json
expect 2 build l.json -o map.json --sigma 7
one_line sigma
expect 2 show l.json -o map.png
one_line l.json
[ -e map.json ] && fail "a failed build left a file behind"

[ "$failures" -eq 0 ] && echo "the command line does what it says"
exit $((failures > 0))
