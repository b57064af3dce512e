#include "render/page/ticks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace taut::render {
namespace {

constexpr int least_prefix = -15;
constexpr std::array<std::string_view, 10> prefixes = {"f", "p", "n", "µ", "m", "", "k", "M", "G", "T"};
constexpr int greatest_prefix = 12;

int decade(double value) { return static_cast<int>(std::floor(std::log10(value) + 1e-9)); }

int floor_to_three(int exponent) {
  return 3 * static_cast<int>(std::floor(static_cast<double>(exponent) / 3.0));
}

/// False for powers, such as m², whose prefix would be squared, and for kg.
bool takes_prefix(std::string_view unit) {
  constexpr std::array<std::string_view, 7> symbols = {"Pa", "m", "s", "N", "J", "W", "Hz"};
  return std::ranges::any_of(symbols, [&](std::string_view symbol) {
    if (!unit.starts_with(symbol)) return false;
    const std::string_view rest = unit.substr(symbol.size());
    return rest.empty() || rest.starts_with("/") || rest.starts_with("·") || rest.starts_with(" ");
  });
}

std::string power_of_ten(int exponent) {
  constexpr std::array<std::string_view, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

/// Rounds `length` > 0 up to 1, 2 or 5 × 10ⁿ.
double nice_step(double length) {
  const double power = std::pow(10.0, decade(length));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= length * (1 - 1e-9)) return digit * power;
  }
  return 10 * power;
}

}  // namespace

Scale scale_for(double greatest, std::string_view unit) {
  greatest = std::abs(greatest);
  if (!(greatest > 0) || !std::isfinite(greatest)) return {1, std::string(unit)};
  int exponent = floor_to_three(decade(greatest));
  if (takes_prefix(unit)) {
    exponent = std::clamp(exponent, least_prefix, unit == "s" ? 0 : greatest_prefix);
    const auto index = static_cast<std::size_t>((exponent - least_prefix) / 3);
    return {std::pow(10.0, -exponent), std::string(prefixes[index]) + std::string(unit)};
  }
  if (greatest >= 0.01 && greatest < 1e4) return {1, std::string(unit)};
  const std::string power = power_of_ten(exponent);
  return {std::pow(10.0, -exponent), unit.empty() ? power : power + " " + std::string(unit)};
}

namespace {

struct Multiples {
  double step, first, last;
  Multiples(double step_, double low, double high)
      : step(step_), first(std::ceil(low / step - 1e-6)), last(std::floor(high / step + 1e-6)) {}
  double count() const { return last - first + 1; }
};

/// Decimal exponent of the last digit.
int last_digit(double value, int decimals, bool scientific) {
  return (scientific && value != 0 ? decade(std::abs(value)) : 0) - decimals;
}

bool is_exact(const Multiples& ticks, int decimals, bool scientific) {
  for (double k = ticks.first; k <= ticks.last; ++k) {
    const double digits = k * ticks.step / std::pow(10.0, last_digit(k * ticks.step, decimals, scientific));
    if (std::abs(digits - std::round(digits)) > 1e-6 * std::max(1.0, std::abs(digits))) return false;
  }
  return true;
}

std::string format_scientific(double value, int decimals) {
  if (value == 0) return "0";
  const int exponent = decade(std::abs(value));
  return format_fixed(value / std::pow(10.0, exponent), decimals) + "×" + power_of_ten(exponent);
}

}  // namespace

Ticks nice_ticks(double low, double high, std::string_view unit, int most, const NumberFormat& format) {
  const Scale scale = format.scientific ? Scale{1, std::string(unit)}
                                        : scale_for(std::max(std::abs(low), std::abs(high)), unit);
  Ticks ticks{{}, scale.unit};
  const double from = low * scale.factor;
  const double to = high * scale.factor;
  if (!(to > from) || !std::isfinite(to - from)) return ticks;
  Multiples all(nice_step((to - from) / (most + 1)), from, to);
  while (all.count() > most) all = {nice_step(all.step * 1.01), from, to};
  int decimals = std::clamp(format.scientific ? 0 : -decade(all.step), 0, 9);
  if (format.decimals) {
    decimals = *format.decimals;
    for (Multiples wider = all; wider.count() >= 2; wider = {nice_step(wider.step * 1.01), from, to})
      if (is_exact(wider, decimals, format.scientific)) {
        all = wider;
        break;
      }
    while (decimals < 9 && !is_exact(all, decimals, format.scientific)) ++decimals;
  }
  for (double k = all.first; k <= all.last; ++k) {
    const double value = k * all.step;
    ticks.at.push_back({value / scale.factor, format.scientific ? format_scientific(value, decimals)
                                                                : format_fixed(value, decimals)});
  }
  return ticks;
}

double nice_length(double length) {
  const double power = std::pow(10.0, decade(length));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= length * (1 + 1e-9)) return digit * power;
  }
  return power;
}

std::string format_fixed(double value, int decimals) {
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.*f", decimals, std::abs(value));
  const bool zero = std::string_view(digits).find_first_not_of("0.") == std::string_view::npos;
  return value < 0 && !zero ? std::string("−") + digits : digits;
}

std::string format_time(double t, double until) {
  const double greatest = until > 0 ? until : t;
  const Scale scale = greatest == 0 ? Scale{1, "s"} : scale_for(greatest, "s");
  return "t = " + format_fixed(t * scale.factor, 3) + " " + scale.unit;
}

}  // namespace taut::render
