#include "cli/system/progress.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <unistd.h>

#include <fmt/core.h>

#include "cli/system/terminal_columns.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

constexpr double bar_interval = 0.1;     // s
constexpr double sure_after = 1.0;       // s before a warning
constexpr double long_work = 12 * 3600;  // s
constexpr double line_interval = 10.0;   // s

/// Some terminals wrap in the last column.
std::size_t line_width() { return terminal_columns(STDERR_FILENO).value_or(80) - 1; }

}  // namespace

Progress::Style progress_style(const std::ostream& err, bool quiet) {
  if (quiet) return Progress::Style::none;
  return &err == &std::cerr && ::isatty(STDERR_FILENO) ? Progress::Style::bar : Progress::Style::lines;
}

std::string time_left(double share, double before, double elapsed) {
  constexpr double too_little = 0.005;
  const double done = share - before;
  return done > too_little ? clock_time(elapsed * (1 - share) / done) + " left" : "";
}

std::string long_time_left(double done, double left, double elapsed) {
  if (!(done > 0) || elapsed < sure_after) return "";
  const double seconds = elapsed * left / done;
  if (seconds < long_work) return "";
  constexpr double hour = 3600, day = 24 * hour, most_days = 1e5;
  if (seconds > most_days * day) return "centuries";
  return seconds > 2 * day ? brief(std::round(seconds / day)) + " days"
                           : brief(std::round(seconds / hour)) + " hours";
}

std::string bar_line(const std::string& what, double share, const std::string& left,
                     const std::string& detail, std::size_t width) {
  constexpr std::size_t least_cells = 10, most_cells = 40, of_name = 12;
  constexpr std::size_t kept_free = 26;
  const std::size_t taken = what.size() + kept_free;
  const std::size_t cells = std::clamp(width > taken ? width - taken : 0, least_cells, most_cells);
  const auto full = static_cast<std::size_t>(share * static_cast<double>(cells));
  std::string tail = fmt::format(" [{}{}] {} %", std::string(full, '#'), std::string(cells - full, '.'),
                                 static_cast<int>(100 * share));
  if (!left.empty()) tail += "  " + left;
  const std::size_t room = width > tail.size() ? width - tail.size() : 0;
  const std::string name = what.size() <= room ? what : what.substr(0, std::max(room, of_name) - 2) + "..";
  const bool fits = name.size() + tail.size() + 2 + detail.size() <= width;
  return name + tail + (fits && !detail.empty() ? "  " + detail : "");
}

Progress::~Progress() { clear(); }

void Progress::prepare(const std::string& what) {
  if (style_ == Style::bar) draw(what);
}

void Progress::begin(const std::string& what, double done_before) {
  what_ = what;
  since_begin_ = {};
  since_shown_ = {};
  quarters_ = 0;
  done_before_ = done_before;
  if (style_ == Style::lines) err_ << what_ << std::endl;
  if (style_ == Style::bar) draw_bar(done_before, "");
}

void Progress::warn_of_length(double share) {
  if (warned_) return;
  const std::string length = long_time_left(share - done_before_, 1 - share, since_begin_.seconds());
  if (length.empty()) return;
  warned_ = true;
  clear();
  err_ << "taut: " << length << " left at this speed; use a shorter --until or a larger --spacing"
       << std::endl;
}

void Progress::show(double share, const std::string& detail) {
  share = std::clamp(share, 0.0, 1.0);
  warn_of_length(share);
  const double silence = since_shown_.seconds();
  if (style_ == Style::bar && silence >= bar_interval) {
    draw_bar(share, detail);
    since_shown_ = {};
  }
  // rarer lines keep logs of long runs short
  const bool overdue = silence >= std::max(line_interval, 0.1 * since_begin_.seconds());
  const int quarters = std::min(static_cast<int>(4 * share), 3);
  if (style_ == Style::lines && (quarters > quarters_ || overdue)) {
    quarters_ = quarters;
    print_line(share, detail);
    since_shown_ = {};
  }
}

void Progress::end(const std::string& detail) {
  clear();
  if (style_ == Style::lines) err_ << "  " << detail << std::endl;
}

void Progress::clear() {
  if (bar_shown_) err_ << "\r\x1b[K" << std::flush;
  bar_shown_ = false;
}

void Progress::print_line(double share, const std::string& detail) {
  err_ << "  " << static_cast<int>(100 * share) << " %  " << detail << "  "
       << time_left(share, done_before_, since_begin_.seconds()) << std::endl;
}

void Progress::draw_bar(double share, const std::string& detail) {
  draw(bar_line(what_, share, time_left(share, done_before_, since_begin_.seconds()), detail, line_width()));
}

void Progress::draw(const std::string& line) {
  err_ << '\r' << line.substr(0, line_width()) << "\x1b[K" << std::flush;
  bar_shown_ = true;
}

}  // namespace taut::cli
