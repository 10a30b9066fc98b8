// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>

#include <cstring>
#include <sstream>

namespace pcl6d::python {

namespace {
/** Beyond this distance [m] float32 steps exceed 0.06 mm, a tenth of the resolution of surveying
 * scanners. */
constexpr double kFar = 1000;
/** [m] limit of Slam6D for poses; rows at this distance are not measurements. */
constexpr double kFarthest = 1e9;

std::string
typeName(const py::handle& value)
{
  return py::str(py::type::handle_of(value).attr("__name__"));
}

std::string
shapeText(const py::array& array)
{
  return py::str(array.attr("shape"));
}

/** A numpy array checked to have N rows of three float32 or float64. */
class Rows {
public:
  Rows(const py::object& value, const std::string& name)
  {
    if (!py::isinstance<py::array>(value))
      throw BadArgument(
          name + " is a " + typeName(value) +
          ", but must be a numpy array of shape (N, 3): use numpy.asarray()");
    if (py::hasattr(value, "mask"))
      throw BadArgument(name + " is a masked array: pass the valid rows, " + name +
                        ".compressed() or a selection");
    array_ = py::reinterpret_borrow<py::array>(value);
    if (array_.ndim() != 2 || array_.shape(1) != 3)
      throw BadArgument(name + " has shape " + shapeText(array_) +
                        ", but must have (N, 3): select the columns x, y, z");
    is_double_ = array_.dtype().is(py::dtype::of<double>());
    if (!is_double_ && !array_.dtype().is(py::dtype::of<float>()))
      throw BadArgument(name + " has dtype " + std::string(py::str(array_.dtype())) +
                        ", but must have float32 or float64: use " + name +
                        ".astype(numpy.float64)");
  }

  std::size_t
  size() const
  {
    return static_cast<std::size_t>(array_.shape(0));
  }
  bool
  isDouble() const
  {
    return is_double_;
  }
  Eigen::Vector3d
  row(std::size_t i) const
  {
    return is_double_ ? read<double>(i) : read<float>(i).template cast<double>().eval();
  }

private:
  /** Views into records may be unaligned: each number is copied bytewise. */
  template <typename Number>
  Eigen::Matrix<Number, 3, 1>
  read(std::size_t i) const
  {
    const auto* at = static_cast<const char*>(array_.data()) +
                     static_cast<py::ssize_t>(i) * array_.strides(0);
    Eigen::Matrix<Number, 3, 1> row;
    for (int axis = 0; axis < 3; ++axis)
      std::memcpy(&row[axis], at + axis * array_.strides(1), sizeof(Number));
    return row;
  }

  py::array array_;
  bool is_double_ = false;
};

/** \return the mean of the finite rows in whole metres, or zero where float32 holds the rows */
Eigen::Vector3d
offsetOf(const Rows& rows)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const Eigen::Vector3d row = rows.row(i); row.allFinite()) {
      sum += row;
      ++count;
    }
  if (count == 0)
    return Eigen::Vector3d::Zero();
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  if (mean.norm() <= kFar || !(mean.norm() < kFarthest))
    return Eigen::Vector3d::Zero();
  return mean.array().round();
}

Cloud
takeRows(const Rows& rows, const Eigen::Vector3d& offset)
{
  Cloud cloud;
  cloud.is_double = rows.isDouble();
  cloud.offset = offset;
  cloud.points.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    cloud.points.push_back((rows.row(i) - offset).cast<float>());
    cloud.num_finite += cloud.points.back().allFinite();
  }
  return cloud;
}

/** \return the value converted by numpy to an array of float64 */
py::array_t<double, py::array::c_style>
numbersOf(const py::object& value, const std::string& name, const std::string& rule)
{
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const py::array any = py::array::ensure(value);
  if (any && std::strchr("fiu", any.dtype().kind()))
    if (auto numbers = Numbers::ensure(any))
      return py::reinterpret_borrow<py::array_t<double, py::array::c_style>>(numbers);
  PyErr_Clear();
  throw BadArgument(name + " is a " + typeName(value) + ", but must be " + rule);
}

Eigen::Isometry3d
rigid(const double* numbers, const std::string& name)
{
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(numbers);
  Eigen::Isometry3d pose(Eigen::Matrix4d{matrix});
  if (!isRigid(pose) || matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw BadArgument(name + " is no rigid motion: the rotation must be orthonormal "
                             "with determinant 1, the last row 0 0 0 1");
  pose.linear() = nearestRotation(pose.linear());
  return pose;
}
} // namespace

Cloud
cloudOf(const py::object& value, const std::string& name)
{
  const Rows rows(value, name);
  return takeRows(rows, rows.isDouble() ? offsetOf(rows) : Eigen::Vector3d::Zero());
}

Cloud
cloudOf(const py::object& value, const std::string& name, std::size_t min_finite)
{
  Cloud cloud = cloudOf(value, name);
  if (cloud.num_finite < min_finite) {
    std::ostringstream message;
    message << name << " has " << cloud.num_finite << " finite points in "
            << cloud.points.size() << " rows, but must have " << min_finite
            << " or more: measure more, or leave the scan out";
    throw BadArgument(message.str());
  }
  return cloud;
}

Cloud
cloudAbout(const py::object& value,
           const std::string& name,
           const Eigen::Vector3d& offset)
{
  return takeRows(Rows(value, name), offset);
}

Eigen::Vector3d
positionOf(const py::object& value, const std::string& name)
{
  const auto numbers = numbersOf(value, name, "three numbers x, y, z");
  if (numbers.size() != 3)
    throw BadArgument(name + " has shape " + shapeText(numbers) +
                      ", but must be three numbers x, y, z");
  Eigen::Vector3d position(Eigen::Map<const Eigen::Vector3d>(numbers.data()));
  if (!position.allFinite())
    throw BadArgument(name + " must be finite");
  return position;
}

Eigen::Isometry3d
poseOf(const py::object& value, const std::string& name)
{
  if (value.is_none())
    return Eigen::Isometry3d::Identity();
  const auto numbers = numbersOf(value, name, "a 4x4 array of float64");
  if (numbers.ndim() != 2 || numbers.shape(0) != 4 || numbers.shape(1) != 4)
    throw BadArgument(name + " has shape " + shapeText(numbers) +
                      ", but must have (4, 4)");
  return rigid(numbers.data(), name);
}

std::vector<Eigen::Isometry3d>
posesOf(const py::object& value, const std::string& name)
{
  const auto numbers = numbersOf(value, name, "an array of float64 of shape (N, 4, 4)");
  if (numbers.ndim() != 3 || numbers.shape(1) != 4 || numbers.shape(2) != 4)
    throw BadArgument(name + " has shape " + shapeText(numbers) +
                      ", but must have (N, 4, 4)");
  std::vector<Eigen::Isometry3d> poses;
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i)
    poses.push_back(
        rigid(numbers.data() + 16 * i, name + "[" + std::to_string(i) + "]"));
  return poses;
}

py::array_t<float>
arrayOf(const Points& points)
{
  static_assert(sizeof(Points::value_type) == 3 * sizeof(float));
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(points.size()), 3};
  return py::array_t<float>(shape, points.empty() ? nullptr : points.front().data());
}

py::array
rowsOf(const Points& points, const Cloud& cloud)
{
  if (!cloud.is_double)
    return arrayOf(points);
  py::array_t<double> rows(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(points.size()), 3});
  double* out = rows.mutable_data();
  for (const auto& p : points)
    for (int axis = 0; axis < 3; ++axis)
      *out++ = static_cast<double>(p[axis]) + cloud.offset[axis];
  return std::move(rows);
}

py::array_t<double>
arrayOf(const Eigen::MatrixXd& matrix)
{
  py::array_t<double> array(std::vector<py::ssize_t>{matrix.rows(), matrix.cols()});
  auto out = array.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < matrix.rows(); ++i)
    for (py::ssize_t k = 0; k < matrix.cols(); ++k)
      out(i, k) = matrix(i, k);
  return array;
}

py::array_t<double>
arrayOf(const Eigen::Isometry3d& pose)
{
  return arrayOf(Eigen::MatrixXd(pose.matrix()));
}

py::array_t<double>
arrayOf(const std::vector<Eigen::Isometry3d>& poses)
{
  py::array_t<double> array(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(poses.size()), 4, 4});
  auto out = array.mutable_unchecked<3>();
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        out(static_cast<py::ssize_t>(i), row, column) = poses[i].matrix()(row, column);
  return array;
}

} // namespace pcl6d::python
