# SPDX-License-Identifier: BSD-3-Clause
# The examples that make their own data; they exit with 1 if their result is wrong.
include(${SETTINGS})
run(COMMAND ${work}/examples_build/drop_in_icp
  PRINTS "pcl6d::ICP6D ok 0.1375 m 0.0549 rad" "all three found the true motion")
run(COMMAND ${work}/examples_build/search_drop_in PRINTS "5000 normals")

run(COMMAND ${work}/examples_build/planes_drop_in PRINTS "points +ok" "plane +ok" "planes +ok")
run(COMMAND ${work}/examples_build/minimisers_drop_in PRINTS "all minimisers found the motion")
run(COMMAND ${work}/examples_build/make_parts_by_name PRINTS "helix, cached-tree, mean: .*the motion is found")
run(COMMAND ${work}/examples_build/make_parts_by_name svd annoy mean EXIT 1
  PRINTS "kdtree.cached-tree.remembered.approximate.octree.brute-force.flann")
run(COMMAND ${work}/examples_build/search_classes PRINTS "all of them agree")
run(COMMAND ${work}/examples_build/filters_drop_in PRINTS "the mixed pixel at .* went to")
run(COMMAND ${work}/examples_build/sampling_drop_in PRINTS "PCL: .* points of leaves" "ours: .* depth 2.0 m")
run(COMMAND ${work}/examples_build/cells_drop_in PRINTS "m with pcl6d::NDT6D")
run(COMMAND ${work}/examples_build/pipeline_drop_in
  PRINTS "by hand" "in PCL.s ICP" "joint" "without guess")
run(COMMAND ${work}/examples_build/coarse_start PRINTS "features: ok" "overlap: ok" "ICP: ok")
run(COMMAND ${work}/examples_build/place_drop_in PRINTS "place: unique" "of these compatible" "the place is found")
run(COMMAND ${work}/examples_build/verify_drop_in PRINTS "near +PCL: converged.*PCL6D: good" "told from the right one")
run(COMMAND ${work}/examples_build/moving_drop_in PRINTS "the walker is gone, the room stands")
run(COMMAND ${work}/examples_build/slam_in_memory PRINTS "7 of 7 scans matched")
run(COMMAND ${work}/examples_build/slam_stage PRINTS "back at start: [1-9].* links" "used by the relaxation")
run(COMMAND ${work}/examples_build/loop_closing_drop_in PRINTS "with pcl6d::ELCH .ok.")
run(COMMAND ${work}/examples_build/relaxation_drop_in PRINTS "pcl6d::LUM ok")
run(COMMAND ${work}/examples_build/object_localization_drop_in PRINTS "the block is found")
run(COMMAND ${work}/examples_build/plane_segmentation_drop_in PRINTS "three faces of the room")
