// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_types.h>

/** \file The point types for which the suite's templates are compiled once, in one list. Further
 * point types work from the headers (include the class's impl/.hpp). */

/** Calls MACRO(argument, PointT) for every precompiled point type. */
#define PCL6D_FOR_POINT_TYPES(MACRO, argument)                                         \
  MACRO(argument, pcl::PointXYZ)                                                       \
  MACRO(argument, pcl::PointXYZI)                                                      \
  MACRO(argument, pcl::PointXYZRGB)                                                    \
  MACRO(argument, pcl::PointNormal)                                                    \
  MACRO(argument, pcl::PointXYZINormal)

#define PCL6D_DECLARE_ONE_(Class, PointT) extern template class Class<PointT>;
#define PCL6D_DEFINE_ONE_(Class, PointT) template class Class<PointT>;
/** For class templates over a single point type. */
#define PCL6D_DECLARE_INSTANCES(Class) PCL6D_FOR_POINT_TYPES(PCL6D_DECLARE_ONE_, Class)
#define PCL6D_DEFINE_INSTANCES(Class) PCL6D_FOR_POINT_TYPES(PCL6D_DEFINE_ONE_, Class)

#define PCL6D_DECLARE_PAIR_(Class, PointT)                                             \
  extern template class Class<PointT, PointT, float>;                                  \
  extern template class Class<PointT, PointT, double>;
#define PCL6D_DEFINE_PAIR_(Class, PointT)                                              \
  template class Class<PointT, PointT, float>;                                         \
  template class Class<PointT, PointT, double>;
/** For class templates over source, target and scalar type. */
#define PCL6D_DECLARE_PAIR_INSTANCES(Class)                                            \
  PCL6D_FOR_POINT_TYPES(PCL6D_DECLARE_PAIR_, Class)
#define PCL6D_DEFINE_PAIR_INSTANCES(Class)                                             \
  PCL6D_FOR_POINT_TYPES(PCL6D_DEFINE_PAIR_, Class)
