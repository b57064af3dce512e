#include "cli/text/test_report.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/core.h>

#include "cli/text/json.hpp"

namespace taut::cli {
namespace {

using Result = TestCase::Result;

/// JSON replaces invalid bytes by U+FFFD.
std::string valid_utf8(const std::string& text) { return parse_json(Json(text).dump(), "text").text(); }

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char c : valid_utf8(text)) {
    if (c == '&' || c == '<' || c == '>' || c == '"' || c == '\t' || c == '\n' || c == '\r')
      escaped += fmt::format("&#{};", static_cast<int>(c));
    else if (c >= 0 && c < ' ')
      escaped += fmt::format("\\x{:02x}", static_cast<int>(c));
    else
      escaped += c;
  }
  for (const std::string_view not_a_character : {"\uFFFE", "\uFFFF"})
    escaped = replaced(escaped, not_a_character, "\uFFFD");
  return escaped;
}

std::string xml_time(std::optional<double> seconds) {
  return seconds ? fmt::format(" time=\"{:.3f}\"", *seconds) : "";
}

std::string xml_of(const TestCase& each, const std::string& command) {
  const std::string head = fmt::format("    <testcase classname=\"taut.{}\" name=\"{}\"{}", command,
                                       xml_text(each.name), xml_time(each.seconds));
  if (each.result == Result::passed) return head + "/>\n";
  const std::string element = each.result == Result::failed ? "failure" : "error", text = xml_text(each.text);
  return head + fmt::format(">\n      <{0} message=\"{1}\">{1}</{0}>\n    </testcase>\n", element, text);
}

std::string command_text(const std::string& text) {
  return replaced(replaced(replaced(text, "%", "%25"), "\r", "%0D"), "\n", "%0A");
}

std::string command_property(const std::string& text) {
  return replaced(replaced(command_text(text), ":", "%3A"), ",", "%2C");
}

}  // namespace

std::string junit_xml(const TestReport& report) {
  const auto& [command, subject, cases] = report;
  std::optional<double> seconds;
  std::string inside;
  for (const TestCase& each : cases) {
    if (each.seconds) seconds = seconds.value_or(0) + *each.seconds;
    inside += xml_of(each, command);
  }
  const auto number = [&cases = cases](Result result) {
    return std::ranges::count(cases, result, &TestCase::result);
  };
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\"{}>\n{}  </testsuite>\n"
      "</testsuites>\n",
      xml_text(fmt::format("taut {}: {}", command, subject)), cases.size(), number(Result::failed),
      number(Result::error), xml_time(seconds), inside);
}

std::string github_annotations(const TestReport& report) {
  std::string lines;
  int left = 10;
  for (const TestCase& each : report.cases)
    if (each.result != Result::passed && left-- > 0)
      lines += fmt::format("::error title={}::{}\n",
                           command_property(fmt::format("taut {}: {}", report.command, each.name)),
                           command_text(each.text));
  return lines;
}

}  // namespace taut::cli
