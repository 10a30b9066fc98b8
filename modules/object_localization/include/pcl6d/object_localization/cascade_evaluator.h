// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/haar_cascade.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A cascade made ready for images of one width. Decides as cv::CascadeClassifier
 * does, to the last bit. \ingroup object_localization */
class CascadeEvaluator {
public:
  /** \param[in] cascade valid \param[in] stride of the images' tables */
  CascadeEvaluator(const HaarCascade& cascade, int stride);

  /** \return how many stages the window with this corner passes, in their order; none if
   * its contrast is too low \param[in] image whose tables have the stride; all of them
   * if the cascade has tilted features */
  std::optional<std::size_t>
  stagesPassed(const IntegralImage& image, int x, int y) const;

  std::size_t
  numStages() const
  {
    return stages_.size();
  }

private:
  struct Stage {
    std::size_t end; ///< of its trees
    double limit;
  };
  struct Tree {
    std::size_t first_node, first_leaf;
  };

  int width_, height_, stride_;
  std::vector<HaarOffsets> features_;
  std::vector<HaarTree::Node> nodes_;
  std::vector<float> leaves_;
  std::vector<Tree> trees_;
  std::vector<Stage> stages_;
};

/** \brief Which windows of an image are tested. */
struct WindowGrid {
  double scale_factor = 1.1; ///< from one size of the window to the next, in (1, 2]
  int min_height = 0;        ///< [px] smaller windows are left out
  int max_height = 0; ///< [px] larger ones are left out; 0: as large as the image
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief One size at which a cascade looks at an image. */
struct WindowScale {
  float factor = 1; ///< by which the image is made smaller
  int rows = 0;     ///< of the smaller image
  int cols = 0;
  int step = 1;    ///< [px] from window to window in the smaller image
  int end_row = 0; ///< windows start above this row
  int end_col = 0; ///< and to the left of this column
  int width = 0;   ///< [px] of the window in the image itself
  int height = 0;

  /** \return the window that starts at (x, y) of the smaller image, in the image itself; it
   * may reach a pixel over the border */
  ImageRect
  window(int x, int y) const;
};

/** \return the sizes and places that cv::CascadeClassifier (OpenCV 4) looks at: every
 * second row and column while the window is less than twice its size
 * \throws BadArgument see WindowGrid::validate() */
std::vector<WindowScale>
windowScales(int rows, int cols, int width, int height, const WindowGrid& grid = {});

/** \return the windows that pass all stages, those that cv::CascadeClassifier finds with
 * minNeighbors = 0, from small to large, row by row. After a window that fails the first
 * stage the next one is left out, as there.
 * \throws BadArgument see WindowGrid::validate() */
std::vector<ImageRect>
detectWindows(const HaarCascade& cascade,
              const GrayImage& image,
              const WindowGrid& grid = {});

} // namespace pcl6d
