// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Opens a library of the suite that nothing is linked with, as few who use the rest
 * need it, and which they need not build either. It is looked for beside libpcl6d_common,
 * else where the system looks, and stays open until the process ends.
 * \param[in] purpose what it is needed for, with which errors begin
 * \param[in] library its name without "lib" and ".so", which is also that of its target
 * \return the address of what it shows under the name symbol
 * \throws IoFailed there is no such library (the message says what builds it), or it cannot
 * be opened \ingroup common */
void*
symbolOfLateLibrary(const std::string& purpose,
                    const std::string& library,
                    const char* symbol);

} // namespace pcl6d
