// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/record_writer.h"
#include "support/temp_folder.h"

#include <cstring>
#include <string>
#include <vector>

/** \file E57 files as a test wants them, right or broken. */
namespace pcl6d::test {

using sources::E57Field;
using sources::E57Kind;

/** \brief A field of a scan, and its values. */
struct MadeField {
  E57Field field;
  std::vector<std::int64_t> integers; ///< of integers, as stored
  std::vector<double> reals;          ///< of floating point
};

/** \brief A scan with any fields. */
struct MadeScan {
  std::vector<MadeField> fields;
  std::string about;             ///< XML that stands ahead of its points
  std::size_t packet_points = 0; ///< 0: as many as fit
};

inline MadeField
realsOf(const std::string& name,
        std::vector<double> values,
        E57Kind kind = E57Kind::kDouble)
{
  MadeField made;
  made.field.name = name;
  made.field.kind = kind;
  made.reals = std::move(values);
  return made;
}

inline MadeField
integersOf(const std::string& name,
           std::int64_t minimum,
           std::int64_t maximum,
           std::vector<std::int64_t> values)
{
  MadeField made;
  made.field.name = name;
  made.field.kind = E57Kind::kInteger;
  made.field.minimum = minimum;
  made.field.maximum = maximum;
  made.integers = std::move(values);
  return made;
}

inline MadeField
scaledOf(MadeField made, double scale, double offset = 0)
{
  made.field.kind = E57Kind::kScaled;
  made.field.scale = scale;
  made.field.offset = offset;
  return made;
}

/** \return a scan of points with coordinates as double */
inline MadeScan
scanOfPoints(const std::vector<std::vector<double>>& points)
{
  MadeScan scan;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& point : points)
      values.push_back(point[axis]);
    scan.fields.push_back(
        realsOf(std::string("cartesian") + "XYZ"[axis], std::move(values)));
  }
  return scan;
}

inline std::string
prototypeText(const E57Field& field)
{
  const std::string limits = " minimum=\"" + std::to_string(field.minimum) +
                             "\" maximum=\"" + std::to_string(field.maximum) + "\"";
  char scale[96];
  std::snprintf(scale,
                sizeof scale,
                " scale=\"%.17g\" offset=\"%.17g\"",
                field.scale,
                field.offset);
  switch (field.kind) {
  case E57Kind::kSingle:
    return "<" + field.name + " type=\"Float\" precision=\"single\"/>\n";
  case E57Kind::kDouble:
    return "<" + field.name + " type=\"Float\"/>\n";
  case E57Kind::kInteger:
    return "<" + field.name + " type=\"Integer\"" + limits + "/>\n";
  case E57Kind::kScaled:
    return "<" + field.name + " type=\"ScaledInteger\"" + limits + scale + "/>\n";
  default:
    return "<" + field.name + " type=\"String\"/>\n";
  }
}

inline std::string
rootText(const std::string& content)
{
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
         "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\">\n" +
         content + "</e57Root>\n";
}

inline std::string
dataText(const std::string& scans)
{
  return rootText("<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n" +
                  scans + "</data3D>\n");
}

/** Writes the points of a scan. \return its element of the XML section */
inline std::string
writeMadeScan(const MadeScan& scan, sources::PageWriter& pages)
{
  std::vector<E57Field> fields;
  std::string prototype;
  std::size_t count = 0;
  for (const auto& made : scan.fields) {
    fields.push_back(made.field);
    prototype += prototypeText(made.field);
    count = std::max(made.integers.size(), made.reals.size());
  }
  sources::RecordWriter records(pages, fields, count, scan.packet_points);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t f = 0; f < fields.size(); ++f)
      if (fields[f].isInteger())
        records.field(f).addInteger(scan.fields[f].integers[i]);
      else
        records.field(f).addReal(scan.fields[f].reals[i]);
    records.endPoint();
  }
  return "<vectorChild type=\"Structure\">\n<guid type=\"String\">g</guid>\n" +
         scan.about + "<points type=\"CompressedVector\" fileOffset=\"" +
         std::to_string(records.offset()) + "\" recordCount=\"" +
         std::to_string(count) + "\">\n<prototype type=\"Structure\">\n" + prototype +
         "</prototype>\n</points>\n</vectorChild>\n";
}

inline void
finishWith(const std::string& xml, sources::PageWriter& pages)
{
  pages.align();
  const std::uint64_t offset = pages.physical();
  pages.write(xml.data(), xml.size());
  pages.finish(offset, xml.size());
}

inline void
makeE57(const std::filesystem::path& path, const std::vector<MadeScan>& scans)
{
  sources::PageWriter pages(path);
  std::string text;
  for (const auto& scan : scans)
    text += writeMadeScan(scan, pages);
  finishWith(dataText(text), pages);
}

/** Writes a file that holds nothing but an XML section. */
inline void
makeE57OfText(const std::filesystem::path& path, const std::string& xml)
{
  sources::PageWriter pages(path);
  finishWith(xml, pages);
}

/** Writes bytes with the checksums that their pages should have. */
inline void
writeResealed(const std::filesystem::path& path, std::string bytes)
{
  for (std::size_t begin = 0; begin + sources::kPageSize <= bytes.size();
       begin += sources::kPageSize)
    sources::storeChecksum(reinterpret_cast<std::uint8_t*>(&bytes[begin]));
  std::filesystem::remove(path);
  writeText(path, bytes);
}

} // namespace pcl6d::test
