#!/usr/bin/env bash
# A wheel in a bare environment: it has all that the core needs, and works.
# Usage: tests/installed.sh WHEEL [PYTHON]
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
wheel=$(realpath "$1") || exit 1
python=${2:-python3}

folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
unset PYTHONPATH

"$python" -m venv bare || exit 1
bare/bin/pip install --quiet --disable-pip-version-check "$wheel" || exit 1
bare/bin/python - <<'PYTHON' || exit 1
import behaviours, evidence, merge, topomap, worlds
for room in behaviours, evidence, merge, topomap, worlds:
    assert "site-packages" in room.__file__, room.__file__
PYTHON
bare/bin/topomap doctor >doctor || { cat doctor; exit 1; }
grep -q '^core: works$' doctor || { echo "FAILED: the core"; cat doctor; exit 1; }
bash "$here/smoke.sh" bare/bin
