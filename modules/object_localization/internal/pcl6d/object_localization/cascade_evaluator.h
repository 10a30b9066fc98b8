// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/haar_cascade.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Evaluates a cascade on images of one width. Decides bit for bit as
 * cv::CascadeClassifier. \ingroup object_localization */
class CascadeEvaluator {
public:
  /** \param[in] cascade valid \param[in] stride of the images' tables */
  CascadeEvaluator(const HaarCascade& cascade, int stride);

  /** \return how many stages the window with this corner passes, in their order;
   * nullopt if its contrast is too low
   * \param[in] image with tables of the given stride; with tilted sums if the cascade
   * has tilted features
   * \param[in] x, y upper left corner of the window [px] */
  std::optional<std::size_t>
  stagesPassed(const IntegralImage& image, int x, int y) const;

  std::size_t
  numStages() const
  {
    return stages_.size();
  }

private:
  struct Stage {
    std::size_t end; ///< index behind the last tree
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

/** \brief The windows of an image to test. */
struct WindowGrid {
  double scale_factor = 1.1; ///< ratio of successive window sizes, in (1, 2]
  int min_height = 0;        ///< [px] smaller windows are left out
  int max_height = 0; ///< [px] larger windows are left out; 0: the height of the image
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief One size of the windows, tested in an image made smaller. */
struct WindowScale {
  float factor = 1; ///< by which the image is made smaller
  int rows = 0;     ///< of the smaller image
  int cols = 0;
  int step = 1;    ///< [px] between windows of the smaller image
  int end_row = 0; ///< windows start above this row
  int end_col = 0; ///< and to the left of this column
  int width = 0;   ///< [px] of the window in the image itself
  int height = 0;

  /** \return the window at (x, y) of the smaller image, in pixels of the image; may
   * reach one pixel over the border */
  ImageRect
  window(int x, int y) const;
};

/** \return the sizes and positions of windows that cv::CascadeClassifier (OpenCV 4)
 * tests: every second row and column while the window is less than twice its size
 * \throws BadArgument see WindowGrid::validate() */
std::vector<WindowScale>
windowScales(int rows, int cols, int width, int height, const WindowGrid& grid = {});

/** \return the windows that pass every stage, equal to the windows found by
 * cv::CascadeClassifier with minNeighbors = 0; from small to large, row by row. As in
 * OpenCV, the window next to a window rejected by the first stage is left out.
 * \throws BadArgument see WindowGrid::validate() */
std::vector<ImageRect>
detectWindows(const HaarCascade& cascade,
              const GrayImage& image,
              const WindowGrid& grid = {});

} // namespace pcl6d
