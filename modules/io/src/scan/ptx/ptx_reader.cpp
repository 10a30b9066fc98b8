// SPDX-License-Identifier: BSD-3-Clause
#include "scan/scan_formats.h"
#include "text/file_input.h"
#include "text/text_row.h"
#include "trajectory/rigid_pose.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/io/ptx_io.h>

#include <array>
#include <cstring>
#include <limits>

namespace pcl6d {

using namespace io;

namespace {
constexpr std::size_t kPtxAxes =
    4; // lines with the position and the axes of the scanner
constexpr std::size_t kPtxMatrixRows = 4;
constexpr std::size_t kPtxNumbers = 7; // x y z intensity r g b
constexpr double kPtxRigidity = 1e-3;  // of a matrix written with four digits

/** \brief The header of a scan, line by line. */
class PtxHeader {
public:
  explicit PtxHeader(FileInput& input) : input_(input) {}

  /** \param[in] first line, with the number of columns */
  PtxScan
  read()
  {
    PtxScan scan;
    scan.columns = takeCount("columns");
    nextLine();
    scan.rows = takeCount("rows");
    for (std::size_t i = 0; i < kPtxAxes; ++i)
      takeNumbers(3);
    Eigen::Matrix4d transposed; // points are rows in PTX, and multiplied from the left
    std::size_t first_line = 0;
    for (std::size_t i = 0; i < kPtxMatrixRows; ++i) {
      const auto row = takeNumbers(4);
      first_line = i == 0 ? input_.number() : first_line;
      transposed.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector4d(row.data());
    }
    const Eigen::Vector4d last = transposed.col(3);
    if (!last.isApprox(Eigen::Vector4d::UnitW(), kPtxRigidity))
      text::failAt(input_.path(),
                   first_line,
                   "not a rigid motion (the last column of the matrix is not 0 0 0 1)");
    scan.T_world_scan = rigidPose(input_.path(),
                                  first_line,
                                  transposed.topLeftCorner<3, 3>().transpose(),
                                  transposed.row(3).head<3>().transpose());
    scan.line = input_.number() + 1;
    scan.offset = input_.offset();
    return scan;
  }

private:
  void
  nextLine()
  {
    if (!input_.next())
      text::fail(input_.path(),
                 "ends in the header of a scan, behind line " +
                     std::to_string(input_.number()));
  }

  std::uint32_t
  takeCount(const std::string& of)
  {
    text::Tokens tokens(input_.line());
    const auto token = tokens.next();
    std::uint32_t count = 0;
    if (!text::parseNumber(token, count) || !tokens.next().empty())
      text::failAt(input_.path(),
                   input_.number(),
                   text::quoted(input_.line()) + " is not the number of " + of +
                       " at the beginning of a PTX scan");
    return count;
  }

  std::vector<double>
  takeNumbers(std::size_t count)
  {
    nextLine();
    text::Tokens tokens(input_.line());
    std::vector<double> numbers;
    for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
      numbers.push_back(0);
      if (!text::parseNumber(token, numbers.back()))
        text::failAt(
            input_.path(), input_.number(), text::quoted(token) + " is not a number");
    }
    if (numbers.size() != count)
      text::failAt(input_.path(),
                   input_.number(),
                   "expected " + std::to_string(count) +
                       " numbers of the header, got " + std::to_string(numbers.size()));
    return numbers;
  }

  FileInput& input_;
};

/** \brief The points of a scan in coordinates of type T. */
template <typename T>
class PtxPoints {
public:
  PtxPoints(FileInput input, std::size_t numbers)
  : input_(std::move(input)), numbers_(numbers)
  {
    const std::uint8_t type = std::is_same_v<T, float> ? pcl::PCLPointField::FLOAT32
                                                       : pcl::PCLPointField::FLOAT64;
    for (const char* const axis : {"x", "y", "z"})
      addField(axis, type, sizeof(T));
    if (numbers > 3)
      addField("intensity", pcl::PCLPointField::FLOAT32, sizeof(float));
    if (numbers > 4)
      addField("rgb", pcl::PCLPointField::FLOAT32, sizeof(float));
  }

  /** \return the points, or with another number of columns how many numbers a row has */
  std::size_t
  read(const PtxScan& scan, ScanCloud& result)
  {
    const std::uint64_t count = std::uint64_t{scan.columns} * scan.rows;
    cloud_.data.reserve(count * cloud_.point_step); // each has a row: listPtxScans()
    for (std::uint64_t i = 0; i < count; ++i) {
      if (!input_.next())
        text::fail(input_.path(), "was cut off during reading");
      const std::size_t numbers = take();
      if (numbers > numbers_)
        return numbers;
    }
    cloud_.width = scan.rows;
    cloud_.height = scan.columns;
    cloud_.row_step = cloud_.width * cloud_.point_step;
    cloud_.is_dense = false;
    result.cloud = std::move(cloud_);
    return numbers_;
  }

private:
  void
  addField(const char* name, std::uint8_t datatype, std::size_t size)
  {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud_.point_step;
    field.datatype = datatype;
    field.count = 1;
    cloud_.fields.push_back(field);
    cloud_.point_step += static_cast<pcl::uindex_t>(size);
  }

  /** Appends the point of a row. \return how many numbers the row has */
  std::size_t
  take()
  {
    const char* place = input_.line().data();
    const char* const end = place + input_.line().size();
    std::size_t numbers = 0;
    while (numbers < kPtxNumbers && takeNumber(place, end, row_[numbers], Blank()))
      ++numbers;
    while (place != end && Blank()(*place))
      ++place;
    const bool is_missing =
        numbers >= 3 && row_[0] == 0 && row_[1] == 0 && row_[2] == 0;
    if (place != end || (numbers != numbers_ && !is_missing))
      numbers = takeUnusual();
    if (numbers <= numbers_)
      append(is_missing, numbers);
    return numbers;
  }

  std::size_t
  takeUnusual()
  {
    text::Tokens tokens(input_.line());
    std::size_t numbers = 0;
    for (auto token = tokens.next(); !token.empty(); token = tokens.next(), ++numbers) {
      if (numbers == kPtxNumbers)
        fail("expected at most 7 numbers (x y z intensity r g b)");
      if (!text::parseNumber(token, row_[numbers]))
        fail(text::quoted(token) + " is not a number");
    }
    if (numbers < numbers_ || (numbers != 3 && numbers != 4 && numbers != kPtxNumbers))
      fail("expected 3, 4 or 7 numbers, the count of the first row of the scan, got " +
           std::to_string(numbers));
    return numbers;
  }

  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::failAt(input_.path(), input_.number(), message);
  }

  void
  append(bool is_missing, std::size_t numbers)
  {
    if (is_missing)
      std::fill_n(row_.begin(), 3, std::numeric_limits<T>::quiet_NaN());
    std::fill(row_.begin() + static_cast<std::ptrdiff_t>(numbers), row_.end(), T(0));
    auto& data = cloud_.data;
    data.resize(data.size() + cloud_.point_step);
    std::uint8_t* const point = data.data() + data.size() - cloud_.point_step;
    std::memcpy(point, row_.data(), 3 * sizeof(T));
    if (numbers_ > 3) {
      const auto intensity = static_cast<float>(row_[3]);
      std::memcpy(point + 3 * sizeof(T), &intensity, sizeof intensity);
    }
    if (numbers_ > 4) {
      std::uint32_t rgb = 0;
      for (std::size_t i = 4; i < kPtxNumbers; ++i)
        rgb = rgb << 8 | clampedTo<std::uint8_t>(static_cast<double>(row_[i]));
      std::memcpy(point + 3 * sizeof(T) + sizeof(float), &rgb, sizeof rgb);
    }
  }

  FileInput input_;
  std::size_t numbers_;
  std::array<T, kPtxNumbers> row_{};
  pcl::PCLPointCloud2 cloud_;
};

template <typename T>
ScanCloud
readPtxPoints(const std::filesystem::path& path, const PtxScan& scan)
{
  // Rows of missing returns may be shorter: how many numbers a row has turns out on the way.
  ScanCloud result;
  for (std::size_t numbers = 3;;) {
    std::ifstream stream = text::open(path);
    stream.seekg(static_cast<std::streamoff>(scan.offset));
    const std::size_t found =
        PtxPoints<T>(FileInput(std::move(stream), path, scan.line - 1), numbers)
            .read(scan, result);
    if (found == numbers)
      return result;
    numbers = found;
  }
}
} // namespace

std::vector<PtxScan>
listPtxScans(const std::filesystem::path& path)
{
  FileInput input(path);
  std::vector<PtxScan> scans;
  while (input.next()) {
    if (text::isBlank(input.line()))
      continue;
    scans.push_back(PtxHeader(input).read());
    const std::uint64_t count = std::uint64_t{scans.back().columns} * scans.back().rows;
    for (std::uint64_t i = 0; i < count; ++i)
      if (!input.next())
        text::fail(path,
                   "ends after " + std::to_string(i) + " of " +
                       std::to_string(scans.back().columns) + " x " +
                       std::to_string(scans.back().rows) + " points of scan " +
                       std::to_string(scans.size() - 1));
  }
  if (scans.empty())
    text::fail(path, "holds no scan");
  return scans;
}

ScanCloud
readPtxScan(const std::filesystem::path& path, const PtxScan& scan)
{
  ScanCloud cloud = readPtxPoints<float>(path, scan);
  if (needsDouble(path, cloud.cloud))
    cloud = readPtxPoints<double>(path, scan);
  return cloud;
}

ScanCloud
io::readPtx(const std::filesystem::path& path)
{
  const auto scans = listPtxScans(path);
  if (scans.size() > 1)
    text::fail(
        path,
        "holds " + std::to_string(scans.size()) +
            " scans, but a single scan is needed; give the file in place of a folder");
  return readPtxScan(path, scans.front());
}

} // namespace pcl6d
