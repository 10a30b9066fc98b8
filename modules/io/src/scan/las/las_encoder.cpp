// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/las_header.h"
#include "scan/las/las_values.h"
#include "scan/las/laz_writer.h"
#include "scan/scan_encoder.h"

#include <pcl6d/common/require.h>

#include <limits>

namespace pcl6d::io {

namespace {

constexpr std::size_t kHeaderSize = 375;  // [byte] of LAS 1.4
constexpr std::size_t kRecordHeader = 54; // [byte]
constexpr std::uint16_t kWktRecord = 2112, kLazRecord = 22204;
constexpr std::uint32_t kChunkSize = 50'000; // points; LASzip's default
constexpr std::uint16_t kUsesWkt =
    16; // coordinate systems as WKT, required for formats 6 to 10

/** \brief Writes points of format 6, or 7 with colours. */
class LasEncoder : public ScanEncoder {
public:
  LasEncoder(const ScanShape& shape, bool compress, const std::string& wkt)
  : values_(shape), count_(std::uint64_t{shape.width} * shape.height), wkt_(wkt)
  {
    require(wkt.size() < std::numeric_limits<std::uint16_t>::max(),
            "size of the coordinate system",
            wkt.size(),
            "below 65535");
    if (compress) {
      LazItems items;
      items.is_layered = true;
      items.has_colours = values_.hasColours();
      laz_.emplace(items, kChunkSize);
    }
    record_.resize(values_.recordSize());
    losses_ = values_.losses();
    if (shape.height > 1)
      losses_.push_back(lossesOfShape({{}, 0, shape.width, shape.height}).front());
  }

  std::string
  header() const override
  {
    return std::string(beginOfPoints(), '\0'); // placeholder, completed at the end
  }

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) override
  {
    if (begin == 0)
      values_.lookAt(block, std::uint64_t{block.width} * block.height == count_);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint8_t* const point = block.data.data() + i * block.point_step;
      if (!values_.encode(point, record_.data())) {
        ++num_dropped_;
        continue;
      }
      if (laz_)
        laz_->add(record_.data(), content);
      else
        content.append(reinterpret_cast<const char*>(record_.data()), record_.size());
    }
  }

  void
  finish(std::string& content) override
  {
    count_ -= num_dropped_;
    if (laz_)
      table_ = beginOfPoints() + laz_->finish(content);
    if (num_dropped_ > 0)
      losses_.push_back("dropped " + text::counted(num_dropped_, "point") +
                        " with an x, y or z that is not finite");
    for (auto& loss : values_.lossesOfPoints())
      losses_.push_back(std::move(loss));
  }

  bool
  completesHeader() const override
  {
    return true;
  }

  std::string
  finalHeader() const override
  {
    std::string header(kHeaderSize, '\0');
    const auto put = [&](std::size_t place, auto value) {
      storeLasNumber(&header[place], value);
    };
    header.replace(0, 4, "LASF");
    put(6, kUsesWkt);
    header[24] = 1;
    header[25] = 4;
    header.replace(26, 5, "OTHER"); // system identifier: not known
    header.replace(58, 5, "PCL6D");
    put(94, static_cast<std::uint16_t>(kHeaderSize));
    put(96, static_cast<std::uint32_t>(beginOfPoints()));
    put(100, (laz_ ? 1U : 0U) + (wkt_.empty() ? 0U : 1U));
    header[104] = static_cast<char>((values_.hasColours() ? 7 : 6) | (laz_ ? 0x80 : 0));
    put(105, static_cast<std::uint16_t>(record_.size()));
    values_.storeTransform(&header[131]);
    put(247, count_);
    for (std::size_t i = 0; i < values_.numOfReturns().size(); ++i)
      put(255 + 8 * i, values_.numOfReturns()[i]);
    if (!wkt_.empty())
      header +=
          recordHeader("LASF_Projection", kWktRecord, wkt_.size() + 1) + wkt_ + '\0';
    if (laz_)
      appendRecord(header);
    return header;
  }

private:
  std::size_t
  beginOfPoints() const
  {
    const std::size_t records =
        kHeaderSize + (wkt_.empty() ? 0 : kRecordHeader + wkt_.size() + 1);
    return laz_ ? records + kRecordHeader + laz_->description().size() +
                      sizeof(std::int64_t)
                : records;
  }

  static std::string
  recordHeader(const std::string& user, std::uint16_t record, std::size_t size)
  {
    std::string header(kRecordHeader, '\0');
    header.replace(2, user.size(), user);
    storeLasNumber(&header[18], record);
    storeLasNumber(&header[20], static_cast<std::uint16_t>(size));
    header.replace(22, 5, "PCL6D");
    return header;
  }

  /** Appends the record of the compression and, before the points, the position of the chunk
   * table. */
  void
  appendRecord(std::string& header) const
  {
    const std::string description = laz_->description();
    header += recordHeader("laszip encoded", kLazRecord, description.size()) +
              description + std::string(sizeof(std::int64_t), '\0');
    storeLasNumber(&header[header.size() - sizeof(std::int64_t)],
                   static_cast<std::int64_t>(table_));
    storeLasNumber(&header[96],
                   static_cast<std::uint32_t>(header.size() - sizeof(std::int64_t)));
  }

  LasValues values_;
  std::uint64_t count_; ///< of points
  std::string wkt_;     ///< coordinate system, or empty
  std::size_t num_dropped_ = 0;
  std::optional<LazWriter> laz_;
  std::size_t table_ = 0; ///< [byte]
  std::vector<std::uint8_t> record_;
};

} // namespace

std::unique_ptr<ScanEncoder>
makeLasEncoder(const ScanShape& shape, bool compress, const std::string& wkt)
{
  return std::make_unique<LasEncoder>(shape, compress, wkt);
}

} // namespace pcl6d::io
