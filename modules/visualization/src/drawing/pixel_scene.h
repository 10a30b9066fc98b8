// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/splat_buffer.h"

#include <Eigen/Core>
#include <vtkNew.h>

#include <memory>
#include <string>
#include <vector>

class vtkRenderer;

namespace pcl6d::visualization {

/** \brief A VTK scene whose unit is the pixel: column from the left, row from the top.
 * Points are drawn by the CPU, below every other shape. Of two points, or two other
 * shapes, at one position the higher layer is visible. */
class PixelScene {
public:
  enum class Align { kLeft, kCentre, kRight };
  enum class Turn { kNone, kUpwards };
  struct Pen {
    Colour colour;
    double size = 1;  ///< [px] width of a line, height of text, diameter of a point
    double layer = 2; ///< up to kTopLayer
  };
  static constexpr double kTopLayer = 100;

  PixelScene(int width, int height, const Colour& background);
  ~PixelScene();

  using Polyline = std::vector<Eigen::Vector2d>;

  /** \brief Puts a layer below everything, in place of points. */
  void
  setBase(PixelLayer layer);
  /** \brief Darkens the edges of points, see SplatBuffer::paint(). */
  void
  setShading(double strength)
  {
    shading_ = strength;
  }
  /** \param[in] points column, row, layer in [0, 1] */
  void
  addPoints(const std::vector<Eigen::Vector3f>& points,
            const std::vector<Colour>& colours,
            double size);
  /** \brief Points joined in order. */
  void
  addLine(const Polyline& points, const Pen& pen);
  /** \brief Many lines with one pen, fast. */
  void
  addLines(const std::vector<Polyline>& lines, const Pen& pen);
  /** \brief A filled circle; the pen's size is the diameter. */
  void
  addDisc(const Eigen::Vector2d& centre, const Pen& pen);
  void
  addDiscs(const std::vector<Eigen::Vector2d>& centres, const Pen& pen);
  /** \param[in] place left, centre or right end of the text, half way up
   * \param[in] turn kUpwards: reads from below to above, as beside an axis */
  void
  addText(const Eigen::Vector2d& place,
          const std::string& text,
          Align align,
          const Pen& pen,
          Turn turn = Turn::kNone);

  /** \return the width of a text [px] at a size [px] */
  static double
  textWidth(const std::string& text, double size);

  /** \return the picture on the background, or transparent
   * \throws IoFailed as drawOffscreen() */
  Image
  draw(bool transparent = false);

private:
  void
  addShapes(const std::vector<Polyline>& shapes, bool filled, const Pen& pen);

  int width_;
  int height_;
  Colour background_;
  PixelLayer base_;
  std::unique_ptr<SplatBuffer> splats_; ///< splats of the points; null: no points
  std::vector<Colour> splat_colours_;
  double shading_ = 0;
  vtkNew<vtkRenderer> renderer_;
};

} // namespace pcl6d::visualization
