#pragma once

#include <stdexcept>
#include <string>

namespace taut {

/// Invalid command line, setting or input file.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `key`: dotted path of the wrong value ("body.left.velocity").
class SceneError : public std::runtime_error {
 public:
  SceneError(std::string key, const std::string& what) : SceneError("", 0, 0, std::move(key), what) {}
  SceneError(std::string file, int line, int column, std::string key, const std::string& what)
      : std::runtime_error(what), file(std::move(file)), line(line), column(column), key(std::move(key)) {}

  std::string file;
  int line;    // 1-based, 0 = unknown
  int column;  // 1-based, 0 = unknown
  std::string key;
};

/// A value is not finite or beyond the solver's limit, or a particle or element is crushed.
class NumericalError : public std::runtime_error {
 public:
  NumericalError(long step, double time, long particle, std::string field, const std::string& what)
      : std::runtime_error(what), step(step), time(time), particle(particle), field(std::move(field)) {}

  long step;
  double time;    // s
  long particle;  // id; −1 = unknown
  std::string field;
};

class OutputError : public std::runtime_error {
 public:
  OutputError(std::string path, const std::string& what) : std::runtime_error(what), path(std::move(path)) {}

  std::string path;
};

}  // namespace taut
