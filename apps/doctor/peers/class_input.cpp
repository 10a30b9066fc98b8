// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/class_input.h"

#include <pcl6d/filters/point_normals.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <numeric>

namespace pcl6d::app {

namespace {
/** \return one normal per row, towards the scanner; zero if unknown */
Normals
estimated(const DoctorCloud& cloud, const CloudMeasures& of)
{
  constexpr std::size_t kNeighbours = 20; // as ICP6D takes
  const auto rows = cloud.finiteRows(false);
  Points points = cloud.localPoints(rows);
  const Eigen::Vector3f scanner = (of.scanner.place - cloud.offset).cast<float>();
  for (auto& p : points)
    p -= scanner; // normals look to 0
  const PointTree tree(points, 1);
  const Normals found = estimateNormals(points, tree, kNeighbours, 1);
  Normals normals(cloud.rows.size(), Eigen::Vector3f::Zero());
  for (std::size_t k = 0; k < rows.size(); ++k)
    normals[rows[k]] = found[k];
  return normals;
}

/** \return the rows kept by a variant, in order */
std::vector<std::size_t>
rowsOf(const DoctorCloud& cloud, const InputVariant& v)
{
  if (v.extracted && cloud.indices && v.without_nan)
    return cloud.finiteRows(true);
  if (v.extracted && cloud.indices)
    return {cloud.indices->begin(), cloud.indices->end()};
  if (v.without_nan)
    return cloud.finiteRows(false);
  std::vector<std::size_t> rows(cloud.rows.size());
  std::iota(rows.begin(), rows.end(), std::size_t(0));
  return rows;
}

/** \return the indices, renumbered to the kept rows; null: the class gets no indices */
pcl::shared_ptr<pcl::Indices>
indicesOf(const DoctorCloud& cloud,
          const InputVariant& v,
          const std::vector<std::size_t>& rows)
{
  if (!cloud.indices || v.extracted || v.without_indices)
    return nullptr;
  std::vector<pcl::index_t> place(cloud.rows.size(), -1);
  for (std::size_t k = 0; k < rows.size(); ++k)
    place[rows[k]] = static_cast<pcl::index_t>(k);
  auto indices = pcl::make_shared<pcl::Indices>();
  for (const auto i : *cloud.indices)
    if (place[static_cast<std::size_t>(i)] >= 0)
      indices->push_back(place[static_cast<std::size_t>(i)]);
  return indices;
}
} // namespace

InputMaker::InputMaker(const DoctorPair& pair)
: pair_(pair)
, of_source_(estimated(pair.source, pair.of_source))
, of_target_(estimated(pair.target, pair.of_target))
{}

pcl::PointCloud<pcl::PointNormal>::Ptr
InputMaker::cloudOf(const DoctorCloud& cloud,
                    const Normals& estimated,
                    const InputVariant& variant,
                    const std::vector<std::size_t>& rows) const
{
  const bool of_file = !cloud.normals.empty() && !variant.own_normals;
  const Normals& normals = of_file ? cloud.normals : estimated;
  const Eigen::Vector3d offset =
      variant.local ? cloud.offset : Eigen::Vector3d::Zero().eval();
  auto made = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  made->reserve(rows.size());
  for (const std::size_t i : rows) {
    pcl::PointNormal p;
    p.getVector3fMap() = (cloud.rows[i] - offset).cast<float>();
    p.getNormalVector3fMap() = normals[i];
    made->push_back(p);
    made->is_dense =
        made->is_dense && cloud.rows[i].allFinite(); // as PCL's reader does
  }
  if (rows.size() == cloud.width * cloud.height && cloud.height > 1) {
    made->width = static_cast<std::uint32_t>(cloud.width);
    made->height = static_cast<std::uint32_t>(cloud.height);
  }
  return made;
}

ClassInput
InputMaker::make(const InputVariant& variant, const Eigen::Isometry3d& start) const
{
  const auto rows = rowsOf(pair_.source, variant);
  ClassInput input;
  input.source = cloudOf(pair_.source, of_source_, variant, rows);
  input.target =
      cloudOf(pair_.target, of_target_, variant, rowsOf(pair_.target, variant));
  input.indices = indicesOf(pair_.source, variant, rows);
  input.guess = variant.local ? start : pair_.toFull(start);
  return input;
}

} // namespace pcl6d::app
