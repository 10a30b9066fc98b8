// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Opens an optional library of the suite at run time. No target links with such a
 * library, so most users need not build the library. The loader looks beside libpcl6d_common,
 * then in the system's directories; the library stays open until the process ends.
 * \param[in] purpose use of the library, the start of error messages
 * \param[in] library name without "lib" and ".so", also the name of the build target
 * \return the address of the symbol
 * \throws IoFailed the library is missing (the message tells the target to build), or cannot be
 * opened \ingroup common */
void*
symbolOfLateLibrary(const std::string& purpose,
                    const std::string& library,
                    const char* symbol);

} // namespace pcl6d
