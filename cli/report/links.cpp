#include "cli/report/links.hpp"

#include <string_view>

#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

std::string percent_encoded(std::string_view path) {
  constexpr std::string_view unreserved =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string address;
  for (const char c : path)
    if (unreserved.find(c) != std::string_view::npos)
      address += c;
    else
      address += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return address;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned group = 0;  // three bytes, four digits
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0u);
    for (std::size_t d = 0; d < 4; ++d)
      text += k + d > bytes.size() ? '=' : digits[group >> (18 - 6 * d) & 63u];
  }
  return text;
}

}  // namespace

Links::Links(const fs::path& page, bool embed)
    : page_(fs::weakly_canonical(fs::absolute(page))), embed_(embed) {}

std::string Links::to(const fs::path& file) const {
  return percent_encoded(fs::weakly_canonical(fs::absolute(file)).lexically_relative(page_).generic_string());
}

std::string Links::to_picture(const fs::path& file) const {
  if (!embed_) return to(file);
  const auto bytes = read_whole(file);
  if (!bytes) throw UsageError("cannot read the picture '" + file.string() + "'");
  return "data:image/png;base64," + base64(*bytes);
}

}  // namespace taut::cli
