// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/ply/ply_body.h"
#include "scan/scan_formats.h"
#include "scan/usual_names.h"

#include <pcl6d/io/scan_fields.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

/** PCL's names of usual properties of vertices. */
const std::map<std::string, std::string> kNames = {{"nx", "normal_x"},
                                                   {"ny", "normal_y"},
                                                   {"nz", "normal_z"}};

/** Bytes of a packed colour by the name of their property. */
const std::map<std::string, std::size_t> kColours = {{"blue", 0},
                                                     {"diffuse_blue", 0},
                                                     {"green", 1},
                                                     {"diffuse_green", 1},
                                                     {"red", 2},
                                                     {"diffuse_red", 2},
                                                     {"alpha", 3}};

/** \brief Where the properties of a vertex stand in a point. */
struct Layout {
  pcl::PCLPointCloud2 cloud;        ///< fields and point_step
  std::vector<std::size_t> offsets; ///< of each property; not used for lists
};

void
addField(const std::string& name, std::uint8_t datatype, pcl::PCLPointCloud2& cloud)
{
  PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = datatype;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += static_cast<pcl::uindex_t>(sizeOfType(datatype));
}

bool
isColour(const PlyProperty& property)
{
  return !property.is_list && property.datatype == PCLPointField::UINT8 &&
         kColours.count(property.name) > 0;
}

/** Follows PCL: colours are packed into a field, lists are left out. */
Layout
layoutOf(const PlyElement& vertex)
{
  const bool has_alpha = std::any_of(
      vertex.properties.begin(), vertex.properties.end(), [](const auto& property) {
        return isColour(property) && property.name == "alpha";
      });
  Layout layout;
  std::optional<std::size_t> colour; // where it stands
  for (const auto& property : vertex.properties) {
    if (isColour(property)) {
      if (!colour) {
        colour = layout.cloud.point_step;
        addField(has_alpha ? "rgba" : "rgb",
                 has_alpha ? PCLPointField::UINT32 : PCLPointField::FLOAT32,
                 layout.cloud);
      }
      layout.offsets.push_back(*colour + kColours.at(property.name));
      continue;
    }
    layout.offsets.push_back(layout.cloud.point_step);
    const auto renamed = kNames.find(property.name);
    if (!property.is_list)
      addField(renamed == kNames.end() ? property.name : renamed->second,
               property.datatype,
               layout.cloud);
  }
  return layout;
}

pcl::PCLPointCloud2
readVertices(FileInput& input, PlyBody& body, const PlyElement& vertex)
{
  Layout layout = layoutOf(vertex);
  pcl::PCLPointCloud2& cloud = layout.cloud;
  if (cloud.point_step == 0)
    text::fail(input.path(), "vertices without properties");
  body.start(vertex, layout.offsets);
  // A number takes at least one byte in the file, and at most eight in memory.
  cloud.data.reserve(
      std::min(vertex.count * cloud.point_step, 8 * input.sizeAhead().value_or(0)));
  for (std::size_t i = 0; i < vertex.count; ++i) {
    cloud.data.resize(cloud.data.size() + cloud.point_step);
    body.next(&cloud.data[i * cloud.point_step]);
  }
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(vertex.count);
  cloud.row_step = cloud.width * cloud.point_step;
  return std::move(cloud);
}

/** \return the elements and properties that do not fit into a point field */
std::vector<std::string>
leftOut(const PlyHeader& header)
{
  std::vector<std::string> things;
  for (const auto& element : header.elements)
    if (element.name != "vertex")
      things.push_back(text::counted(element.count, "element") + ' ' +
                       text::quoted(element.name));
    else
      for (const auto& property : element.properties)
        if (property.is_list)
          things.push_back("list " + text::quoted(property.name));
  return things;
}

/** Changes x, y and z from float in the header to double. */
void
widenCoordinates(PlyHeader& header)
{
  for (auto& element : header.elements)
    for (auto& property : element.properties)
      if (element.name == "vertex" && !property.is_list &&
          property.datatype == PCLPointField::FLOAT32 &&
          (property.name == "x" || property.name == "y" || property.name == "z"))
        property.datatype = PCLPointField::FLOAT64;
}

/** Converts integer coordinates to double. */
void
takeWholeCoordinates(pcl::PCLPointCloud2& cloud)
{
  for (const char* const axis : {"x", "y", "z"}) {
    const auto field = std::find_if(cloud.fields.begin(),
                                    cloud.fields.end(),
                                    [&](const auto& f) { return f.name == axis; });
    if (field == cloud.fields.end() || field->datatype == PCLPointField::FLOAT32 ||
        field->datatype == PCLPointField::FLOAT64)
      continue;
    const auto values = fieldValues(cloud, axis);
    cloud.fields.erase(field);
    pcl6d::addField(cloud, axis, PCLPointField::FLOAT64, values->values);
  }
}

ScanCloud
readPly(const std::filesystem::path& path, Digits digits)
{
  FileInput input(path);
  PlyHeader header = readPlyHeader(input);
  for (auto& element : header.elements)
    if (element.name == "vertex")
      takeUsualNames(element.properties);
  if (digits == Digits::kDouble)
    widenCoordinates(header);
  const auto vertex =
      std::find_if(header.elements.begin(),
                   header.elements.end(),
                   [](const auto& element) { return element.name == "vertex"; });
  if (vertex == header.elements.end())
    text::fail(path, "PLY file without an element 'vertex'");
  if (vertex->count > std::numeric_limits<pcl::uindex_t>::max())
    text::fail(path,
               std::to_string(vertex->count) +
                   " vertices are more than a cloud can hold");
  const auto body = openPlyBody(input, header);
  ScanCloud scan;
  for (const auto& element : header.elements)
    if (element.name == "vertex")
      scan.cloud = readVertices(input, *body, element);
    else
      body->skipAll(element);
  body->finish();
  takeWholeCoordinates(scan.cloud);
  scan.left_out = leftOut(header);
  return digits == Digits::kFloat && header.encoding == PlyEncoding::kAscii &&
                 needsDouble(path, scan.cloud)
             ? readPly(path, Digits::kDouble)
             : scan;
}

} // namespace

// pcl::PLYReader is not used: it reads 'abc' as nan and, in a locale with decimal commas, every
// malformed number too.
ScanCloud
readPly(const std::filesystem::path& path)
{
  return readPly(path, Digits::kFloat);
}

} // namespace pcl6d::io
