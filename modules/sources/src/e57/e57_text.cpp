// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_scan_encoder.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/io/text.h>

namespace pcl6d::sources {

namespace {

/** \return the number of bytes of the UTF-8 character at the start; 0: the bytes are no UTF-8 */
std::size_t
lengthOfCharacter(std::string_view text)
{
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  if (byte(0) < 0x80)
    return 1;
  const std::size_t length = byte(0) >= 0xF0   ? 4
                             : byte(0) >= 0xE0 ? 3
                             : byte(0) >= 0xC2 ? 2
                                               : 0;
  // The second byte rules out overlong forms, surrogates and values beyond Unicode (RFC 3629).
  if (byte(0) > 0xF4 || (byte(0) == 0xE0 && byte(1) < 0xA0) ||
      (byte(0) == 0xED && byte(1) > 0x9F) || (byte(0) == 0xF0 && byte(1) < 0x90) ||
      (byte(0) == 0xF4 && byte(1) > 0x8F))
    return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80)
      return 0;
  return length;
}

/** \return the text escaped for XML: special characters become entities, control characters
 * become blanks, and invalid UTF-8 becomes "?" */
std::string
escaped(std::string_view plain)
{
  std::string text;
  for (std::size_t size = 0; !plain.empty(); plain.remove_prefix(size)) {
    size = lengthOfCharacter(plain);
    const char c = plain.front();
    if (size == 0) {
      text += '?';
      size = 1;
    }
    else if (c == '&')
      text += "&amp;";
    else if (c == '<')
      text += "&lt;";
    else if (c == '>')
      text += "&gt;";
    else if (size == 1 && (static_cast<unsigned char>(c) < 0x20 || c == 0x7F))
      text += ' ';
    else
      text += plain.substr(0, size);
  }
  return text;
}

std::string
element(const std::string& name, const std::string& type, const std::string& content)
{
  return "<" + name + " type=\"" + type + "\">" + content + "</" + name + ">\n";
}

std::string
realElement(const std::string& name, double value)
{
  return element(name, "Float", text::shortest(value));
}

std::string
integerElement(const std::string& name, std::int64_t value)
{
  return element(name, "Integer", std::to_string(value));
}

std::string
structure(const std::string& name, const std::string& content)
{
  return element(name, "Structure", "\n" + content);
}

std::string
prototypeOf(const E57Field& field)
{
  std::string text = "<" + field.name + " type=\"";
  if (field.kind == E57Kind::kSingle)
    text += "Float\" precision=\"single";
  else if (field.kind == E57Kind::kDouble)
    text += "Float";
  else
    text += std::string(field.kind == E57Kind::kScaled ? "ScaledInteger" : "Integer") +
            "\" minimum=\"" + std::to_string(field.minimum) + "\" maximum=\"" +
            std::to_string(field.maximum);
  if (field.kind == E57Kind::kScaled)
    text += "\" scale=\"" + text::shortest(field.scale) + "\" offset=\"" +
            text::shortest(field.offset);
  // The standard asks for a value within the limits; an empty element stands for 0.
  return text + "\">" + std::to_string(field.minimum) + "</" + field.name + ">\n";
}

std::string
boundsOf(const WrittenScan& scan)
{
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, static_cast<char>('x' + axis));
    text += realElement(name + "Minimum", scan.least[axis]) +
            realElement(name + "Maximum", scan.most[axis]);
  }
  return structure("cartesianBounds", text);
}

std::string
gridOf(const WrittenScan& scan)
{
  std::string text;
  if (scan.rows)
    text += integerElement("rowMinimum", scan.rows->first) +
            integerElement("rowMaximum", scan.rows->second);
  if (scan.columns)
    text += integerElement("columnMinimum", scan.columns->first) +
            integerElement("columnMaximum", scan.columns->second);
  return text.empty() ? text : structure("indexBounds", text);
}

std::string
coloursOf(const WrittenScan& scan)
{
  std::string text;
  for (const auto& field : scan.fields)
    if (field.name.rfind("color", 0) == 0)
      text += integerElement(field.name + "Minimum", field.minimum) +
              integerElement(field.name + "Maximum", field.maximum);
  return text.empty() ? text : structure("colorLimits", text);
}

std::string
pointsOf(const WrittenScan& scan)
{
  std::string fields;
  for (const auto& field : scan.fields)
    fields += prototypeOf(field);
  return "<points type=\"CompressedVector\" fileOffset=\"" +
         std::to_string(scan.offset) + "\" recordCount=\"" +
         std::to_string(scan.count) + "\">\n" + structure("prototype", fields) +
         "<codecs type=\"Vector\" "
         "allowHeterogeneousChildren=\"1\"></codecs>\n</points>\n";
}

std::string
scanText(const WrittenScan& scan)
{
  std::string text = element("guid", "String", scan.guid);
  text += element("name", "String", escaped(scan.name));
  if (scan.pose)
    text += e57PoseText(*scan.pose) + "\n";
  if (scan.stamp)
    text += structure("acquisitionStart",
                      realElement("dateTimeValue", *scan.stamp) +
                          integerElement("isAtomicClockReferenced", 0));
  text += boundsOf(scan) + gridOf(scan);
  if (scan.intensity)
    text += structure("intensityLimits",
                      realElement("intensityMinimum", scan.intensity->first) +
                          realElement("intensityMaximum", scan.intensity->second));
  return structure("vectorChild", text + coloursOf(scan) + pointsOf(scan));
}

bool
hasNormals(const std::vector<WrittenScan>& scans)
{
  for (const auto& scan : scans)
    for (const auto& field : scan.fields)
      if (field.name.rfind("nor:", 0) == 0)
        return true;
  return false;
}

} // namespace

std::string
e57PoseText(const Eigen::Isometry3d& pose)
{
  const Eigen::Quaterniond q = canonical(Eigen::Quaterniond(pose.linear()));
  const Eigen::Vector3d t = pose.translation();
  const auto three = [](const Eigen::Vector3d& v) {
    return realElement("x", v.x()) + realElement("y", v.y()) + realElement("z", v.z());
  };
  const std::string text =
      structure("pose",
                structure("rotation", realElement("w", q.w()) + three(q.vec())) +
                    structure("translation", three(t)));
  return text.substr(0, text.size() - 1); // without the end of the line
}

std::string
e57Text(const std::vector<WrittenScan>& scans, const std::string& coordinate_system)
{
  std::string all, guids;
  for (const auto& scan : scans) {
    all += scanText(scan);
    guids += scan.guid;
  }
  const std::string guid =
      scans.empty() ? "{0}" : "{file of " + scans.front().guid + "}";
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
         "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\"" +
         std::string(
             hasNormals(scans)
                 ? " xmlns:nor=\"http://www.libe57.org/E57_NOR_surface_normals.txt\""
                 : "") +
         ">\n" + element("formatName", "String", "ASTM E57 3D Imaging Data File") +
         element("guid", "String", guid) + integerElement("versionMajor", 1) +
         integerElement("versionMinor", 0) +
         element("e57LibraryVersion", "String", "PCL6D") +
         (coordinate_system.empty()
              ? std::string()
              : element("coordinateMetadata", "String", escaped(coordinate_system))) +
         "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n" + all +
         "</data3D>\n<images2D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n"
         "</images2D>\n</e57Root>\n";
}

} // namespace pcl6d::sources
