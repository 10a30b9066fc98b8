// SPDX-License-Identifier: BSD-3-Clause
// Source: M. Jung et al., "HeLiPR: heterogeneous LiDAR dataset for inter-LiDAR place recognition
// under spatiotemporal variations", IJRR 43(12), 2024, and its published file player.
#include "scan/packed_records.h"
#include "scan/point_field.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <utility>

namespace pcl6d::io {

namespace {
using Field = pcl::PCLPointField;

struct RecordField {
  const char* name;
  std::uint8_t datatype;
};

/** From the first file after this stamp [ns] on, records of the Aeva sensor hold an intensity. */
constexpr std::uint64_t kLastAevaWithoutIntensity = 1691936557946849179;

/** \return the numbers common to all records of a layout, in order */
std::vector<RecordField>
fieldsOfRecord(BinLayout layout)
{
  std::vector<RecordField> fields = {
      {"x", Field::FLOAT32}, {"y", Field::FLOAT32}, {"z", Field::FLOAT32}};
  const auto add = [&](std::initializer_list<RecordField> more) {
    fields.insert(fields.end(), more);
  };
  if (layout == BinLayout::kHeliprAvia)
    add({{"intensity", Field::UINT8},
         {"tag", Field::UINT8},
         {"line", Field::UINT8},
         {"time", Field::UINT32}});
  if (layout == BinLayout::kHeliprAeva)
    add({{"reflectivity", Field::FLOAT32},
         {"velocity", Field::FLOAT32},
         {"time", Field::INT32},
         {"line", Field::UINT8}});
  if (layout == BinLayout::kHeliprOuster)
    add({{"intensity", Field::FLOAT32},
         {"time", Field::UINT32},
         {"reflectivity", Field::UINT16},
         {"ring", Field::UINT16},
         {"ambient", Field::UINT16}});
  if (layout == BinLayout::kHeliprVelodyne)
    add({{"intensity", Field::FLOAT32},
         {"ring", Field::UINT16},
         {"time", Field::FLOAT32}});
  return fields;
}

std::size_t
sizeOfRecord(const std::vector<RecordField>& fields)
{
  std::size_t size = 0;
  for (const RecordField& field : fields)
    size += withTypeOf(field.datatype, [](auto value) { return sizeof value; });
  return std::max(size, sizeof(float)); // sizes of files are divided by the result
}

/** \return whether the records of an Aeva file end with an intensity: by file size, and if both
 * sizes fit, by the stamp in the file name */
bool
hasAevaIntensity(const std::filesystem::path& path,
                 std::size_t size,
                 std::size_t size_without)
{
  const bool fits_without = size % size_without == 0;
  const bool fits_with = size % (size_without + sizeof(float)) == 0;
  std::uint64_t stamp = 0;
  if (fits_with != fits_without || !text::parseNumber(path.stem().string(), stamp))
    return fits_with || !fits_without;
  return stamp > kLastAevaWithoutIntensity;
}
} // namespace

bool
isPackedRecord(BinLayout layout)
{
  return layout == BinLayout::kHeliprAvia || layout == BinLayout::kHeliprAeva ||
         layout == BinLayout::kHeliprOuster || layout == BinLayout::kHeliprVelodyne;
}

ScanCloud
fromPackedRecords(const std::filesystem::path& path,
                  BinLayout layout,
                  std::vector<std::uint8_t> data)
{
  std::vector<RecordField> fields = fieldsOfRecord(layout);
  if (layout == BinLayout::kHeliprAeva &&
      hasAevaIntensity(path, data.size(), sizeOfRecord(fields)))
    fields.push_back({"intensity", Field::FLOAT32});
  const std::size_t size = sizeOfRecord(fields);
  if (data.size() % size != 0)
    text::fail(path,
               "its size of " + text::counted(data.size(), "byte") +
                   " is not a multiple of " + std::to_string(size) + " (--bin-layout " +
                   toString(layout) + ")");
  ScanCloud scan;
  for (const RecordField& of_record : fields) {
    Field field;
    field.name = of_record.name;
    field.offset = scan.cloud.point_step;
    field.datatype = of_record.datatype;
    field.count = 1;
    scan.cloud.fields.push_back(field);
    scan.cloud.point_step += static_cast<pcl::uindex_t>(
        withTypeOf(of_record.datatype, [](auto value) { return sizeof value; }));
  }
  scan.cloud.height = 1;
  scan.cloud.width = static_cast<pcl::uindex_t>(data.size() / size);
  scan.cloud.row_step = scan.cloud.width * scan.cloud.point_step;
  scan.cloud.data = std::move(data);
  return scan;
}

} // namespace pcl6d::io
