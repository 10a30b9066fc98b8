// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

/** \file Conversion of numpy arrays to points and poses of the suite, and back. */
namespace pcl6d::python {

namespace py = pybind11;

/** \brief The points of an array in the form for computing: float32, near the origin. */
struct Cloud {
  Points points; ///< [m] one point per row, including NaN rows
  Eigen::Vector3d offset =
      Eigen::Vector3d::Zero(); ///< subtracted from each row, whole metres
  std::size_t num_finite = 0;
  bool is_double = false; ///< the array was float64

  /** \return the pose of the rows from the pose of `points` */
  Eigen::Isometry3d
  poseOfRows(const Eigen::Isometry3d& T_world_points) const
  {
    return T_world_points * Eigen::Translation3d(-offset);
  }
  /** \return the pose of `points` from the pose of the rows */
  Eigen::Isometry3d
  poseOfPoints(const Eigen::Isometry3d& T_world_rows) const
  {
    return T_world_rows * Eigen::Translation3d(offset);
  }
};

/** \brief Copies an (N, 3) array of float32 or float64, of any stride. Rows of float64 with a
 * mean more than 1 km from the origin are centred in double before rounding.
 * \param[in] name of the argument, for messages
 * \throws BadArgument the array has another shape or type */
Cloud
cloudOf(const py::object& value, const std::string& name);

/** \brief cloudOf() with a minimum number of finite rows. \throws BadArgument also if fewer rows
 * are finite */
Cloud
cloudOf(const py::object& value, const std::string& name, std::size_t min_finite);

/** \brief cloudOf() with a given offset instead of the mean. */
Cloud
cloudAbout(const py::object& value,
           const std::string& name,
           const Eigen::Vector3d& offset);

/** \return a position of three numbers \throws BadArgument not three finite numbers */
Eigen::Vector3d
positionOf(const py::object& value, const std::string& name);

/** \return the pose from a 4x4 matrix, exactly rigid; None: identity
 * \throws BadArgument another shape, or not a rigid motion */
Eigen::Isometry3d
poseOf(const py::object& value, const std::string& name);

/** \return the poses from an (N, 4, 4) array \throws BadArgument under the conditions of
 * poseOf() */
std::vector<Eigen::Isometry3d>
posesOf(const py::object& value, const std::string& name);

/** \return an (N, 3) array of float32 from points */
py::array_t<float>
arrayOf(const Points& points);
/** \return an (N, 3) array from points plus offset, float64 if the cloud was */
py::array
rowsOf(const Points& points, const Cloud& cloud);
/** \return a float64 array from a matrix, row by row */
py::array_t<double>
arrayOf(const Eigen::MatrixXd& matrix);
py::array_t<double>
arrayOf(const Eigen::Isometry3d& pose);
/** \return an (N, 4, 4) array of float64 from poses */
py::array_t<double>
arrayOf(const std::vector<Eigen::Isometry3d>& poses);

/** \return an array from numbers, of the same type */
template <typename Number>
py::array_t<Number>
arrayOf(const std::vector<Number>& numbers)
{
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

} // namespace pcl6d::python
