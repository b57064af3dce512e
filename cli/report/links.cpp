#include "cli/report/links.hpp"

#include <string_view>

#include <fmt/core.h>

#include "cli/report/base64.hpp"
#include "cli/report/webp.hpp"
#include "render/image/png.hpp"

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

}  // namespace

Links::Links(const fs::path& page, bool embed)
    : page_(fs::weakly_canonical(fs::absolute(page))), embed_(embed) {}

std::string Links::to(const fs::path& file) const {
  return percent_encoded(fs::weakly_canonical(fs::absolute(file)).lexically_relative(page_).generic_string());
}

std::string Links::to_picture(const fs::path& file) const {
  if (!embed_) return to(file);
  return "data:image/webp;base64," + base64(webp(render::read_png(file)));
}

}  // namespace taut::cli
