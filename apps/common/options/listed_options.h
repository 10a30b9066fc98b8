// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/option_table.h"

#include <pcl6d/common/option_spec.h>

#include <map>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Adds an option to the last group of a table. */
void
addOption(OptionTable& table, const OptionSpec& option);

/** \brief Adds the options of programs, each group under its caption; fields meant only
 * for callers of the library are left out. */
void
addOptions(OptionTable& table, const OptionList& options);

/** \return the options whose role has a property, e.g. isInSummary(): words, and
 * lengths derived from the scans by default */
std::vector<std::string>
namesOf(const OptionList& options, bool (*has)(OptionRole));

/** \return one sentence about given options without effect in this run; empty: every
 * given option counts */
std::string
withoutEffect(const OptionTable& table, const OptionList& options);

/** \return the options whose names differ from the library's fields, for
 * OptionTable::check() */
std::map<std::string, std::string>
optionsOfFields(const OptionList& options);

} // namespace pcl6d::app
