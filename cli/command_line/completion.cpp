#include "cli/command_line/completion.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/placeholders.hpp"
#include "cli/scene/shipped.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Words = std::vector<std::string>;

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

std::string up_to_end_of_line(const std::string& text) { return text.substr(0, text.find('\n')); }

class CommandLine {
 public:
  CommandLine(const Options& command, const Words& words) : options_(command.all()) {
    for (const std::string& word : command.joined({words.begin(), words.end() - 1})) take(word);
  }

  const std::optional<Option>& open_option() const { return open_; }
  std::optional<Option> next_argument() const {
    std::size_t place = 0;
    for (const Option& option : options_) {
      if (!option.is_positional()) continue;
      if (place++ == arguments_.size() || option.may_be_repeated()) return option;
    }
    return std::nullopt;
  }
  std::optional<Option> find(const std::string& name) const {
    for (const Option& option : options_)
      if (!option.is_positional() && option.has_name(name)) return option;
    return std::nullopt;
  }
  std::vector<Option> next_options() const {
    std::vector<Option> next;
    for (const Option& option : options_)
      if (!option.is_positional() &&
          (option.may_be_repeated() || std::ranges::find(seen_, option) == seen_.end()))
        next.push_back(option);
    return next;
  }
  /// Scene of the first argument; nullopt if unreadable.
  std::optional<SceneFile> scene() const try {
    if (arguments_.empty()) return std::nullopt;
    std::vector<Setting> settings;
    if (method_) settings.push_back({"method", *method_});
    const auto of_run = std::filesystem::path(arguments_.front()) / "scene.toml";
    std::error_code error;
    if (std::filesystem::is_regular_file(of_run, error)) return read_scene(of_run);
    return read_scene(find_scene(arguments_.front()), settings);
  } catch (const UsageError&) {
    return std::nullopt;
  } catch (const SceneError&) {
    return std::nullopt;
  }

 private:
  void take(const std::string& word) {
    if (open_) {
      note(*open_, word);
      open_.reset();
    } else if (is_option(word)) {
      const std::size_t equals = std::min(word.find('='), word.size());
      const std::optional<Option> option = find(word.substr(0, equals));
      if (!option) return;
      seen_.push_back(*option);
      if (option->takes_value() && equals == word.size()) open_ = option;
      if (equals < word.size()) note(*option, word.substr(equals + 1));
    } else {
      arguments_.push_back(word);
    }
  }
  void note(const Option& option, const std::string& value) {
    if (option.placeholder() == "METHOD") method_ = value;
  }

  std::vector<Option> options_, seen_;
  std::optional<Option> open_;
  Words arguments_;
  std::optional<std::string> method_;
};

void add_values(Completion& completion, const Option& option, const CommandLine& line,
                const std::string& before, const std::string& typed) {
  const std::optional<SceneFile> scene = line.scene();
  Choices found = choices(option.placeholder(), typed, scene ? &*scene : nullptr);
  completion.files = found.files;
  for (const std::string& word : found.words) completion.words.push_back({before + word, ""});
}

Completion complete_command(const Command& command, const Words& words) {
  Options options({.program = "", .summary = "", .examples = "", .help_flag = "show options and examples"});
  command.declare(options);
  const CommandLine line(options, words);
  const std::string& last = words.back();
  Completion completion;
  const std::size_t equals = last.find('=');
  if (const std::optional<Option>& option = line.open_option()) {
    add_values(completion, *option, line, "", last);
  } else if (is_option(last) && equals != std::string::npos) {
    const std::optional<Option> assigned = line.find(last.substr(0, equals));
    if (assigned && !assigned->placeholder().empty())
      add_values(completion, *assigned, line, last.substr(0, equals + 1), last.substr(equals + 1));
  } else {
    const std::optional<Option> flag = words.size() > 1 ? line.find(words[words.size() - 2]) : std::nullopt;
    if (flag && !flag->placeholder().empty()) add_values(completion, *flag, line, "", last);
    const std::optional<Option> argument = line.next_argument();
    if (argument && !last.starts_with('-')) add_values(completion, *argument, line, "", last);
    if (last.starts_with('-') || !argument)
      for (const Option& next : line.next_options())
        completion.words.push_back({next.name(), up_to_end_of_line(next.help())});
  }
  return completion;
}

Completion complete_name(std::span<const Command> commands) {
  Completion completion;
  for (const Command& command : commands)
    completion.words.push_back({std::string(command.name), std::string(command.summary)});
  completion.words.push_back({"--help", "list the commands"});
  completion.words.push_back({"--version", "show the version of the program"});
  return completion;
}

/// False for special characters, which Bash could execute.
bool is_plain(const std::string& word) {
  return std::ranges::none_of(word, [](unsigned char c) {
    return c <= ' ' ||
           std::string_view("'\"`$\\|&;<>()*?[]{}!#~").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

}  // namespace

Completion complete(std::span<const Command> commands, const Words& typed) {
  if (typed.empty()) return {};
  const auto command = std::ranges::find(commands, typed.front(), &Command::name);
  Completion completion;
  if (typed.size() == 1)
    completion = complete_name(commands);
  else if (command != commands.end())
    completion = complete_command(*command, {typed.begin() + 1, typed.end()});
  std::erase_if(completion.words,
                [&](const Completion::Word& word) { return !word.text.starts_with(typed.back()); });
  return completion;
}

std::string answer_to_shell(std::span<const Command> commands, const Words& typed) {
  const Completion completion = complete(commands, typed);
  std::string answer = completion.files + '\n';
  for (const Completion::Word& word : completion.words)
    if (is_plain(word.text)) answer += word.text + '\t' + word.help + '\n';
  return answer;
}

}  // namespace taut::cli
