// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/nesting.h>
#include <pcl6d/io/text.h>
#include <pcl6d/object_localization/cascade_file.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <locale>
#include <sstream>

namespace pcl6d {

namespace {
namespace pt = boost::property_tree;
using Numbers = std::vector<double>;

[[noreturn]] void
fail(const std::string& rule)
{
  throw BadArgument(rule);
}

const pt::ptree&
child(const pt::ptree& node, const char* name)
{
  const auto found = node.get_child_optional(name);
  if (!found)
    fail(std::string("no element <") + name + ">");
  return *found;
}

Numbers
numbersOf(const pt::ptree& node, const char* name)
{
  std::istringstream text(node.data());
  text.imbue(std::locale::classic());
  Numbers numbers;
  for (double number = 0; text >> number;)
    numbers.push_back(number);
  if (!text.eof())
    fail(std::string("<") + name + "> holds text that is no number");
  return numbers;
}

double
numberOf(const pt::ptree& parent, const char* name)
{
  const Numbers numbers = numbersOf(child(parent, name), name);
  if (numbers.size() != 1)
    fail(std::string("<") + name + "> must hold one number");
  return numbers.front();
}

int
wholeOf(double number)
{
  constexpr double kLargest = 1e9;
  if (!(number >= -kLargest && number <= kLargest) ||
      number != static_cast<int>(number))
    fail("an index or a size is no whole number");
  return static_cast<int>(number);
}

HaarTree
treeOf(const pt::ptree& xml)
{
  constexpr std::size_t kPerNode = 4; // left, right, feature, threshold
  const Numbers numbers = numbersOf(child(xml, "internalNodes"), "internalNodes");
  if (numbers.size() % kPerNode != 0)
    fail("<internalNodes> must hold 4 numbers per node");
  HaarTree tree;
  for (std::size_t i = 0; i < numbers.size(); i += kPerNode)
    tree.nodes.push_back({wholeOf(numbers[i]),
                          wholeOf(numbers[i + 1]),
                          wholeOf(numbers[i + 2]),
                          static_cast<float>(numbers[i + 3])});
  for (const double leaf : numbersOf(child(xml, "leafValues"), "leafValues"))
    tree.leaves.push_back(static_cast<float>(leaf));
  return tree;
}

HaarFeature
featureOf(const pt::ptree& xml)
{
  HaarFeature feature;
  feature.tilted = xml.get_child_optional("tilted") && numberOf(xml, "tilted") != 0;
  std::size_t count = 0;
  for (const auto& [name, rect] : child(xml, "rects")) {
    if (name != "_")
      continue; // a comment
    const Numbers n = numbersOf(rect, "rects");
    if (n.size() != 5 || count == feature.rects.size())
      fail("a feature must have 2 or 3 rectangles of 5 numbers");
    feature.rects[count++] = {
        {wholeOf(n[0]), wholeOf(n[1]), wholeOf(n[2]), wholeOf(n[3])},
        static_cast<float>(n[4])};
  }
  return feature;
}

CascadeSubject
subjectOf(const pt::ptree& xml)
{
  CascadeSubject subject;
  const auto channel = xml.get<std::string>("channel", "");
  if (channel != "range" && channel != "reflectance")
    fail("<channel> must be range or reflectance");
  subject.channel =
      channel == "range" ? ImageChannel::kRange : ImageChannel::kReflectance;
  subject.object_size = numberOf(xml, "objectSize");
  subject.pixel = numberOf(xml, "pixel");
  subject.slice_depth = numberOf(xml, "sliceDepth");
  return subject;
}

HaarCascade
cascadeOf(const pt::ptree& file)
{
  const pt::ptree& xml = child(file, "opencv_storage.cascade");
  if (xml.get<std::string>("stageType", "") != "BOOST" ||
      xml.get<std::string>("featureType", "") != "HAAR")
    fail("no boosted cascade of Haar features (stageType BOOST, featureType HAAR)");
  HaarCascade cascade;
  cascade.width = wholeOf(numberOf(xml, "width"));
  cascade.height = wholeOf(numberOf(xml, "height"));
  for (const auto& [name, stage_xml] : child(xml, "stages")) {
    if (name != "_")
      continue;
    HaarStage stage;
    stage.threshold = static_cast<float>(numberOf(stage_xml, "stageThreshold"));
    for (const auto& [tree_name, tree] : child(stage_xml, "weakClassifiers"))
      if (tree_name == "_")
        stage.trees.push_back(treeOf(tree));
    cascade.stages.push_back(std::move(stage));
  }
  for (const auto& [name, feature] : child(xml, "features"))
    if (name == "_")
      cascade.features.push_back(featureOf(feature));
  if (const auto subject = xml.get_child_optional("pcl6d"))
    cascade.subject = subjectOf(*subject);
  cascade.validate();
  return cascade;
}
} // namespace

HaarCascade
readCascade(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  checkXmlNesting(content, path.string());
  try {
    std::istringstream stream(content);
    pt::ptree file;
    pt::read_xml(stream, file, pt::xml_parser::trim_whitespace);
    return cascadeOf(file);
  } catch (const pt::xml_parser_error& e) {
    throw IoFailed(path.string() + ": line " + std::to_string(e.line()) +
                   ": no XML: " + e.message());
  } catch (const BadArgument& e) {
    throw IoFailed(path.string() + ": " + e.what());
  }
}

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
