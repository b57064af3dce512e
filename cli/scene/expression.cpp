#include "cli/scene/expression.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <muParser.h>

#include "cli/text/format.hpp"
#include "cli/text/shown.hpp"
#include "cli/text/suggest.hpp"

namespace taut::cli {
namespace {

struct Formula {
  mu::Parser parser;
  Names names;
  std::array<double, 4> variables{};
  std::mutex used;

  double value() const try { return parser.Eval(); } catch (const mu::ParserError& error) {
    throw ExpressionError(
        fmt::format("{} cannot be evaluated: {}", shown(parser.GetExpr()), shown(error.GetMsg())), 0);
  }
};

// limits of muParser
constexpr std::size_t longest_text = 20000, longest_name = 100;

std::string in_quotes(const std::string& text) { return fmt::format("'{}'", shown(text)); }

void check_length(const std::string& text, const Names& names) {
  const auto too_long = [](std::size_t length) { return length > longest_name; };
  std::size_t word = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool of_name = std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_';
    const bool begins = word > 0 || !std::isdigit(static_cast<unsigned char>(text[i]));
    word = of_name && begins ? word + 1 : 0;
    if (too_long(word))
      throw ExpressionError("a name has at most 100 letters; use a shorter name than " +
                                in_quotes(text.substr(i - word + 1, word)),
                            i - word + 1);
  }
  for (const auto& name : names)
    if (too_long(name.first.size()))
      throw ExpressionError(
          "a name has at most 100 letters; use a shorter name than " + in_quotes(name.first), 0);
  if (text.size() > longest_text)
    throw ExpressionError(
        fmt::format("{} has {} letters; at most {} are allowed", in_quotes(text), text.size(), longest_text),
        0);
}

std::vector<std::string> known_names(const Formula& formula) {
  std::vector<std::string> known;
  for (const auto& variable : formula.parser.GetVar()) known.push_back(variable.first);
  for (const auto& constant : formula.parser.GetConst()) known.push_back(constant.first);
  return known;
}

/// muParser would accept `a = 1`.
void refuse_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    if (i > 0 && std::string_view("<>!").find(text[i - 1]) != std::string_view::npos) continue;
    throw ExpressionError(
        fmt::format("'=' in {} is an assignment, which is not allowed; to compare, write '=='",
                    in_quotes(text)),
        i);
  }
}

struct Unit {
  std::string_view name;
  double factor;
};
/// Factors to SI units and degrees.
constexpr Unit units[] = {
    {"m", 1},       {"km", 1e3},       {"cm", 1e-2},    {"mm", 1e-3}, {"um", 1e-6},
    {"µm", 1e-6},   {"nm", 1e-9},      {"s", 1},        {"ms", 1e-3}, {"us", 1e-6},
    {"µs", 1e-6},   {"ns", 1e-9},      {"min", 60},     {"h", 3600},  {"Pa", 1},
    {"kPa", 1e3},   {"MPa", 1e6},      {"GPa", 1e9},    {"bar", 1e5}, {"psi", 6894.757293168},
    {"N", 1},       {"kN", 1e3},       {"MN", 1e6},     {"kg", 1},    {"g", 1e-3},
    {"t", 1e3},     {"Hz", 1},         {"kHz", 1e3},    {"MHz", 1e6}, {"m/s", 1},
    {"mm/s", 1e-3}, {"km/h", 1 / 3.6}, {"m/s²", 1},     {"m/s^2", 1}, {"kg/m³", 1},
    {"kg/m^3", 1},  {"g/cm³", 1e3},    {"g/cm^3", 1e3}, {"°", 1},     {"deg", 1},
};

/// Throws for values such as "10 MPa".
void refuse_unit(const std::string& text) {
  double value = 0;
  const char* const last = text.data() + text.size();
  const char* const first = text.data() + std::min(text.find_first_not_of(' '), text.size());
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc()) return;
  std::string_view rest(end, static_cast<std::size_t>(last - end));
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  while (rest.ends_with(' ')) rest.remove_suffix(1);
  const auto* unit = std::ranges::find(units, rest, &Unit::name);
  if (unit == std::end(units)) return;
  throw ExpressionError(fmt::format("{} has a unit; write the number alone, in SI units or degrees: {}",
                                    in_quotes(text), brief(value * unit->factor)),
                        static_cast<std::size_t>(rest.data() - text.data()));
}

void refuse_words(const std::string& text, const std::string& token) {
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"and", "&&"},  {"or", "||"},  {"AND", "&&"},  {"OR", "||"}, {"if", "CONDITION ? A : B"},
      {"pow", "A^B"}, {"true", "1"}, {"false", "0"}, {"**", "^"}};
  const std::string word = token.substr(0, token.find_first_of(" ("));
  for (const auto& [given, sign] : words)
    if (word == given)
      throw ExpressionError(
          fmt::format("{} is not an expression: instead of '{}', write '{}'", in_quotes(text), word, sign),
          std::min(text.find(word), text.size()));
  if (word == "not" || word == "!")
    throw ExpressionError(
        fmt::format("{} is not an expression: instead of '{}', write '== 0' after the condition",
                    in_quotes(text), word),
        std::min(text.find(word), text.size()));
}

[[noreturn]] void explain(const Formula& formula, const std::string& text, const mu::ParserError& error) {
  const std::size_t offset = error.GetPos() > 0 ? static_cast<std::size_t>(error.GetPos()) : 0;
  if (text.find("**") != std::string::npos) refuse_words(text, "**");
  if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN)
    throw ExpressionError(fmt::format("{} is not an expression: {}", in_quotes(text), shown(error.GetMsg())),
                          offset);
  const std::string& token = error.GetToken();
  refuse_words(text, token);
  if (const char first = token.empty() ? ' ' : token.front();
      !std::isalpha(static_cast<unsigned char>(first)) && first != '_')
    throw ExpressionError(
        fmt::format("{} is not an expression: {} was not expected", in_quotes(text), in_quotes(token)),
        offset);
  const std::vector<std::string> names = known_names(formula);
  std::vector<std::string> candidates = names;
  for (const std::string& function : function_names()) candidates.push_back(function);
  throw ExpressionError(
      fmt::format("unknown name {} in {}{}; known names: {} and functions such as sin and sqrt",
                  in_quotes(token), in_quotes(text), did_you_mean(token, candidates), join(names)),
      offset);
}

void define_pi(mu::Parser& parser) {
  parser.ClearConst();
  parser.DefineConst("pi", std::numbers::pi);
}

std::unique_ptr<Formula> parse(const std::string& text, const Names& names,
                               std::initializer_list<const char*> variables) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw ExpressionError("the expression is empty; write a number or an expression", 0);
  check_length(text, names);
  refuse_assignment(text);
  auto formula = std::make_unique<Formula>();
  formula->names = names;
  try {
    define_pi(formula->parser);
    for (auto& [name, value] : formula->names) formula->parser.DefineVar(name, &value);
    double* value = formula->variables.data();
    for (const char* variable : variables) formula->parser.DefineVar(variable, value++);
    formula->parser.SetExpr(text);
    formula->parser.Eval();
  } catch (const mu::ParserError& error) {
    refuse_unit(text);
    explain(*formula, text, error);
  }
  if (formula->parser.GetNumResults() != 1)
    throw ExpressionError(in_quotes(text) + " has several values; an expression must have one value", 0);
  return formula;
}

}  // namespace

double evaluate(const std::string& text, const Names& names) { return parse(text, names, {})->value(); }

Expression compile(const std::string& text, const Names& names) {
  return [formula = std::shared_ptr<Formula>(parse(text, names, {"x", "y", "z"}))](const Point& position) {
    const std::lock_guard alone(formula->used);
    std::ranges::copy(position, formula->variables.begin());
    return formula->value();
  };
}

Solution compile_in_time(const std::string& text, const Names& names) {
  return [formula = std::shared_ptr<Formula>(parse(text, names, {"x", "y", "z", "t"}))](const Point& position,
                                                                                        double t) {
    const std::lock_guard alone(formula->used);
    std::ranges::copy(position, formula->variables.begin());
    formula->variables.back() = t;
    return formula->value();
  };
}

std::function<double(double)> compile_of_time(const std::string& text, const Names& names) {
  return [formula = std::shared_ptr<Formula>(parse(text, names, {"t"}))](double t) {
    const std::lock_guard alone(formula->used);
    formula->variables[0] = t;
    return formula->value();
  };
}

std::function<double(const std::vector<double>&, double)> compile_of_values(
    const std::string& text, Names names, const std::vector<std::string>& values) {
  const auto of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  const auto is_variable = [&](const std::string& name) {
    return std::ranges::all_of(name, of_name) && !std::isdigit(static_cast<unsigned char>(name.front())) &&
           name != "pi" && name != "t";
  };
  for (const std::string& name : values)
    if (is_variable(name)) names[name] = 0;
  const std::shared_ptr<Formula> formula(parse(text, names, {"t"}));
  std::vector<std::pair<std::size_t, double*>> places;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (is_variable(values[k])) places.emplace_back(k, &formula->names[values[k]]);
  return [formula, places](const std::vector<double>& now, double t) {
    const std::lock_guard alone(formula->used);
    for (const auto& [k, place] : places) *place = now[k];
    formula->variables[0] = t;
    return formula->value();
  };
}

std::set<std::string> names_in(const std::string& text) {
  std::set<std::string> names;
  try {
    check_length(text, {});
    mu::Parser parser;
    define_pi(parser);
    parser.SetExpr(text);
    for (const auto& variable : parser.GetUsedVar()) names.insert(variable.first);
  } catch (const mu::ParserError&) {
    // evaluation reports the error
  } catch (const ExpressionError&) {
  }
  return names;
}

std::vector<std::string> function_names() {
  const mu::Parser parser;
  std::vector<std::string> names;
  for (const auto& function : parser.GetFunDef()) names.push_back(function.first);
  return names;
}

}  // namespace taut::cli
