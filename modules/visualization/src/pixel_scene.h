// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/image.h>

#include <Eigen/Core>
#include <vtkNew.h>

#include <string>

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace pcl6d {

/** \brief A VTK scene whose unit is the pixel: column from the left, row from the top.
 * Of two things at the same place the one with the higher layer is seen; points have a
 * layer each, in [0, 1]. */
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

  /** \param[in] points column, row, layer */
  void
  addPoints(const std::vector<Eigen::Vector3f>& points,
            const std::vector<Colour>& colours,
            double size);
  /** \brief Points joined in order. */
  void
  addLine(const std::vector<Eigen::Vector2d>& points, const Pen& pen);
  /** \brief A filled circle; the pen's size is its diameter. */
  void
  addDisc(const Eigen::Vector2d& centre, const Pen& pen);
  /** \param[in] place left, centre or right end of the text, half way up
   * \param[in] turn kUpwards: reads from below to above, as beside an axis */
  void
  addText(const Eigen::Vector2d& place,
          const std::string& text,
          Align align,
          const Pen& pen,
          Turn turn = Turn::kNone);

  /** \return the width of a text of this size [px] */
  static double
  textWidth(const std::string& text, double size);

  /** \throws IoFailed as drawOffscreen() */
  Image
  draw();

private:
  vtkActor*
  addActor(vtkPolyData* shape);
  vtkActor*
  addShape(const std::vector<Eigen::Vector2d>& points, bool filled, const Pen& pen);

  int width_;
  int height_;
  vtkNew<vtkRenderer> renderer_;
};

} // namespace pcl6d
