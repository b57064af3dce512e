#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace taut::cli {

/// Valid while its Options exist.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}
  bool operator==(const Option&) const = default;

  Option& required(bool is_required = true);
  /// `check` returns a message, or "".
  Option& check(std::string (*check)(const std::string& value));
  Option& one_word_each();
  Option& comma_separated();
  Option& excludes(const Option& other);
  Option& needs(const Option& other);

  /// "--out", or a positional argument's placeholder.
  std::string name() const;
  bool has_name(const std::string& name) const;
  std::string placeholder() const;
  std::string help() const;
  bool is_positional() const;
  bool takes_value() const;
  bool may_be_repeated() const;
  /// Values as typed; "true" for a flag without a word.
  std::vector<std::string> values() const;

 private:
  CLI::Option* option_;
};

class Options {
 public:
  struct Texts {
    std::string program;
    std::string summary;
    std::string examples;
    std::string help_flag = "show this text";
  };

  explicit Options(const Texts& texts);
  ~Options();

  template <class Target>
  Option add(std::string_view name, std::string_view placeholder, Target& target, std::string_view help);
  /// Calls `take` after all words have been read.
  Option add(std::string_view name, std::string_view placeholder,
             const std::function<void(const std::string&)>& take, std::string_view help);
  Option add(std::string_view name, std::string_view placeholder,
             const std::function<void(const std::vector<std::string>&)>& take, std::string_view help);
  Option add_flag(std::string_view name, bool& target, std::string_view help);
  /// Declares --name, --name WORD or --name=WORD. Default of WORD: the first of `words`.
  Option add_flag(std::string_view name, const std::vector<std::string>& words, std::string& target,
                  std::string_view help);
  template <class Target>
  Option add_argument(std::string_view name, Target& target, std::string_view help) {
    return add(name, " ", target, help);
  }

  std::vector<Option> all() const;
  std::string help() const;
  /// Returns false for --help. Throws UsageError.
  bool read(const std::vector<std::string>& words);
  /// Joins flags and words as "--name=WORD".
  std::vector<std::string> joined(const std::vector<std::string>& words) const;

 private:
  struct FlagWithWords {
    std::string name;
    std::vector<std::string> words;
    std::string* target;
  };

  const FlagWithWords* find_flag(std::string_view name) const;
  void set_flags(const std::vector<std::string>& words) const;
  void refuse_unknown() const;

  std::unique_ptr<CLI::App> app_;
  std::vector<FlagWithWords> flags_;
};

}  // namespace taut::cli
