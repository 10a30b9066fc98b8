// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_layout.h"
#include "e57/xml_tree.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace pcl6d::sources {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void
failIn(const fs::path& path, const XmlElement& element, const std::string& message)
{
  text::fail(path,
             "XML section: line " + std::to_string(element.line) + ": <" +
                 text::quoted(element.name) + ">: " + message);
}

std::string_view
trimmed(std::string_view text)
{
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos)
    return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

template <typename T>
T
numberIn(const fs::path& path, const XmlElement& element, std::string_view text)
{
  T value{};
  if (!text::parseNumber(trimmed(text), value))
    failIn(path,
           element,
           text::quoted(text) +
               (std::is_floating_point_v<T> ? " is no number"
                                            : " is no integer within the range"));
  return value;
}

/** \return the number in an element; 0 for an empty element */
double
numberOf(const fs::path& path, const XmlElement& element)
{
  const double value =
      trimmed(element.text).empty() ? 0 : numberIn<double>(path, element, element.text);
  if (!std::isfinite(value))
    failIn(path, element, text::quoted(element.text) + " is not finite");
  return value;
}

double
numberOfChild(const fs::path& path,
              const XmlElement& parent,
              const char* name,
              double otherwise)
{
  const XmlElement* const child = parent.child(name);
  return child ? numberOf(path, *child) : otherwise;
}

template <typename T>
T
attributeOf(const fs::path& path,
            const XmlElement& element,
            const char* name,
            T otherwise)
{
  const std::string* const text = element.attribute(name);
  return text ? numberIn<T>(path, element, *text) : otherwise;
}

E57Field
fieldOf(const fs::path& path, const XmlElement& element)
{
  const std::string* const type = element.attribute("type");
  const std::string* const precision = element.attribute("precision");
  E57Field field;
  field.name = element.name;
  if (!type)
    failIn(path, element, "has no type");
  if (*type == "Float")
    field.kind =
        precision && *precision == "single" ? E57Kind::kSingle : E57Kind::kDouble;
  else if (*type == "String")
    field.kind = E57Kind::kString;
  else if (*type == "Integer" || *type == "ScaledInteger") {
    using Limits = std::numeric_limits<std::int64_t>;
    field.kind = *type == "Integer" ? E57Kind::kInteger : E57Kind::kScaled;
    field.minimum = attributeOf(path, element, "minimum", Limits::min());
    field.maximum = attributeOf(path, element, "maximum", Limits::max());
    field.scale = attributeOf(path, element, "scale", 1.0);
    field.offset = attributeOf(path, element, "offset", 0.0);
  }
  else
    failIn(path, element, "has the unknown type " + text::quoted(*type));
  if (field.minimum > field.maximum)
    failIn(path, element, "the minimum is above the maximum");
  if (!std::isfinite(field.scale) || field.scale == 0 || !std::isfinite(field.offset))
    failIn(path, element, "the scale or offset is no finite number, or the scale is 0");
  return field;
}

/** Adds the fields of a prototype, including nested structures, in order. */
void
addFields(const fs::path& path,
          const XmlElement& structure,
          std::vector<E57Field>& fields)
{
  for (const auto& element : structure.children) {
    const std::string* const type = element.attribute("type");
    if (type && *type == "Structure")
      addFields(path, element, fields);
    else
      fields.push_back(fieldOf(path, element));
  }
}

E57Limits
limitsOf(const fs::path& path,
         const XmlElement& scan,
         const char* element,
         const std::string& name)
{
  const XmlElement* const limits = scan.child(element);
  const XmlElement* const low = limits ? limits->child(name + "Minimum") : nullptr;
  const XmlElement* const high = limits ? limits->child(name + "Maximum") : nullptr;
  if (!low || !high)
    return {};
  return std::pair(numberOf(path, *low), numberOf(path, *high));
}

Eigen::Isometry3d
poseOf(const fs::path& path, const XmlElement& element)
{
  // Writers round to about six digits: tolerance for the length of a quaternion.
  constexpr double kRounded = 1e-2;
  constexpr double kFarthest = 1e9; // [m]; beyond, double lacks micrometres
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  if (const XmlElement* const rotation = element.child("rotation"))
    q = Eigen::Quaterniond(numberOfChild(path, *rotation, "w", 1),
                           numberOfChild(path, *rotation, "x", 0),
                           numberOfChild(path, *rotation, "y", 0),
                           numberOfChild(path, *rotation, "z", 0));
  if (const XmlElement* const translation = element.child("translation"))
    t = Eigen::Vector3d(numberOfChild(path, *translation, "x", 0),
                        numberOfChild(path, *translation, "y", 0),
                        numberOfChild(path, *translation, "z", 0));
  if (!(std::abs(q.norm() - 1) <= kRounded))
    failIn(path,
           element,
           "is no rotation: the quaternion has the length " + text::shortest(q.norm()) +
               ", but must have 1");
  if (!(t.cwiseAbs().maxCoeff() < kFarthest))
    failIn(path, element, "the translation is 1e9 m or farther from the origin");
  return Eigen::Translation3d(t) * q.normalized();
}

void
readPoints(const fs::path& path, const XmlElement& points, E57Scan& scan)
{
  const std::string* const type = points.attribute("type");
  if (!type || *type != "CompressedVector")
    failIn(path, points, "is no CompressedVector");
  scan.offset = attributeOf<std::uint64_t>(path, points, "fileOffset", 0);
  scan.count = attributeOf<std::uint64_t>(path, points, "recordCount", 0);
  if (const XmlElement* const prototype = points.child("prototype"))
    addFields(path, *prototype, scan.fields);
}

/** \return whether the scan groups the points by columns */
bool
groupsByColumns(const XmlElement& scan)
{
  const XmlElement* const schemes = scan.child("pointGroupingSchemes");
  const XmlElement* const lines = schemes ? schemes->child("groupingByLine") : nullptr;
  const XmlElement* const by = lines ? lines->child("idElementName") : nullptr;
  return by && trimmed(by->text) == "columnIndex";
}

E57Scan
scanOf(const fs::path& path, const XmlElement& element)
{
  E57Scan scan;
  if (const XmlElement* const name = element.child("name"))
    scan.name = trimmed(name->text);
  if (const XmlElement* const pose = element.child("pose")) {
    scan.pose = poseOf(path, *pose);
    scan.pose_text = {pose->begin, pose->end};
  }
  if (const XmlElement* const start = element.child("acquisitionStart"))
    if (const XmlElement* const time = start->child("dateTimeValue"))
      scan.start = numberOf(path, *time);
  scan.intensity = limitsOf(path, element, "intensityLimits", "intensity");
  scan.colour = {limitsOf(path, element, "colorLimits", "colorRed"),
                 limitsOf(path, element, "colorLimits", "colorGreen"),
                 limitsOf(path, element, "colorLimits", "colorBlue")};
  scan.lines_are_columns = groupsByColumns(element);
  const XmlElement* const points = element.child("points");
  if (!points)
    failIn(path, element, "is a scan without points");
  readPoints(path, *points, scan);
  if (!scan.pose)
    scan.pose_text = {points->begin, points->begin};
  return scan;
}

/** \return whether an element describes scans, not images or extensions */
bool
tellsOfScans(const std::string& name, const std::vector<XmlElement>& above)
{
  if (above.empty())
    return true;
  if (above.size() == 1)
    return name == "data3D" || name == "coordinateMetadata";
  return name.find(':') == std::string::npos || above.back().name == "prototype";
}

XmlElement
readXmlSection(PageReader& file)
{
  const E57Header& header = file.header();
  const std::uint64_t begin = file.logicalOf(header.xml_offset, "the XML section");
  const std::uint64_t length = header.xml_length;
  if (length > file.size() - begin)
    text::fail(file.path(),
               "the XML section of " + std::to_string(length) +
                   " bytes goes on behind the end of the file");
  std::uint64_t done = 0;
  const auto bytes = [&](char* target, std::size_t size) {
    const auto part =
        static_cast<std::size_t>(std::min<std::uint64_t>(size, length - done));
    file.read(begin + done, reinterpret_cast<std::uint8_t*>(target), part);
    done += part;
    return part;
  };
  return readXml(file.path(), bytes, tellsOfScans);
}

} // namespace

unsigned
E57Field::bits() const
{
  switch (kind) {
  case E57Kind::kSingle:
    return 32;
  case E57Kind::kDouble:
    return 64;
  case E57Kind::kString:
    return 8; // minimum length
  case E57Kind::kInteger:
  case E57Kind::kScaled:
    break;
  }
  unsigned count = 0;
  for (auto range =
           static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(minimum);
       range > 0;
       range >>= 1)
    ++count;
  return count;
}

std::optional<std::size_t>
E57Scan::find(const std::string& field) const
{
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string& name_of = fields[i].name;
    if (name_of == field || name_of.substr(name_of.find(':') + 1) == field)
      return i;
  }
  return {};
}

std::string
E57Scan::title(std::size_t index) const
{
  return "scan " + std::to_string(index) +
         (name.empty() ? "" : " (" + text::quoted(name) + ")");
}

namespace {
XmlElement
rootOf(PageReader& file)
{
  XmlElement root = readXmlSection(file);
  if (root.name != "e57Root")
    text::fail(file.path(),
               "the XML section holds <" + text::quoted(root.name) +
                   ">, but must hold <e57Root>");
  return root;
}
} // namespace

std::string
e57CoordinateSystem(PageReader& file)
{
  const XmlElement root = rootOf(file);
  const XmlElement* const system = root.child("coordinateMetadata");
  return system ? system->text : std::string();
}

std::vector<E57Scan>
readE57Layout(PageReader& file)
{
  const XmlElement root = rootOf(file);
  std::vector<E57Scan> scans;
  if (const XmlElement* const data = root.child("data3D"))
    for (const auto& element : data->children)
      scans.push_back(scanOf(file.path(), element));
  return scans;
}

} // namespace pcl6d::sources
