// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/checks.h"
#include "doctor/report/words.h"

#include <pcl6d/io/text.h>

#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::app {

namespace {
/** A cloud with its name and measures, and the list for findings. */
struct Subject {
  const char* role; ///< "SOURCE"
  const DoctorCloud& cloud;
  const CloudMeasures& of;
  Findings& findings;

  void
  add(Severity severity,
      const std::string& what,
      const std::string& measured,
      const std::string& advice = {}) const
  {
    findings.push_back({severity, std::string(role) + " " + what, measured, advice});
  }
};

void
checkSize(const Subject& s)
{
  if (s.of.points >= 3)
    return;
  s.add(Severity::kProblem,
        "has no points to register",
        text::counted(s.cloud.rows.size(), "row") + ", of which " +
            std::to_string(s.of.points) + " count and have finite x, y, z",
        "no setting helps; the table shows the outcome of each class");
}

void
checkNan(const Subject& s)
{
  if (s.of.not_finite > 0)
    s.add(Severity::kWarning,
          "holds rows without finite x, y, z",
          shareText(s.of.not_finite, s.cloud.rows.size()) + " rows; is_dense is false",
          "pcl::removeNaNFromPointCloud() before align(), for the classes with changed "
          "results");
  if (s.cloud.left_out > 0)
    s.add(Severity::kNote,
          "holds rows without finite x, y, z, left out by the reader",
          text::counted(s.cloud.left_out, "row") + "; the runs leave the rows out");
}

/** Coordinates changed by PCL's reading into a cloud of pcl::PointXYZ. */
void
checkReading(const Subject& s)
{
  if (s.cloud.lost_by_pcl == 0)
    return;
  s.add(Severity::kProblem,
        "is not read by PCL into pcl::PointXYZ",
        shareText(s.cloud.lost_by_pcl, s.cloud.rows.size()) +
            " rows have changed coordinates after pcl::fromPCLPointCloud2()" +
            (s.cloud.in_double ? "; x is stored as float64, PCL wants float32" : ""),
        "take a place near the cloud off in double, then store x, y, z as float32");
}

void
checkDuplicates(const Subject& s)
{
  constexpr double kShare = 0.01; // smaller shares hardly affect means
  if (static_cast<double>(s.of.duplicates) <= kShare * static_cast<double>(s.of.points))
    return;
  s.add(Severity::kWarning,
        "has points at equal coordinates in float",
        shareText(s.of.duplicates, s.of.points),
        "one point per voxel (pcl6d::OctreeReduction), to count each place once");
}

void
checkNormals(const Subject& s)
{
  if (s.cloud.normals.empty())
    return;
  std::size_t zero = 0, odd = 0;
  for (const std::size_t i : s.cloud.finiteRows(true)) {
    const float length = s.cloud.normals[i].norm();
    if (!std::isfinite(length) || length == 0)
      ++zero;
    else if (std::abs(length - 1) > 1e-3F) // text files have 4 digits
      ++odd;
  }
  if (zero + odd == 0)
    return;
  s.add(Severity::kWarning,
        "has normals of zero length or NaN",
        shareText(zero, s.of.points) + " are zero or NaN, " + std::to_string(odd) +
            " are not of unit length",
        "estimate the normals anew, or use pcl6d::ICP6DWithNormals: the class "
        "estimates missing normals");
}

void
checkNoReturn(const Subject& s)
{
  if (!s.of.no_return)
    return;
  s.add(Severity::kWarning,
        "holds points of rays without echo",
        shareText(s.of.num_no_return, s.of.points) + " lie at " +
            shortNumber(*s.of.no_return, 5) +
            " m from the scanner, at a single range: no surface",
        "keep ranges below " + shortNumber(0.999 * *s.of.no_return, 4) +
            " m (pcl6d::RangeGate)");
}

/** Float resolution against the spacing, at the cloud's distance from 0. */
void
checkDigits(const Subject& s)
{
  if (s.cloud.offset.isZero())
    return;
  const double share = s.of.float_step / s.of.spacing;
  const std::string offset = "(" + vectorText(s.cloud.offset) + ")";
  s.add(share > 0.1 ? Severity::kProblem : Severity::kWarning,
        "lies far from 0: float has few digits left",
        "float steps are " + metres(s.of.float_step) +
            " at its coordinates, the spacing " + metres(s.of.spacing) +
            "; in float, x, y and z of " + std::to_string(s.of.points) +
            " points have " + std::to_string(s.of.values[0]) + ", " +
            std::to_string(s.of.values[1]) + " and " + std::to_string(s.of.values[2]) +
            " different values",
        s.cloud.in_double
            ? "take " + offset + " off in double, before x, y, z become float"
            : "the file holds float32 and lost digits: take " + offset +
                  " off in double before storing the cloud");
}

void
checkUnits(const Subject& s)
{
  constexpr double kLarge = 5000; // [m] beyond the range of scanners on the ground
  const double reach = 2 * s.of.spread; // half of the points are within the spread
  if (reach > kLarge)
    s.add(Severity::kWarning,
          "is large for metres",
          "half of the points are within " + metres(s.of.spread) +
              " of the middle; read as millimetres " + metres(1e-3 * s.of.spread) +
              ", as feet " + metres(0.3048 * s.of.spread),
          "scale the cloud to metres: the defaults of the classes are in metres");
}

void
checkViewpoint(const Subject& s)
{
  if (!s.cloud.viewpoint)
    return;
  const Eigen::Vector3d place = s.cloud.viewpoint->translation();
  const double lost = (place - place.cast<float>().cast<double>()).norm();
  const bool is_lost = lost > 0.1 * s.of.spacing && s.of.spacing > 0;
  s.add(is_lost ? Severity::kWarning : Severity::kNote,
        "has a VIEWPOINT, ignored by align()",
        "(" + vectorText(place) + "), as sensor_origin_ in float " + metres(lost) +
            " beside it",
        "pass the VIEWPOINT as guess, computed in double");
}

void
checkIndices(const Subject& s)
{
  if (!s.cloud.indices)
    return;
  pcl::Indices sorted = *s.cloud.indices;
  const std::size_t given = sorted.size();
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  const bool is_even = sorted.size() == given && s.of.points == given;
  s.add(is_even ? Severity::kNote : Severity::kWarning,
        "is to count by indices",
        shareText(given, s.cloud.rows.size()) + " rows, " +
            std::to_string(given - sorted.size()) + " named twice, " +
            std::to_string(given - s.of.points) + " without finite x, y, z");
}
} // namespace

Findings
checkClouds(const DoctorPair& pair)
{
  Findings findings;
  for (const Subject& s : {Subject{"SOURCE", pair.source, pair.of_source, findings},
                           Subject{"TARGET", pair.target, pair.of_target, findings}}) {
    checkSize(s);
    checkReading(s);
    checkNan(s);
    checkIndices(s);
    if (s.of.points == 0)
      continue;
    checkDuplicates(s);
    checkNormals(s);
    checkNoReturn(s);
    checkDigits(s);
    checkUnits(s);
    checkViewpoint(s);
  }
  return findings;
}

} // namespace pcl6d::app
