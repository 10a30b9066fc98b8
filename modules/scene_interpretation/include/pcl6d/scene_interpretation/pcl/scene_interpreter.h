// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/model_refinement.h>

#include <pcl/pcl_base.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Labels the planes of a cloud and makes them exact, with PCL-style calls.
 * \code
 * pcl6d::RegionGrowingPlaneSegmentation<pcl::PointXYZ> segmentation;
 * segmentation.setInputCloud(map);
 * pcl6d::PlaneSegments found;
 * segmentation.segment(found);
 * pcl6d::SceneInterpreter<pcl::PointXYZ> interpreter;
 * interpreter.setInputCloud(map);
 * interpreter.setPlanes(found.planes);
 * pcl6d::Interpretation interpretation = interpreter.interpret();
 * pcl::PointCloud<pcl::PointXYZL> labelled;
 * interpreter.getLabelledCloud(labelled);
 * \endcode
 * \ingroup scene_interpretation */
template <typename PointT>
class SceneInterpreter : public pcl::PCLBase<PointT> {
public:
  using Ptr = pcl::shared_ptr<SceneInterpreter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const SceneInterpreter<PointT>>;

  /** \param[in] planes with points as indices into the input cloud */
  void
  setPlanes(const std::vector<PlaneSegment>& planes)
  {
    planes_ = planes;
  }

  /** \return the planes; after interpret() with their labels */
  const std::vector<PlaneSegment>&
  planes() const
  {
    return planes_;
  }

  /** \param[in] rules default: the book's rules */
  void
  setRules(const LabelRules& rules)
  {
    rules_ = rules;
  }

  InterpretationOptions&
  options()
  {
    return options_;
  }

  RefinementOptions&
  refinementOptions()
  {
    return refinement_options_;
  }

  /** \brief Labels the planes. \throws BadArgument see interpretPlanes() */
  Interpretation
  interpret();

  /** \brief Gives the cloud with the number of each point's label (labelNumber()), 0
   * for points on no plane. \throws BadArgument no input cloud, a point index is out of
   * range, or a label is not in the rules */
  void
  getLabelledCloud(pcl::PointCloud<pcl::PointXYZL>& cloud) const;

  /** \brief Makes the planes exact, see refineModel(). \param[out] cloud the input
   * cloud with the points moved \throws BadArgument no input cloud, or see
   * refineModel() */
  RefinedModel
  refine(pcl::PointCloud<PointT>& cloud) const;

private:
  const pcl::PointCloud<PointT>&
  inputCloud() const;

  std::vector<PlaneSegment> planes_;
  LabelRules rules_ = bookRules();
  InterpretationOptions options_;
  RefinementOptions refinement_options_;
};

} // namespace pcl6d
#include <pcl6d/scene_interpretation/pcl/impl/scene_interpreter.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(SceneInterpreter)
} // namespace pcl6d
