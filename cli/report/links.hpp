#pragma once

#include <filesystem>
#include <string>

namespace taut::cli {

class Links {
 public:
  /// `page`: folder. With `embed`, pictures become data URIs.
  Links(const std::filesystem::path& page, bool embed);

  bool embeds() const { return embed_; }
  const std::filesystem::path& page() const { return page_; }
  /// Relative and percent-encoded.
  std::string to(const std::filesystem::path& file) const;
  /// Throws UsageError for a picture that cannot be embedded.
  std::string to_picture(const std::filesystem::path& file) const;

 private:
  std::filesystem::path page_;
  bool embed_;
};

}  // namespace taut::cli
