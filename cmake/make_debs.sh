#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the Debian packages of a finished build tree: BUILD_DIR/deb/*.deb. Nothing is compiled.
# usage: cmake/make_debs.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
source=$(realpath "$1") build=$(realpath "$2")
folder=$build/deb
rm -rf "$folder"
mkdir -p "$folder/work/share"
cd "$folder/work"
cp -a "$source"/share/packaging/debian .
cp -a "$source"/{CHANGELOG.md,LICENSE} .
cp -a "$source"/share/{doc,examples} share/
umask 022
PCL6D_BUILD_TREE=$build DEB_BUILD_OPTIONS=${DEB_BUILD_OPTIONS:-} dpkg-architecture -c debian/rules binary >"$folder/log.txt" 2>&1 ||
  { tail -n 20 "$folder/log.txt" >&2; exit 1; }
cd ..
rm -rf work
sha256sum -- *.deb
