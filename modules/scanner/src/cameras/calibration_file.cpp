// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/calibration_file.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/nesting.h>
#include <pcl6d/io/text.h>

#include <boost/property_tree/xml_parser.hpp>

#include <cmath>
#include <sstream>
#include <string_view>

namespace pcl6d::scanner {

namespace {
/** Rejects incomplete XML: OpenCV reads beyond the end of a text that ends in a tag. */
void
requireXml(std::string_view text, const std::filesystem::path& path)
try {
  std::istringstream stream{std::string(text)};
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(stream, tree);
} catch (const boost::property_tree::xml_parser_error& error) {
  text::failAt(path, error.line(), error.message());
}

/** Rejects texts that crash OpenCV's parsers, which depend on the first characters of a
 * text: too deep, or truncated. */
void
requireReadable(std::string_view text, const std::filesystem::path& path)
{
  constexpr std::string_view kMark = "\xEF\xBB\xBF"; // of UTF-8
  if (text.substr(0, kMark.size()) == kMark)
    text.remove_prefix(kMark.size());
  const std::string name = path.string();
  // A character that ends a line only for OpenCV.
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\0' || (text[i] == '\r' && text.substr(i + 1, 1) != "\n"))
      throw IoFailed(name + ": holds a character outside of text");
  if (text.substr(0, 1) == "<") {
    checkXmlNesting(text, name);
    requireXml(text, path);
  }
  else if (text.substr(0, 1) == "{")
    checkJsonNesting(text, name, JsonKeys::kPlain);
  else
    checkYamlNesting(text, name);
}

/** OpenCV allocates memory for rows x cols before counting the numbers: the text must
 * have at least rows x cols numbers, more with several channels. \throws cv::Exception
 * the node has another type */
bool
hasAllNumbers(const cv::FileNode& matrix)
{
  const int rows = matrix["rows"], cols = matrix["cols"];
  if (rows <= 0 || cols <= 0)
    return false;
  return matrix["data"].size() / static_cast<std::size_t>(rows) >=
         static_cast<std::size_t>(cols);
}
} // namespace

CalibrationFile::CalibrationFile(const std::filesystem::path& path) : path_(path)
{
  const std::string text = text::readFile(path);
  requireReadable(text, path);
  try {
    storage_.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  } catch (const std::exception&) { // not only OpenCV's: some texts break its parser
    fail("is no YAML, XML or JSON of OpenCV");
  }
  if (!storage_.isOpened() || !(storage_.root().isMap() || storage_.root().empty()))
    fail("is no YAML, XML or JSON of OpenCV");
}

void
CalibrationFile::fail(const std::string& message) const
{
  throw IoFailed(path_.string() + ": " + message);
}

void
CalibrationFile::requireEntries(const std::vector<std::string>& names) const
{
  std::string missing;
  for (const auto& name : names)
    if (storage_[name].empty())
      missing += (missing.empty() ? "" : ", ") + name;
  if (!missing.empty())
    fail("has no entry " + missing);
}

std::vector<double>
CalibrationFile::values(const std::string& name) const
{
  cv::Mat matrix;
  try {
    if (hasAllNumbers(storage_[name]))
      storage_[name] >> matrix;
    matrix.convertTo(matrix, CV_64F);
  } catch (const cv::Exception&) {
    matrix.release();
  }
  if (matrix.empty() || matrix.channels() != 1)
    fail("entry " + name + " is no matrix of numbers");
  std::vector<double> all(matrix.begin<double>(), matrix.end<double>());
  for (const double value : all)
    if (!std::isfinite(value))
      fail("entry " + name + " holds infinity or NaN");
  return all;
}

std::vector<double>
CalibrationFile::values(const std::string& name, std::size_t count) const
{
  const auto all = values(name);
  if (all.size() != count)
    fail("entry " + name + " has " + std::to_string(all.size()) +
         " values, but must have " + std::to_string(count));
  return all;
}

Eigen::Matrix3d
CalibrationFile::matrix3(const std::string& name) const
{
  const auto all = values(name, 9);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(all.data());
}

void
CalibrationFile::requireSize(const std::string& name, int expected) const
{
  const cv::FileNode node = storage_[name];
  if (!node.empty() && static_cast<double>(node) != expected)
    fail("entry " + name + " is " + text::shortest(static_cast<double>(node)) +
         ", but the images have " + std::to_string(expected));
}

int
CalibrationFile::size(const std::string& name) const
{
  requireEntries({name});
  const double value = storage_[name].isInt() || storage_[name].isReal()
                           ? static_cast<double>(storage_[name])
                           : 0;
  if (!(value >= 1 && value <= 1e8 && value == std::floor(value)))
    fail("entry " + name + " is no whole number > 0");
  return static_cast<int>(value);
}

/** OpenCV's order: k1 k2 p1 p2, k3, k4 k5 k6, s1 s2 s3 s4, tau_x tau_y. */
void
CalibrationFile::readDistortion(const std::string& name, CameraIntrinsics& lens) const
{
  constexpr std::size_t kRational = 8, kAll = 14;
  std::vector<double> d = values(name);
  const std::size_t n = d.size();
  if (n != 4 && n != 5 && n != 8 && n != 12 && n != 14)
    fail("entry " + name + " has " + std::to_string(n) +
         " values, but must have 4, 5, 8, 12 or 14");
  d.resize(kAll, 0);
  for (std::size_t i = kRational; i < kAll; ++i)
    if (d[i] != 0)
      fail("entry " + name +
           " has a coefficient of a thin prism or a tilted sensor: not supported");
  lens.k = {d[0], d[1], d[4], d[5], d[6], d[7]};
  lens.p = {d[2], d[3]};
}

CameraIntrinsics
CalibrationFile::camera(const std::string& matrix,
                        const std::string& distortion,
                        int width,
                        int height) const
{
  const Eigen::Matrix3d K = matrix3(matrix);
  CameraIntrinsics lens;
  lens.width = width;
  lens.height = height;
  lens.fx = K(0, 0);
  lens.skew = K(0, 1);
  lens.cx = K(0, 2);
  lens.fy = K(1, 1);
  lens.cy = K(1, 2);
  if (K(1, 0) != 0 || K.row(2) != Eigen::RowVector3d::UnitZ())
    fail("entry " + matrix + " is no camera matrix [fx s cx; 0 fy cy; 0 0 1]");
  readDistortion(distortion, lens);
  try {
    lens.validate();
  } catch (const BadArgument& e) {
    fail("entry " + matrix + ": " + e.what());
  }
  return lens;
}

} // namespace pcl6d::scanner
