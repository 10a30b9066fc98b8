// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/visualization/top_view.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Two pictures side by side with their layouts; the columns of the second begin
 * behind the first. */
struct BeforeAfterPicture {
  Image image;
  TopViewLayout before;
  TopViewLayout after; ///< columns counted from the picture's left end
};

/** \brief Two states of a map from above, side by side: equal area, scale and colours.
 * \ingroup visualization */
class BeforeAfterView {
public:
  /** \param[in] options of the whole picture; the title stands over the left half
   * \param[in] after_title of the right half
   * \throws BadArgument an option is invalid, or the width is below 400 px */
  explicit BeforeAfterView(const TopViewOptions& options = defaultOptions(),
                           const std::string& after_title = "after");

  /** \return options with colours by scan, and the title "before" */
  static TopViewOptions
  defaultOptions();

  /** \throws BadArgument, IoFailed as TopView::draw() */
  BeforeAfterPicture
  draw(const TopViewScene& before, const TopViewScene& after) const;

private:
  TopViewOptions options_;
  std::string after_title_;
};

} // namespace pcl6d
