// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/suite_file.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/io/json_object.h>
#include <pcl6d/io/object_io.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/scene_interpretation/label_rules.h>
#include <pcl6d/semantic_map/semantic_map_io.h>
#include <pcl6d/simulation/scene_file.h>

namespace pcl6d::fuzz {

int
json(const std::uint8_t* data, std::size_t size)
{
  return readAsText(data, size, [](const std::string& text) {
    const std::string once = parseJson(text, "text").dump();
    expect(parseJson(once, "copy").dump() == once, "what was read reads back");
  });
}

int
scene(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".json", data, size, [](const auto& file) {
    const SimulationScene read = readScene(file);
    for (const auto& point : read.waypoints)
      expect(point.allFinite(), "waypoints are finite");
  });
}

int
planes(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".json", data, size, [](const auto& file) {
    for (const Plane& plane : readPlanes(file)) {
      expect(plane.normal.allFinite(), "normals are finite");
      for (const auto& corner : plane.hull)
        expect(corner.allFinite(), "corners are finite");
    }
  });
}

int
objects(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".json", data, size, [](const auto& file) {
    for (const ObjectPose& object : readObjects(file))
      expect(object.T_world_object.matrix().allFinite(), "poses are finite");
  });
}

int
map_objects(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(
      ".json", data, size, [](const auto& file) { readMapObjects(file); });
}

int
semantic_map(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(
      ".json", data, size, [](const auto& file) { readSemanticMap(file); });
}

int
label_rules(const std::uint8_t* data, std::size_t size)
{
  return readAsText(data, size, [](const std::string& text) {
    const LabelRules rules = parseLabelRules(text, "text");
    for (const auto& rule : rules.labels)
      expect(labelNumber(rules, rule.name) < 5 + rules.labels.size(),
             "labels have numbers");
  });
}

int
suite(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(
      ".json", data, size, [](const auto& file) { app::readSuite(file); });
}

} // namespace pcl6d::fuzz
