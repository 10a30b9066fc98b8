// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/visualization/overlay.h>

namespace pcl6d {

void
Overlay::append(const Overlay& other)
{
  lines.insert(lines.end(), other.lines.begin(), other.lines.end());
  marks.insert(marks.end(), other.marks.begin(), other.marks.end());
  texts.insert(texts.end(), other.texts.begin(), other.texts.end());
  keys.insert(keys.end(), other.keys.begin(), other.keys.end());
}

} // namespace pcl6d
