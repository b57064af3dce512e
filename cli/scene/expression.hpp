#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace taut::cli {

using Names = std::map<std::string, double>;

class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& what, std::size_t where) : std::runtime_error(what), offset(where) {}

  std::size_t offset;  // 0-based
};

/// The value need not be finite.
double evaluate(const std::string& text, const Names& names);

/// Function of the position x, y, z. Thread-safe.
Expression compile(const std::string& text, const Names& names);
/// Function of the time in s.
std::function<double(double)> compile_of_time(const std::string& text, const Names& names);
Solution compile_in_time(const std::string& text, const Names& names);

/// Function of the variables `values` and of t. Skips names that cannot be variables.
std::function<double(const std::vector<double>&, double)> compile_of_values(
    const std::string& text, Names names, const std::vector<std::string>& values);

/// Variables in `text`; empty if `text` is invalid.
std::set<std::string> names_in(const std::string& text);

std::vector<std::string> function_names();

}  // namespace taut::cli
