#pragma once

#include <stdexcept>
#include <string>

namespace taut {

/// The command line, or a value given to the library, is wrong. The message says what is allowed.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A scene is wrong. `key` is the dotted path of the culprit ("body.left.velocity"); the engine knows no
/// files, so whoever read the scene adds the place.
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

/// A simulation left the realm of numbers.
class NumericalError : public std::runtime_error {
 public:
  NumericalError(long step, double time, long particle, std::string field, const std::string& what)
      : std::runtime_error(what), step(step), time(time), particle(particle), field(std::move(field)) {}

  long step;
  double time;    // s
  long particle;  // in the order of creation
  std::string field;
};

/// Output could not be written.
class OutputError : public std::runtime_error {
 public:
  OutputError(std::string path, const std::string& what) : std::runtime_error(what), path(std::move(path)) {}

  std::string path;
};

}  // namespace taut
