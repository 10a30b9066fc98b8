#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Trains the cascades of share/models again: meant to give the same bytes with any
# number of threads. Usage: train.sh [PROGRAMS [CLASS...]], where PROGRAMS is the folder
# of pcl_slam6d_simulate and pcl_slam6d_objects, else build/release/bin. What is done is
# kept in build/cascades: stopped, it goes on there.
set -eu
models=$(cd "$(dirname "$0")" && pwd)
programs=${1:-$models/../../build/release/bin}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- bin box chair person table
work=$models/../../build/cascades
mkdir -p "$work"

for class in "$@"; do
  # Flats that no table of share/doc is measured on, without the class itself.
  backgrounds=
  for seed in 101 102 103 104 105; do
    folder=$work/$class-$seed
    [ -f "$folder/scene.json" ] || "$programs/pcl_slam6d_simulate" rooms --seed $seed \
      --scans 12 --quiet --scanner rotating --without "$class" --labels no -o "$folder"
    backgrounds="$backgrounds --background $folder"
  done
  for channel in range reflectance; do
    # Exit code 3: the last stage is weaker than wanted, which is no harm.
    # shellcheck disable=SC2086 # the list is meant to be split
    "$programs/pcl_slam6d_objects" train "$models/$class" $backgrounds --quiet \
      --channel $channel --stages 10 --positives 700 --negatives 2000 \
      --min-visible 0.5 --min-hit-rate 0.997 --features-per-stage 6000 \
      --state "$work/$class-$channel" -o "$models/$class/$channel.xml" || [ $? -eq 3 ]
  done
done
