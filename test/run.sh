#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs what is missing, builds everything in build/ and runs all tests. LOCUS_WERROR=ON makes warnings errors.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$locus_root"

install_missing core test example
cmake --preset release -DLOCUS_BUILD_TESTS=ON -DLOCUS_BUILD_EXAMPLES=ON -DLOCUS_WERROR="${LOCUS_WERROR:-OFF}"
cmake --build build --parallel "$jobs"
ctest --preset release --parallel "$jobs"
