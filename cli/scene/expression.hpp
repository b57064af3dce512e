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

/// The message contains the expression and the known names.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& what, std::size_t where) : std::runtime_error(what), offset(where) {}

  std::size_t offset;  // of the error in the text
};

/// Value of `text`, possibly not finite. `pi` and muParser's functions are always known. Comparisons, && and || give
/// 1 or 0.
double evaluate(const std::string& text, const Names& names);

/// Function of position x, y, z. Thread-safe: copies share a state behind a lock.
Expression compile(const std::string& text, const Names& names);
/// Like compile, but of time t.
std::function<double(double)> compile_of_time(const std::string& text, const Names& names);
/// Like compile, but of position and time t.
Solution compile_in_time(const std::string& text, const Names& names);

/// Like compile, but of the values named `values` and time t. Names that are no identifiers cannot be used.
std::function<double(const std::vector<double>&, double)> compile_of_values(
    const std::string& text, Names names, const std::vector<std::string>& values);

/// Names in `text`, known or not, without functions; empty if `text` is invalid.
std::set<std::string> names_in(const std::string& text);

/// sin, cos, sqrt, ...
std::vector<std::string> function_names();

}  // namespace taut::cli
