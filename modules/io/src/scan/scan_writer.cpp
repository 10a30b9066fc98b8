// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/scan_encoder.h"
#include "scan/scan_formats.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>

#include <algorithm>
#include <cerrno>
#include <ostream>

namespace pcl6d {

using namespace io;

namespace {

constexpr std::size_t kBlock = 8192; // points turned into bytes at once

/** Checks the fields against the size of a point. */
void
checkFields(const ScanShape& shape)
{
  if (std::all_of(shape.fields.begin(), shape.fields.end(), isPadding))
    throw BadArgument("the cloud has no field");
  for (const auto& field : shape.fields) {
    const std::size_t size = sizeOfType(field.datatype);
    if (!isPadding(field) &&
        (size == 0 || field.offset + size * field.count > shape.point_step))
      throw BadArgument("field '" + field.name +
                        "' of the cloud has an unknown type or "
                        "does not fit into a point");
  }
}

/** Checks the points against the size of the data. */
void
checkBlock(const pcl::PCLPointCloud2& block, const ScanShape& shape)
{
  const std::size_t points = std::size_t{block.width} * block.height;
  if (block.data.size() != points * block.point_step)
    throw BadArgument("the cloud holds " + text::counted(block.data.size(), "byte") +
                      ", but " + text::counted(points, "point") + " of " +
                      text::counted(block.point_step, "byte"));
  if (block.point_step != shape.point_step)
    throw BadArgument("a block has points of " +
                      text::counted(block.point_step, "byte") + ", but the scan of " +
                      std::to_string(shape.point_step));
}

std::unique_ptr<ScanEncoder>
makeEncoder(const std::filesystem::path& path,
            const ScanShape& shape,
            const ScanWriterOptions& options)
{
  const ScanFormat format = options.format == ScanFormat::kAuto
                                ? scanFormatOfExtension(path)
                                : options.format;
  switch (format) {
  case ScanFormat::kPcd:
    return makePcdEncoder(path, shape, options.encoding);
  case ScanFormat::kPly:
    return makePlyEncoder(shape, options.encoding == PcdEncoding::kAscii);
  case ScanFormat::kUos:
  case ScanFormat::kUosr:
  case ScanFormat::kKitti:
  case ScanFormat::kXyz:
    return makeFloatEncoder(shape, format);
  case ScanFormat::kLas:
  case ScanFormat::kLaz:
    return makeLasEncoder(shape, format == ScanFormat::kLaz, options.coordinate_system);
  case ScanFormat::kPtx:
    return makePtxEncoder(shape);
  case ScanFormat::kPts:
  case ScanFormat::kCsv:
  case ScanFormat::kTxt:
    throw BadArgument(
        "format = " + toString(format) +
        ", but this format is only read; xyz is a text format for writing");
  case ScanFormat::kAuto:
    break;
  }
  throw BadArgument("no format of scans has the extension " +
                    text::quoted(path.extension().string()) +
                    " (known: " + allExtensions() + ")");
}

} // namespace

bool
isWritten(ScanFormat format)
{
  return format != ScanFormat::kPts && format != ScanFormat::kCsv &&
         format != ScanFormat::kTxt;
}

std::vector<std::string>
writeScan(const std::filesystem::path& path,
          const pcl::PCLPointCloud2& cloud,
          const Eigen::Isometry3d& T_world_scan,
          const ScanWriterOptions& options)
{
  const ScanShape shape = {
      cloud.fields, cloud.point_step, cloud.width, cloud.height, T_world_scan};
  checkBlock(cloud, shape);
  return writeScanBlocks(
      path, shape, options, [&](const ScanSink& sink) { sink(cloud); });
}

std::vector<std::string>
writeScanBlocks(const std::filesystem::path& path,
                const ScanShape& shape,
                const ScanWriterOptions& options,
                const std::function<void(const ScanSink&)>& produce)
{
  checkFields(shape);
  const auto encoder = makeEncoder(path, shape, options);
  if (encoder->completesHeader() && isStream(path))
    text::fail(path,
               "is a pipe, a device or an open file, but the header of LAS and LAZ is "
               "completed at the end; write to a regular file");
  writeFileAtomically(path, [&](std::ostream& stream) {
    std::string content = encoder->header();
    const auto flush = [&] {
      errno = 0;
      stream.write(content.data(), static_cast<std::streamsize>(content.size()));
      if (!stream)
        text::fail(path, text::systemReason("cannot be written"));
      content.clear();
    };
    const std::size_t total = shape.width * shape.height;
    std::size_t written = 0;
    produce([&](const pcl::PCLPointCloud2& block) {
      checkBlock(block, shape);
      const std::size_t points = std::size_t{block.width} * block.height;
      written += points;
      if (written > total)
        return; // said below
      for (std::size_t begin = 0; begin < points; begin += kBlock) {
        encoder->encode(block, begin, std::min(points, begin + kBlock), content);
        flush();
      }
    });
    if (written != total)
      throw BadArgument("the scan has " + text::counted(total, "point") + ", but " +
                        std::to_string(written) + " were handed over");
    encoder->finish(content);
    flush();
    if (encoder->completesHeader()) {
      stream.seekp(0);
      content = encoder->finalHeader();
      flush();
    }
  });
  return encoder->losses();
}

} // namespace pcl6d
