// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite/suite_file.h"

#include <pcl6d/io/json_object.h>

#include <functional>
#include <set>

/** \file Parsers for parts of a suite file. They throw IoFailed "file: /position: fault". */
namespace pcl6d::app {

/** \throws IoFailed the object has members besides the given names */
void
allowMembers(const JsonValue& node, const std::set<std::string>& names);

/** \return a number of at least `least` */
double
numberFrom(const JsonValue& node, double least, const std::string& rule);

/** \return the options in an object, without the members in `besides` */
SuiteOptions
optionsFrom(const JsonValue& node, const std::set<std::string>& besides = {});

/** \return the options in a member; empty if missing */
SuiteOptions
optionsIn(const JsonValue& node, const std::string& name);

/** \brief Calls for every member of the object; the names become names of folders.
 * \throws IoFailed a name is unsuitable for a folder; the object is empty */
void
forEachNamed(const JsonValue& node,
             const std::function<void(const std::string&, const JsonValue&)>& take);

/** \return a damage \throws IoFailed unknown fields, or values that break the rules of
 * SuiteDamage */
SuiteDamage
damageFrom(const std::string& name, const JsonValue& node);

} // namespace pcl6d::app
