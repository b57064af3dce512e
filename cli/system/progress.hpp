#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "cli/system/stopwatch.hpp"

namespace taut::cli {

/// Tells on stderr how far a piece of work is: a bar on a terminal, a few lines elsewhere (a log file), or
/// nothing.
class Progress {
 public:
  enum class Style { none, lines, bar };

  Progress(std::ostream& err, Style style) : err_(err), style_(style) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What is under way before the work begins, on a terminal.
  void prepare(const std::string& what);
  /// `done_before`: the share that an earlier run has done, of work that goes on
  void begin(const std::string& what, double done_before = 0);
  /// `share` of the work is done, 0 to 1. May be called as often as one likes. Work that will take half a day
  /// or more is said to after a second, whatever the style.
  void show(double share, const std::string& detail);
  /// Takes the bar off the terminal, so that something else can be printed.
  void clear();
  /// The last line of this piece of work.
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
  int quarters_ = 0;  // quarters of the work that a line has been printed for
  bool bar_shown_ = false;
  bool warned_ = false;     // that it takes long
  double done_before_ = 0;  // a share
};

/// "0:12 left" of work whose `share` is done, `before` of it by a run that this one goes on with, and the rest in
/// `elapsed` s; nothing as long as that says nothing.
std::string time_left(double share, double before, double elapsed);

/// "17 hours" for work whose share `done` took `elapsed` s while `left` is left; nothing if that is below half a
/// day, or cannot be told yet.
std::string long_time_left(double done, double left, double elapsed);

/// "rings, 4398 particles [####......] 40 %  0:12 left  2.1 M particle-steps/s" in so many columns. Where they do
/// not suffice the detail is left away, then the end of the name: per cent and time left are what one looks for.
std::string bar_line(const std::string& what, double share, const std::string& left,
                     const std::string& detail, std::size_t width);

/// A bar if `err` is the terminal's stderr.
Progress::Style progress_style(const std::ostream& err, bool quiet);

}  // namespace taut::cli
