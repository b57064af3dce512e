#include "cli/session/session_completion.hpp"

#include <algorithm>
#include <sstream>

#include "cli/session/session_commands.hpp"

namespace taut::cli {
namespace {

using Words = std::vector<std::string>;

Words command_names() {
  Words names;
  for (const SessionCommand& command : session_commands()) names.emplace_back(command.name);
  return names;
}

/// "pan DX DY | fit" → {{pan, DX, DY}, {fit}}.
std::vector<Words> ways_to_use(std::string_view arguments) {
  std::string text(arguments);
  std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
  std::vector<Words> ways(1);
  std::istringstream stream(text);
  for (std::string word; stream >> word;) {
    if (word == "|")
      ways.emplace_back();
    else
      ways.back().push_back(word);
  }
  return ways;
}

/// Word or ""; a final "..." repeats the word before it.
std::string at(const Words& way, std::size_t place) {
  if (way.size() > 1 && way.back() == "...") place = std::min(place, way.size() - 2);
  return place < way.size() ? way[place] : "";
}

Choices choices_for(const std::string& placeholder, const Session& session) {
  if (placeholder == "COMMAND") return {command_names(), ""};
  if (placeholder != "CONSTANT=VALUE") return choices(placeholder, "", &session.file());
  Choices names{session.names_to_change(), ""};
  for (std::string& name : names.words) name += '=';
  return names;
}

}  // namespace

Choices session_choices(const Session& session, const Words& words) {
  if (words.size() < 2) return {command_names(), ""};
  const auto all = session_commands();
  const auto command = std::ranges::find(all, words.front(), &SessionCommand::name);
  if (command == all.end()) return {};
  Choices result;
  for (const Words& way : ways_to_use(command->arguments)) {
    const Choices here = choices_for(at(way, words.size() - 2), session);
    result.words.insert(result.words.end(), here.words.begin(), here.words.end());
    if (!here.files.empty()) result.files = here.files;
  }
  return result;
}

}  // namespace taut::cli
