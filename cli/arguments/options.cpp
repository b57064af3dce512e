#include "cli/arguments/options.hpp"

#include <algorithm>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

const CLI::Option* greedy_option(const CLI::App& app) {
  for (const CLI::Option* o : app.get_options())
    if (!o->get_positional() && o->get_allow_extra_args() && o->get_items_expected_max() > 1 &&
        o->count() > 1)
      return o;
  return nullptr;
}

std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& e) {
  const std::string text = e.what();
  if (const CLI::Option* taker = greedy_option(app); taker && dynamic_cast<const CLI::RequiredError*>(&e))
    return fmt::format("{}: {} takes all words that follow it; put the argument before it", text,
                       taker->get_name());
  if (!dynamic_cast<const CLI::ArgumentMismatch*>(&e)) return text;
  const bool too_many = text.find("received") != std::string::npos;
  return text.substr(0, text.find(':')) + (too_many ? " can be given only once" : " needs a value");
}

Option with_placeholder(CLI::Option& option, std::string_view placeholder) {
  option.option_text(std::string(placeholder));
  return Option(option);
}

}  // namespace

Option& Option::required(bool is_required) {
  option_->required(is_required);
  return *this;
}

Option& Option::check(std::string (*check)(const std::string& value)) {
  option_->check(check);
  return *this;
}

Option& Option::one_word_each() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::comma_separated() {
  option_->delimiter(',');
  return one_word_each();
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

std::string Option::name() const { return option_->get_name(); }

bool Option::has_name(const std::string& name) const { return option_->check_name(name); }

std::string Option::placeholder() const { return is_positional() ? name() : option_->get_option_text(); }

std::string Option::help() const { return option_->get_description(); }

bool Option::is_positional() const { return !option_->nonpositional(); }

bool Option::takes_value() const { return option_->get_items_expected_max() > 0; }

bool Option::may_be_repeated() const { return option_->get_items_expected_max() > 1; }

std::vector<std::string> Option::values() const { return option_->results(); }

Options::Options(const Texts& texts) : app_(std::make_unique<CLI::App>(texts.summary, texts.program)) {
  app_->allow_extras();
  app_->set_help_flag("--help,-h", texts.help_flag);
  app_->footer("Examples:\n" + texts.examples);
  app_->get_formatter()->column_width(26);
}

Options::~Options() = default;

template <class Target>
Option Options::add(std::string_view name, std::string_view placeholder, Target& target,
                    std::string_view help) {
  return with_placeholder(*app_->add_option(std::string(name), target, std::string(help)), placeholder);
}

template Option Options::add(std::string_view, std::string_view, int&, std::string_view);
template Option Options::add(std::string_view, std::string_view, double&, std::string_view);
template Option Options::add(std::string_view, std::string_view, std::string&, std::string_view);
template Option Options::add(std::string_view, std::string_view, std::optional<int>&, std::string_view);
template Option Options::add(std::string_view, std::string_view, std::optional<double>&, std::string_view);
template Option Options::add(std::string_view, std::string_view, std::optional<std::string>&,
                             std::string_view);
template Option Options::add(std::string_view, std::string_view, std::vector<double>&, std::string_view);
template Option Options::add(std::string_view, std::string_view, std::vector<std::string>&, std::string_view);

Option Options::add(std::string_view name, std::string_view placeholder,
                    const std::function<void(const std::string&)>& take, std::string_view help) {
  return with_placeholder(*app_->add_option_function(std::string(name), take, std::string(help)),
                          placeholder);
}

Option Options::add(std::string_view name, std::string_view placeholder,
                    const std::function<void(const std::vector<std::string>&)>& take, std::string_view help) {
  return with_placeholder(*app_->add_option_function(std::string(name), take, std::string(help)),
                          placeholder);
}

Option Options::add_flag(std::string_view name, bool& target, std::string_view help) {
  return Option(*app_->add_flag(std::string(name), target, std::string(help)));
}

Option Options::add_flag(std::string_view name, const std::vector<std::string>& words, std::string& target,
                         std::string_view help) {
  flags_.push_back({std::string(name), words, &target});
  return with_placeholder(*app_->add_flag(std::string(name), target, std::string(help)),
                          "[" + join(words, "|") + "]");
}

std::vector<Option> Options::all() const {
  std::vector<Option> all;
  for (CLI::Option* option : app_->get_options()) all.emplace_back(*option);
  return all;
}

std::string Options::help() const { return app_->help(); }

bool Options::read(const std::vector<std::string>& words) try {
  std::vector<std::string> reversed = joined(words);
  std::ranges::reverse(reversed);
  app_->parse(reversed);
  set_flags(words);
  refuse_unknown();
  return true;
} catch (const CLI::CallForHelp&) {
  return false;
} catch (const CLI::ParseError& e) {
  refuse_unknown();  // rather than report a missing argument
  throw UsageError(fmt::format("{}; see `{} --help`", what_is_wrong(*app_, e), app_->get_name()));
}

const Options::FlagWithWords* Options::find_flag(std::string_view name) const {
  const auto flag = std::ranges::find(flags_, name, &FlagWithWords::name);
  return flag == flags_.end() ? nullptr : &*flag;
}

std::vector<std::string> Options::joined(const std::vector<std::string>& words) const {
  std::vector<std::string> all;
  for (const std::string& word : words) {
    const FlagWithWords* flag = all.empty() ? nullptr : find_flag(all.back());
    if (flag && std::ranges::count(flag->words, word) > 0 && std::ranges::count(all, "--") == 0)
      all.back() += "=" + word;
    else
      all.push_back(word);
  }
  return all;
}

/// Gives flags without a word the first allowed word. Throws UsageError.
void Options::set_flags(const std::vector<std::string>& words) const {
  for (const FlagWithWords& flag : flags_) {
    if (app_->get_option(flag.name)->count() == 0) continue;
    if (*flag.target == "true") *flag.target = flag.words.front();
    if (std::ranges::count(flag.words, *flag.target) == 0)
      throw UsageError(unknown_name("value of " + flag.name, *flag.target, flag.words));
    const auto at = std::ranges::find(words, flag.name);
    const std::vector<std::string> rest = app_->remaining();
    if (at != words.end() && at + 1 != words.end() && !(at + 1)->starts_with('-') &&
        std::ranges::count(rest, *(at + 1)) > 0)
      throw UsageError(unknown_name("value of " + flag.name, *(at + 1), flag.words));
  }
}

/// Throws UsageError.
void Options::refuse_unknown() const {
  std::vector<std::string> rest = app_->remaining();
  std::erase(rest, "--");
  const auto dashed = [](const std::string& word) { return word.size() > 1 && word[0] == '-'; };
  const auto option = std::ranges::find_if(rest, dashed);
  if (option != rest.end()) {
    std::vector<std::string> names;
    for (const Option& o : all())
      if (!o.is_positional()) names.push_back(o.name());
    const std::string name = option->substr(0, option->find('='));
    if (std::ranges::find(names, name) != names.end())
      throw UsageError(
          fmt::format("'{}' follows '--', after which options are not allowed; put it before '--'", name));
    throw UsageError(unknown_name("option", name, names));
  }
  if (rest.empty()) return;
  const bool lacks_set = rest.front().find('=') != std::string::npos && app_->get_option_no_throw("--set");
  throw UsageError(fmt::format("'{}' is one argument too many; {}", rest.front(),
                               lacks_set ? "write --set before each NAME=VALUE" : "remove it"));
}

}  // namespace taut::cli
