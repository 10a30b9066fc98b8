// SPDX-License-Identifier: BSD-3-Clause
#include "scan/bin_layout.h"
#include "scan/packed_records.h"
#include "scan/scan_formats.h"
#include "text/file_input.h"
#include "text/text_row.h"
#include "trajectory/uos_frame.h"

#include <algorithm>
#include <array>

namespace pcl6d::io {

namespace {

constexpr std::size_t kSample = 1000; // points for the average length of a line
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

/** Sets the width to the number of points in the data. */
void
setWidth(pcl::PCLPointCloud2& cloud)
{
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(cloud.data.size() / cloud.point_step);
  cloud.row_step = cloud.width * cloud.point_step;
}

/** \return whether the line is a heading of 3DTK: starts with text, or holds the size of the
 * scan: "180 x 60", "181 256" or a count */
bool
isHeading(text::Tokens tokens)
{
  std::array<std::string_view, 4> words;
  for (auto& word : words)
    word = tokens.next();
  float value = 0;
  if (!words[0].empty() && !text::parseNumber(words[0], value))
    return true;
  const auto is_size = [](std::string_view word) {
    std::uint32_t size = 0;
    return text::parseNumber(word, size);
  };
  if (!is_size(words[0]) || !words[3].empty())
    return false;
  return words[2].empty() ? words[1].empty() || is_size(words[1])
                          : (words[1] == "x" || words[1] == "X") && is_size(words[2]);
}

/** \brief 3DTK's text: x right, y up, z forward [cm], then perhaps the reflectance.
 * \tparam T of the values in the cloud */
template <typename T>
struct UosText {
  using Value = T;
  static constexpr const char* kSeparators = "";
  /** [cm], divided in double: in float, some coordinates could not be written and read back. */
  using Number = double;

  bool
  operator()(char c) const // separates two numbers
  {
    return Blank()(c);
  }
  static bool
  skips(const FileInput& input)
  {
    // Some files start with the number of points or similar headings.
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

/** \brief Reads the points of a text, with a point at the start of each line. */
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
  std::size_t further_line_ = 0; ///< the first line with extra columns; 0: not found
  ScanCloud scan_;
};

/** Reads a text in double if the points lie far from the origin. */
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

namespace {
/** \return the points of NCLT's records in our frame */
ScanCloud
fromNclt(const std::vector<std::uint8_t>& data)
{
  constexpr std::size_t kRecord = 8;
  constexpr float kStep = 0.005f, kStart = -100; // [m]
  ScanCloud scan;
  addFields<float>({"x", "y", "z", kIntensity, "ring"}, scan.cloud);
  scan.cloud.data.reserve(data.size() / kRecord * scan.cloud.point_step);
  for (std::size_t i = 0; i + kRecord <= data.size(); i += kRecord) {
    const auto coordinate = [&](std::size_t axis) {
      const int steps = data[i + 2 * axis] + 256 * data[i + 2 * axis + 1];
      return static_cast<float>(steps) * kStep + kStart;
    };
    const std::array<float, 5> point = {coordinate(0),
                                        -coordinate(1), // y right, z down
                                        -coordinate(2),
                                        static_cast<float>(data[i + 6]),
                                        static_cast<float>(data[i + 7])};
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(point.data());
    scan.cloud.data.insert(scan.cloud.data.end(), bytes, bytes + sizeof point);
  }
  setWidth(scan.cloud);
  return scan;
}

std::vector<std::string>
fieldsOfLayout(BinLayout layout)
{
  switch (layout) {
  case BinLayout::kXyz:
    return {"x", "y", "z"};
  case BinLayout::kXyzir:
    return {"x", "y", "z", kIntensity, "ring"};
  case BinLayout::kXyzit:
    return {"x", "y", "z", kIntensity, "time"};
  case BinLayout::kXyzirt:
    return {"x", "y", "z", kIntensity, "ring", "time"};
  default:
    return {"x", "y", "z", kIntensity};
  }
}
} // namespace

ScanCloud
readKitti(const std::filesystem::path& path, BinLayout layout)
{
  std::vector<std::uint8_t> data;
  FileInput(path).appendRest(data);
  if (layout == BinLayout::kAuto) {
    const auto guess = guessBinLayout(data);
    if (guess && !guess->is_sure)
      text::fail(path,
                 "its points look like " + toString(guess->layout) +
                     ", but the values do not confirm the guess; give the layout "
                     "(--bin-layout xyz, xyzi, xyzir, xyzit, xyzirt or nclt)");
    layout = guess ? guess->layout : BinLayout::kXyzi;
  }
  if (isPackedRecord(layout))
    return fromPackedRecords(path, layout, std::move(data));
  const std::size_t size = pointSizeOf(layout);
  if (data.size() % size != 0)
    text::fail(path,
               "its size of " + text::counted(data.size(), "byte") +
                   " is not a multiple of " + std::to_string(size) +
                   (layout == BinLayout::kXyzi
                        ? " (float32 x y z intensity)"
                        : " (--bin-layout " + toString(layout) + ")"));
  if (layout == BinLayout::kNclt)
    return fromNclt(data);
  ScanCloud scan;
  addFields<float>(fieldsOfLayout(layout), scan.cloud);
  scan.cloud.data = std::move(data);
  setWidth(scan.cloud);
  return scan;
}

} // namespace pcl6d::io
