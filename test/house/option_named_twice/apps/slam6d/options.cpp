// SPDX-License-Identifier: BSD-3-Clause
// Names --knots twice, --voxel once, and --output only in a text.
const char* const kKnots = "knots SECONDS";
const char* const kAgain = "knots";
const char* const kVoxel = "voxel";
const char* const kText = "give --output OUT_DIR"; // "output" in a comment is none
