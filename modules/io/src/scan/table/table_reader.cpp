// SPDX-License-Identifier: BSD-3-Clause
#include "scan/scan_formats.h"
#include "scan/table/table_rows.h"
#include "text/file_input.h"

#include <algorithm>

namespace pcl6d::io {

namespace {
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kSampledRows = 1000; // for estimating the average length of a row

/** \brief Reads a text of points, line by line, in coordinates of type T. */
template <typename T>
class TableReader {
public:
  TableReader(const std::filesystem::path& path,
              const std::vector<std::string>& columns,
              bool is_pts)
  : input_(path), head_(columns, is_pts)
  {}

  ScanCloud
  read()
  {
    const std::size_t size = input_.sizeAhead().value_or(0);
    while (input_.next()) {
      const TableLine line{input_.path(), input_.number(), textOfLine()};
      if (!rows_ && head_.takes(line))
        continue;
      if (!rows_)
        begin(line);
      if (layout_.count && num_rows_ == expected_ && startsBlock(line))
        continue;
      if (!rows_->take(line, scan_.cloud.data))
        continue;
      sampled_ += line.text.size() + 1;
      if (++num_rows_ == kSampledRows)
        scan_.cloud.data.reserve(size / (sampled_ / kSampledRows) *
                                 scan_.cloud.point_step);
    }
    finish();
    return std::move(scan_);
  }

private:
  std::string_view
  textOfLine() const
  {
    std::string_view text = input_.line();
    if (input_.number() == 1 && text.substr(0, kByteOrderMark.size()) == kByteOrderMark)
      text.remove_prefix(kByteOrderMark.size());
    return text;
  }

  void
  begin(const TableLine& row)
  {
    layout_ = head_.layoutFor(row);
    expected_ = layout_.count.value_or(0);
    rows_.emplace(layout_, scan_.cloud);
  }

  /** \return whether the line is the point count of a further block, found in some PTS files */
  bool
  startsBlock(const TableLine& line)
  {
    const auto count = layout_.columns.size() > 1 ? countOf(line.text) : std::nullopt;
    expected_ += count.value_or(0);
    return count.has_value();
  }

  void
  finish()
  {
    pcl::PCLPointCloud2& cloud = scan_.cloud;
    if (!rows_) // an empty text
      rows_.emplace(
          TableLayout{{TableValue::kX, TableValue::kY, TableValue::kZ}, 0, {}, 0, {}},
          cloud);
    if (num_rows_ < expected_)
      text::fail(input_.path(),
                 "ends after " + text::counted(num_rows_, "point") + ", but line " +
                     std::to_string(layout_.count_line) +
                     " and further lines of counts promise " +
                     std::to_string(expected_));
    cloud.height = 1;
    cloud.width = static_cast<pcl::uindex_t>(num_rows_);
    cloud.row_step = cloud.width * cloud.point_step;
    scan_.left_out = std::move(layout_.left_out);
    if (const std::string further = rows_->further(); !further.empty())
      scan_.left_out.push_back(further);
  }

  FileInput input_;
  TableHead head_;
  TableLayout layout_;
  std::optional<TableRows<T>> rows_; ///< empty until the head is complete
  std::uint64_t expected_ = 0;       ///< points by the counts
  std::uint64_t num_rows_ = 0;
  std::size_t sampled_ = 0; // [byte]
  ScanCloud scan_;
};
} // namespace

ScanCloud
readTable(const std::filesystem::path& path,
          const std::vector<std::string>& columns,
          bool is_pts)
{
  ScanCloud scan = TableReader<float>(path, columns, is_pts).read();
  if (needsDouble(path, scan.cloud))
    scan = TableReader<double>(path, columns, is_pts).read();
  return scan;
}

} // namespace pcl6d::io
