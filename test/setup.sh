# SPDX-License-Identifier: LGPL-3.0-or-later
# Sourced by the scripts: installs what is missing of test/packages.txt, and knows how wide to build (LOCUS_JOBS, or all
# processors).

locus_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=${LOCUS_JOBS:-$(nproc 2>/dev/null || echo 2)}

# install_missing GROUP...: Debian packages of these groups that are not there yet.
install_missing()
{
  local package group rest missing=()
  if ! command -v dpkg-query >/dev/null; then
    echo "not a Debian system: taking the packages of test/packages.txt for installed" >&2
    return 0
  fi
  while read -r package group rest; do
    case $package in '' | '#'*) continue ;; esac
    [[ " $* " == *" $group "* ]] || continue
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
  done <"$locus_root/test/packages.txt"
  ((${#missing[@]})) || return 0

  echo "installing ${missing[*]}" >&2
  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "please install as root: apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}
