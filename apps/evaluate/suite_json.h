// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite_file.h"

#include <pcl6d/io/json_object.h>

#include <functional>
#include <set>

/** \file Parts of a suite file, read. What is wrong: IoFailed "file: /place: what". */
namespace pcl6d::app {

/** \throws IoFailed the object has other members than these */
void
allowMembers(const JsonValue& node, const std::set<std::string>& names);

/** \return a number that is no less */
double
numberFrom(const JsonValue& node, double least, const std::string& rule);

/** \return the options in an object, without those in `besides` */
SuiteOptions
optionsFrom(const JsonValue& node, const std::set<std::string>& besides = {});

/** \return the options in a member, which may be missing */
SuiteOptions
optionsIn(const JsonValue& node, const std::string& name);

/** \brief Calls for every member of the object, whose names become names of folders.
 * \throws IoFailed a name is not good for that; there is no member */
void
forEachNamed(const JsonValue& node,
             const std::function<void(const std::string&, const JsonValue&)>& take);

/** \return a damage \throws IoFailed it has unknown fields, or values that break the rules
 * of SuiteDamage */
SuiteDamage
damageFrom(const std::string& name, const JsonValue& node);

} // namespace pcl6d::app
