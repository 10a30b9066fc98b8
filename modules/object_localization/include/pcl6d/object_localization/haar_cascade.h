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
    /** where to go on below the threshold: a node if > 0, else the leaf -left */
    int left = 0;
    int right = -1;      ///< the same for values from the threshold on
    int feature = 0;     ///< place in HaarCascade::features
    float threshold = 0; ///< of the normalised feature
  };
  std::vector<Node> nodes;   ///< the root first; children after their parents
  std::vector<float> leaves; ///< one more than nodes
};

/** \brief Trees that vote; a window passes if their sum reaches the threshold. */
struct HaarStage {
  std::vector<HaarTree> trees;
  float threshold = 0;

  /** \return what the sum is compared with: OpenCV gives it 1e-5 of slack */
  double
  limit() const
  {
    return threshold - 1e-5f;
  }
};

/** \brief What the pictures are that a cascade was trained on, for ObjectDetector.
 * OpenCV does not read it. */
struct CascadeSubject {
  ImageChannel channel = ImageChannel::kRange;
  double object_size = 1; ///< [m] height of the window where the object stands; > 0
  double pixel = 0.00873; ///< [rad] of the pictures, see DetectionViewOptions
  double slice_depth = 3; ///< [m] of pictures of ranges, see there
};

/** \brief Stages that a window must pass one after the other to be an object.
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

  /** \throws BadArgument telling what is wrong: sizes in [4, 128] px, at least one stage
   * and tree in each, indices in range, trees without loops, features in the window,
   * numbers finite */
  void
  validate() const;
};

} // namespace pcl6d
