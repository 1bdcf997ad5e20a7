#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# include_table_test.sh [ROOT]: the headers of each folder include only what the table below allows, so that the lower
# layers stay usable without the upper ones. Headers directly in include/locus/ may include anything; nothing includes
# them but each other.
set -euo pipefail
shopt -s extglob

# What the files of a folder may include: folders, or single headers.
allowed()
{
  case $1 in
    number) echo number ;;
    function) echo number function ;;
    shape) echo number function shape ;;
    zero_set) echo number function zero_set ;;
    constraint) echo number function shape constraint zero_set/system.h ;;
    construct) echo number function shape zero_set constraint construct ;;
    io) echo number function shape zero_set constraint construct io ;;
    check) echo check number/rational.h ;; # apart from the rest: a second copy of logic is wanted there
    adaptor) echo number function shape zero_set constraint construct adaptor ;;
    instances) echo everything ;; # the sources of the static library
    *) return 1 ;;
  esac
}

# violations ROOT: prints "file:line: …" for each include that the table forbids. Status 2 if there is no file.
violations()
{
  local base=$1/include/locus file line text from target allowance ok
  [[ -n $(find "$base" -name '*.h' -o -name '*.cpp' 2>/dev/null) ]] || { echo "no header in $base"; return 2; }
  while IFS=: read -r file line text; do
    file=${file#"$base/"}
    [[ $file == */* ]] || continue
    from=${file%%/*}
    text=${text##*([[:space:]])#*([[:space:]])include*([[:space:]])}
    target=${text:1}
    target=${target%%[\">]*}
    if [[ $text == \"* && $target != locus/* ]]; then # relative to the file that includes it
      target=$(realpath -m --relative-to="$base/.." "$base/$(dirname "$file")/$target")
    fi
    [[ $target == locus/* ]] || continue
    target=${target#locus/}
    if ! allowance=$(allowed "$from"); then
      echo "$file:$line: the folder $from is not in the table"
      continue
    fi
    ok=
    for entry in $allowance; do
      [[ $entry == everything || $target == "$entry" || $target == "$entry"/* ]] && ok=1
    done
    [[ $ok ]] || echo "$file:$line: $from/ may not include $target (allowed: $allowance)"
  done < <(grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]' --include='*.h' --include='*.cpp' "$base")
}

# planted FILE INCLUDE: what `violations` says of a tree with this one line.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
planted()
{
  rm -rf "$scratch/include"
  mkdir -p "$scratch/include/locus/$(dirname "$1")"
  printf '#pragma once\n%s\n' "$2" >"$scratch/include/locus/$1"
  violations "$scratch"
}

# First that the test itself sees what it should.
status=0
while IFS='|' read -r verdict file include; do
  found=$(planted "$file" "$include")
  if [[ $verdict == bad && -z $found || $verdict == good && -n $found ]]; then
    echo "self-check: '$include' in $file should be $verdict; found: ${found:-nothing}"
    status=1
  fi
done <<'END'
bad|number/a.h|#include <locus/function/bernstein.h>
bad|function/a.h|#include <locus/shape/frame.h>
bad|shape/a.h|#include <locus/zero_set/system.h>
bad|zero_set/a.h|#include <locus/shape/frame.h>
bad|zero_set/a.h|#  include   "../shape/frame.h"
bad|zero_set/deep/a.h|#include "../../constraint/b.h"
bad|constraint/a.h|#include <locus/zero_set/curve_solver.h>
bad|constraint/a.h|#include "locus/zero_set/claim.h"
bad|construct/a.h|#include <locus/io/svg.h>
bad|io/a.h|#include <locus/adaptor/arrangement_2.h>
bad|io/a.h|#include <locus/bisector_2.h>
bad|check/a.h|#include <locus/number/interval.h>
bad|check/a.h|#include <locus/function/bernstein.h>
bad|adaptor/a.h|#include <locus/io/svg.h>
bad|unheard_of/a.h|#include <locus/number/sign.h>
good|number/a.h|#include <locus/number/sign.h>
good|number/a.h|#include <vector>
good|number/a.h|#include <CGAL/Interval_nt.h>
good|number/a.h|// #include <locus/io/svg.h>
good|constraint/a.h|#include <locus/zero_set/system.h>
good|check/a.h|#include <locus/number/rational.h>
good|check/a.h|#include "arithmetic.h"
good|adaptor/a.h|#include <locus/construct/bisector_2.h>
good|bisector_2.h|#include <locus/adaptor/arrangement_2.h>
good|instances/a.cpp|#include <locus/bisector_2.h>
END
rm -rf "$scratch/include"
violations "$scratch" >/dev/null && { echo "self-check: an empty tree passed"; status=1; }

root=${1:-$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)}
found=$(violations "$root") || status=1
if [[ -n $found ]]; then
  printf '%s\n' "$found"
  status=1
fi
exit "$status"
