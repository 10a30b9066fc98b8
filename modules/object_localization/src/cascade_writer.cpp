// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/object_localization/cascade_file.h>

#include <algorithm>
#include <locale>
#include <sstream>

namespace pcl6d {
namespace {
std::size_t
mostTrees(const HaarCascade& cascade)
{
  std::size_t most = 0;
  for (const auto& stage : cascade.stages)
    most = std::max(most, stage.trees.size());
  return most;
}

void
writeTree(std::ostream& out, const HaarTree& tree)
{
  out << "        <_>\n          <internalNodes>";
  for (const auto& node : tree.nodes)
    out << "\n            " << node.left << ' ' << node.right << ' ' << node.feature
        << ' ' << node.threshold;
  out << "</internalNodes>\n          <leafValues>\n           ";
  for (const float leaf : tree.leaves)
    out << ' ' << leaf;
  out << "</leafValues></_>\n";
}

void
writeStage(std::ostream& out, const HaarStage& stage)
{
  out << "    <_>\n      <maxWeakCount>" << stage.trees.size()
      << "</maxWeakCount>\n      <stageThreshold>" << stage.threshold
      << "</stageThreshold>\n      <weakClassifiers>\n";
  for (const auto& tree : stage.trees)
    writeTree(out, tree);
  out << "      </weakClassifiers></_>\n";
}

void
writeFeature(std::ostream& out, const HaarFeature& feature)
{
  out << "    <_>\n      <rects>\n";
  for (const auto& [rect, weight] : feature.rects)
    if (weight != 0)
      out << "        <_>\n          " << rect.x << ' ' << rect.y << ' ' << rect.width
          << ' ' << rect.height << ' ' << weight << "</_>\n";
  out << "      </rects>\n      <tilted>" << (feature.tilted ? 1 : 0)
      << "</tilted></_>\n";
}

void
writeAll(std::ostream& out, const HaarCascade& cascade)
{
  out << "<?xml version=\"1.0\"?>\n<opencv_storage>\n"
      << "<cascade type_id=\"opencv-cascade-classifier\">\n"
      << "  <stageType>BOOST</stageType>\n  <featureType>HAAR</featureType>\n  <height>"
      << cascade.height << "</height>\n  <width>" << cascade.width << "</width>\n"
      << "  <stageParams>\n    <maxWeakCount>" << mostTrees(cascade)
      << "</maxWeakCount></stageParams>\n"
      << "  <featureParams>\n    <maxCatCount>0</maxCatCount></featureParams>\n";
  if (cascade.subject)
    out << "  <pcl6d>\n    <channel>"
        << (cascade.subject->channel == ImageChannel::kRange ? "range" : "reflectance")
        << "</channel>\n    <objectSize>" << cascade.subject->object_size
        << "</objectSize>\n    <pixel>" << cascade.subject->pixel
        << "</pixel>\n    <sliceDepth>" << cascade.subject->slice_depth
        << "</sliceDepth></pcl6d>\n";
  out << "  <stageNum>" << cascade.stages.size() << "</stageNum>\n  <stages>\n";
  for (const auto& stage : cascade.stages)
    writeStage(out, stage);
  out << "  </stages>\n  <features>\n";
  for (const auto& feature : cascade.features)
    writeFeature(out, feature);
  out << "  </features></cascade>\n</opencv_storage>\n";
}
} // namespace

void
writeCascade(const std::filesystem::path& path, const HaarCascade& cascade)
{
  cascade.validate();
  writeFileAtomically(path, [&](std::ostream& file) {
    std::ostringstream text; // whatever the locale
    text.imbue(std::locale::classic());
    text.precision(9); // a float to the last bit
    writeAll(text, cascade);
    file << text.str();
  });
}

} // namespace pcl6d
