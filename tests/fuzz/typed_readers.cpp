#include <algorithm>
#include <array>
#include <csignal>
#include <sstream>
#include <utility>

#include "cli/command_line/completion.hpp"
#include "cli/command_line/program.hpp"
#include "cli/commands/commands.hpp"
#include "cli/drawing/keys.hpp"
#include "cli/run/plan.hpp"
#include "cli/run/run.hpp"
#include "cli/session/session_commands.hpp"
#include "cli/session/session_completion.hpp"
#include "cli/study/chart.hpp"
#include "cli/study/csv.hpp"
#include "cli/study/expectation.hpp"
#include "cli/study/gnuplot.hpp"
#include "cli/sweep/grid.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/simulation.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/fuzz/small_scenes.hpp"

namespace taut::fuzz {

using namespace cli;

namespace {

/// Keeps paths inside the folder.
std::string without_slashes(std::string text) {
  std::ranges::replace(text, '/', '_');
  return text;
}

void run_line(Session& session, const std::string& line, const Dialogue& to) {
  const Interrupts interrupts;
  std::istringstream words(line);
  std::string name, count;
  words >> name >> count;
  if (name.starts_with("run") || count.size() > 1) std::raise(SIGTERM);
  run_session_line(session, line, {to.out, interrupts, to.progress});
}

std::function<int(Streams)> declare_plan(Options& command) {
  auto options = std::make_shared<RunOptions>();
  options->scene = "small.toml";
  declare_setting_options(command, *options);
  declare_output_options(command, *options);
  declare_particle_options(command, *options);
  return [options](Streams) {
    make_plan(*options);
    return 0;
  };
}

template <std::size_t Number>
std::function<int(Streams)> declare_only(Options& command) {
  const std::function<int(Streams)> kept = commands()[Number].declare(command);
  return [kept](Streams) { return 0; };
}

/// Only `list`, `completion` and `plan` run; other commands end after reading their arguments.
std::vector<Command> harmless_commands() {
  const std::span<const Command> all = commands();
  constexpr std::size_t most = 24;
  std::vector<Command> harmless(all.begin(), all.end());
  expect(all.size() <= most, "there are more commands than `most`");
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    const auto replace = [&](std::size_t number, auto* declare) {
      if (number >= all.size()) return;
      const std::string_view name = all[number].name;
      if (name != "list" && name != "completion") harmless[number].declare = declare;
    };
    (replace(k, declare_only<k>), ...);
  }
  (std::make_index_sequence<most>());
  harmless.push_back({"plan", "what `taut run` checks", "", declare_plan});
  return harmless;
}

}  // namespace

/// `bytes`: lines of a session, then optionally another scene.
void read_session_lines(std::string_view bytes) {
  const std::vector<std::string> parts = parts_of(bytes, 2);
  RunOptions options;
  options.scene = write("small.toml", parts[1].empty() ? small_scenes.front().text : parts[1]).string();
  options.threads = 1;
  if (!is_small(scene_to_run(options).scene)) return;
  Session session(options);
  session.save(folder() / "saved");
  std::ostringstream out;
  Progress progress(out, Progress::Style::none);
  const Interrupts interrupts;
  std::size_t left = 8;
  for (const std::string& line : lines_of(without_slashes(parts[0]))) {
    if (left-- == 0) return;
    attempt([&] { run_line(session, line, {out, interrupts, progress}); });
    std::istringstream text(line);
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    if (words.empty()) words.emplace_back();
    session_choices(session, words);
  }
}

void read_arguments(std::string_view bytes) {
  static const std::vector<Command> harmless = harmless_commands();
  write("small.toml", small_scenes.front().text);
  std::ostringstream out, err;
  const int code = run_program(harmless, lines_of(bytes), {out, err});
  expect(code != exit_bug, err.str());
  expect(code == exit_fine || !err.str().empty(), "an exit code without a message");
}

void read_completion(std::string_view bytes) {
  write("small.toml", small_scenes.front().text);
  const std::vector<std::string> words = lines_of(bytes);
  const std::string typed = words.empty() ? "" : words.back();
  for (const Completion::Word& word : complete(commands(), words).words)
    expect(word.text.find('\n') == std::string::npos, "a suggestion of two lines for '" + typed + "'");
  answer_to_shell(commands(), words);
}

void read_values(std::string_view bytes) {
  const std::string text(bytes);
  for (const auto& line : lines_of(text)) nearest(line, {"oenog", "colliding-rings", "spacing"});
  attempt([&] { parse_setting(text); });
  attempt([&] {
    const Axis axis = parse_axis(text);
    check_rows(all_combinations({axis}));
    for (const GridRow& row : all_combinations({axis})) {
      const std::string name = folder_name(row);
      expect(!name.empty() && name.size() < 256 && name.find('/') == std::string::npos && name != "." &&
                 name != "..",
             "'" + name + "' is not a name of a folder");
    }
  });
  attempt([&] { parse_expectation(text, Tolerance{0.1, true}); });
  attempt([&] { parse_tolerance(text, "--tolerance"); });
  attempt([&] { plot_files(text); });
  attempt([&] { find_cost(text); });
  attempt([&] { parse_verdict(text); });
  const std::string once = canonical_value(text);
  expect(canonical_value(once) == once, "'" + once + "' is not canonical");
  const std::size_t between = text.find(' ');
  if (between == std::string::npos) return;
  for (const DrawingKey& key : drawing_keys())
    if (key.name == text.substr(0, between)) {
      Drawing drawing;
      set_typed(drawing, key, text.substr(between + 1));
      const DrawingValue value = key.get(drawing);
      Drawing again;
      const std::string wrong = key.set(again, value);
      expect(wrong.empty() && key.get(again) == value,
             text + " is refused or changed when read again: " + wrong);
    }
}

void read_text(std::string_view bytes) {
  const std::string text(bytes);
  const CsvTable table = parse_csv("a,b\n" + csv_cell(text) + ",2\n", "cells.csv");
  expect(table.rows.size() == 1 && table.rows[0].size() == 2 && table.rows[0][0] == text,
         "a cell of a CSV table changes when written and read again");
  for (const std::string& quoted : {plot_text(text), data_text(text)})
    expect(std::ranges::none_of(quoted, [](char c) { return c == '\n' || c == '\r' || c == '\0'; }),
           "a text in a gnuplot script has a line break");
  constexpr std::string_view quote = "'.\"\\047\".'";  // in a gnuplot string
  std::string drawn = plot_text(text);
  for (std::size_t at = 0; (at = drawn.find(quote, at)) != std::string::npos;) drawn.erase(at, quote.size());
  expect(std::ranges::count(drawn, '\'') == 2 && drawn.front() == '\'' && drawn.back() == '\'',
         "a quote ends a text in a gnuplot script early");
  const std::string data = data_text(text);
  expect(std::ranges::count(data, '"') == 2 && data.find('\\') == std::string::npos,
         "a quoted text contains further quotes or a backslash");
  const std::string comment = plot_comment(text);
  expect(std::ranges::count(comment, '\n') == 1, "a comment has several lines");
  shortened(text);
}

}  // namespace taut::fuzz
