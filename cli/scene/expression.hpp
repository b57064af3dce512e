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

/// What the names of an expression stand for.
using Names = std::map<std::string, double>;

/// An expression cannot be read. The message names it and what is known.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& what, std::size_t where) : std::runtime_error(what), offset(where) {}

  std::size_t offset;  // of the culprit in the text, 0-based
};

/// The value of `text`, which may be any number, also one that is not finite. `pi` and the functions of
/// muParser are always known; comparisons and && || give 1 or 0; ? : chooses.
double evaluate(const std::string& text, const Names& names);

/// `text` as a function of the position: x, y, z are known besides `names`. Copies share their state; any
/// number of threads may call them, one of which at a time gets in.
Expression compile(const std::string& text, const Names& names);
/// The same as a function of the time; t is known besides `names`.
std::function<double(double)> compile_of_time(const std::string& text, const Names& names);
/// The same as a function of the position and the time.
Solution compile_in_time(const std::string& text, const Names& names);

/// The same as a function of values with these names, as far as they are names of variables, and of the time.
std::function<double(const std::vector<double>&, double)> compile_of_values(
    const std::string& text, Names names, const std::vector<std::string>& values);

/// The names that occur in `text`, known or not, without functions; empty where it cannot be read.
std::set<std::string> names_in(const std::string& text);

/// sin, cos, sqrt, ...
std::vector<std::string> function_names();

}  // namespace taut::cli
