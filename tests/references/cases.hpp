#pragma once

#include <functional>
#include <limits>
#include <map>
#include <ostream>
#include <string>

namespace references {

struct Settings {
  int refine = 1;        ///< multiplies the number of elements along each axis
  double courant = 0.8;  ///< time step over the transit time of a wave between two nodes
  double until = std::numeric_limits<double>::infinity();  ///< end of the table, s, if the case ends later
};

/// Writes a line with the names of the columns, then rows.
using Case = std::function<void(const Settings& settings, std::ostream& table)>;

/// Cases by the name of their table in scenes/references/.
const std::map<std::string, Case>& cases();

}  // namespace references
