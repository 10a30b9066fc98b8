// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/haar_features.h>
#include <pcl6d/scanner/gray_image.h>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A classification and regression tree over features. With one node, a stump. */
struct HaarTree {
  struct Node {
    /** next step for values below the threshold: a node if > 0, else the leaf -left */
    int left = 0;
    int right = -1;      ///< for values at or above the threshold
    int feature = 0;     ///< index into HaarCascade::features
    float threshold = 0; ///< of the normalised feature
  };
  std::vector<Node> nodes;   ///< the root first; children after their parents
  std::vector<float> leaves; ///< one more than nodes
};

/** \brief Trees that vote; a window passes if their sum reaches the threshold. */
struct HaarStage {
  std::vector<HaarTree> trees;
  float threshold = 0;

  /** \return the limit for the sum: OpenCV lowers the threshold by 1e-5 */
  double
  limit() const
  {
    return threshold - 1e-5f;
  }
};

/** \brief The pictures that a cascade was trained on, for ObjectDetector. Ignored by
 * OpenCV. */
struct CascadeSubject {
  ImageChannel channel = ImageChannel::kRange;
  double object_size = 1; ///< [m] height of the window where the object stands; > 0
  double pixel = 0.00873; ///< [rad] see DetectionViewOptions
  double slice_depth = 3; ///< [m] of range pictures, see DetectionViewOptions
};

/** \brief Stages that a window must pass in turn to be accepted as an object.
 * \note Source: Viola and Jones, CVPR 2001. \ingroup object_localization */
struct HaarCascade {
  int width = 24; ///< [px] of the window
  int height = 24;
  std::vector<HaarFeature> features;
  std::vector<HaarStage> stages;
  std::optional<CascadeSubject> subject;

  /** \return whether a feature is tilted */
  bool
  hasTilted() const;

  /** \throws BadArgument naming the broken rule: sizes in [4, 128] px, at least one
   * stage and one tree per stage, indices in range, trees without loops, features in
   * the window, numbers finite */
  void
  validate() const;
};

} // namespace pcl6d
