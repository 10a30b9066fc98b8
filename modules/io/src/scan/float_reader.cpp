// SPDX-License-Identifier: BSD-3-Clause
#include "scan/scan_formats.h"
#include "text/file_input.h"
#include "text/text_row.h"
#include "trajectory/uos_frame.h"

#include <algorithm>
#include <array>

namespace pcl6d::io {

namespace {

constexpr std::size_t kKittiPoint = 4 * sizeof(float); // x y z intensity
constexpr std::size_t kSample = 1000;                  // points that tell their length
constexpr const char* kIntensity = "intensity";

/** \brief Adds fields of a floating point type to a cloud without points. */
template <typename T>
void
addFields(const std::vector<std::string>& names, pcl::PCLPointCloud2& cloud)
{
  for (const auto& name : names) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = std::is_same_v<T, float> ? pcl::PCLPointField::FLOAT32
                                              : pcl::PCLPointField::FLOAT64;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += sizeof(T);
  }
}

/** Makes one row of the points that the data hold. */
void
setWidth(pcl::PCLPointCloud2& cloud)
{
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(cloud.data.size() / cloud.point_step);
  cloud.row_step = cloud.width * cloud.point_step;
}

/** \return whether the first token is text: the line is a heading */
bool
isHeading(text::Tokens tokens)
{
  const auto token = tokens.next();
  float value = 0;
  return !token.empty() && !text::parseNumber(token, value);
}

/** \brief 3DTK's text: x right, y up, z forward [cm], then perhaps the reflectance.
 * \tparam T of the values in the cloud */
template <typename T>
struct UosText {
  using Value = T;
  static constexpr const char* kSeparators = "";
  /** [cm], divided in double: in float, some coordinates would have no text that gives
   * them back. */
  using Number = double;

  bool
  operator()(char c) const // separates two numbers
  {
    return Blank()(c);
  }
  static bool
  skips(const FileInput& input)
  {
    // Some files start with their number of points and the like.
    return input.number() == 1 && isHeading(text::Tokens(input.line()));
  }
  static std::array<T, 4>
  pointOf(const std::array<double, 4>& row)
  {
    const Eigen::Matrix<T, 3, 1> p =
        fromUos(Eigen::Vector3d(row[0], row[1], row[2])).template cast<T>();
    return {p.x(), p.y(), p.z(), static_cast<T>(row[3])};
  }
};

/** \brief x, y, z [m]; commas and semicolons may stand between them. */
template <typename T>
struct XyzText {
  using Value = T;
  static constexpr const char* kSeparators = ",;";
  using Number = T;

  bool
  operator()(char c) const
  {
    return Blank()(c) || c == ',' || c == ';';
  }
  static bool
  skips(const FileInput& input)
  {
    const auto first = text::Tokens(input.line(), kSeparators).next();
    return !first.empty() && first.front() == '#';
  }
  static std::array<T, 4>
  pointOf(const std::array<T, 4>& row)
  {
    return row;
  }
};

/** \brief Reads the points of a text, one at the start of each line. */
template <typename Format>
class TextReader {
public:
  TextReader(const std::filesystem::path& path, const std::vector<std::string>& names)
  : input_(path), columns_(names.size())
  {
    addFields<typename Format::Value>(names, scan_.cloud);
  }

  ScanCloud
  read()
  {
    const std::size_t size = input_.sizeAhead().value_or(0);
    std::size_t sampled = 0; // [byte]
    while (input_.next()) {
      if (!takeLine())
        continue;
      auto& data = scan_.cloud.data;
      const auto point = Format::pointOf(row_);
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(point.data());
      data.insert(data.end(), bytes, bytes + scan_.cloud.point_step);
      sampled += input_.line().size() + 1;
      if (data.size() == kSample * scan_.cloud.point_step)
        data.reserve(size / (sampled / kSample) * scan_.cloud.point_step);
    }
    setWidth(scan_.cloud);
    if (further_line_ > 0)
      scan_.left_out.push_back("columns behind the first " + std::to_string(columns_) +
                               " (line " + std::to_string(further_line_) + ")");
    return std::move(scan_);
  }

private:
  /** \return whether the line holds a point */
  bool
  takeLine()
  {
    const char* place = input_.line().data();
    const char* const end = place + input_.line().size();
    for (std::size_t i = 0; i < columns_; ++i)
      if (!takeNumber(place, end, row_[i], Format()))
        return takeUnusualLine();
    if (further_line_ == 0 && !std::all_of(place, end, Format()))
      further_line_ = input_.number();
    return true;
  }

  bool
  takeUnusualLine()
  {
    if (Format::skips(input_))
      return false;
    text::Tokens tokens(input_.line(), Format::kSeparators);
    for (std::size_t i = 0; i < columns_; ++i) {
      const auto token = tokens.next();
      if (token.empty() && i == 0)
        return false;
      if (token.empty())
        text::failAt(input_.path(),
                     input_.number(),
                     "expected at least " + std::to_string(columns_) +
                         " numbers, got " + std::to_string(i));
      if (!text::parseNumber(token, row_[i]))
        text::failAt(
            input_.path(), input_.number(), text::quoted(token) + " is not a number");
    }
    if (further_line_ == 0 && !tokens.next().empty())
      further_line_ = input_.number();
    return true;
  }

  FileInput input_;
  std::size_t columns_;
  std::array<typename Format::Number, 4> row_{};
  std::size_t further_line_ = 0; ///< the first with more than a point; 0 if none
  ScanCloud scan_;
};

/** Reads a text whose points lie far from the origin in double. */
template <template <typename> class Format>
ScanCloud
readPoints(const std::filesystem::path& path, const std::vector<std::string>& names)
{
  ScanCloud scan = TextReader<Format<float>>(path, names).read();
  if (needsDouble(path, scan.cloud))
    scan = TextReader<Format<double>>(path, names).read();
  return scan;
}

} // namespace

ScanCloud
readUos(const std::filesystem::path& path)
{
  return readPoints<UosText>(path, {"x", "y", "z"});
}

ScanCloud
readUosr(const std::filesystem::path& path)
{
  return readPoints<UosText>(path, {"x", "y", "z", kIntensity});
}

ScanCloud
readXyz(const std::filesystem::path& path)
{
  return readPoints<XyzText>(path, {"x", "y", "z"});
}

ScanCloud
readKitti(const std::filesystem::path& path)
{
  ScanCloud scan;
  addFields<float>({"x", "y", "z", kIntensity}, scan.cloud);
  FileInput(path).appendRest(scan.cloud.data);
  if (scan.cloud.data.size() % kKittiPoint != 0)
    text::fail(path,
               "its size of " + text::counted(scan.cloud.data.size(), "byte") +
                   " is not a multiple of 16 (float32 x y z intensity)");
  setWidth(scan.cloud);
  return scan;
}

} // namespace pcl6d::io
