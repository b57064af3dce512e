#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "cli/system/stopwatch.hpp"

namespace taut::cli {

class Progress {
 public:
  enum class Style { none, lines, bar };

  Progress(std::ostream& err, Style style) : err_(err), style_(style) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// On a terminal, shows `what` before the work begins.
  void prepare(const std::string& what);
  /// `done_before`: share done by an earlier run.
  void begin(const std::string& what, double done_before = 0);
  /// `share`: 0 to 1. Warns once if half a day or more is left.
  void show(double share, const std::string& detail);
  /// Call before other output.
  void clear();
  void end(const std::string& detail);

 private:
  void warn_of_length(double share);
  void draw_bar(double share, const std::string& detail);
  void draw(const std::string& line);
  void print_line(double share, const std::string& detail);

  std::ostream& err_;
  Style style_;
  std::string what_;
  Stopwatch since_begin_, since_shown_;
  int quarters_ = 0;
  bool bar_shown_ = false;
  bool warned_ = false;
  double done_before_ = 0;  // share
};

/// "0:12 left". The share done rose from `before` to `share` in `elapsed` s. May be empty.
std::string time_left(double share, double before, double elapsed);

/// "17 hours" for the share `left`. The share `done` took `elapsed` s. May be empty.
std::string long_time_left(double done, double left, double elapsed);

/// "rings [####......] 40 %  0:12 left  2.1 M particle-steps/s". Shortened to fit `width`.
std::string bar_line(const std::string& what, double share, const std::string& left,
                     const std::string& detail, std::size_t width);

/// Bar if `err` is stderr on a terminal.
Progress::Style progress_style(const std::ostream& err, bool quiet);

}  // namespace taut::cli
