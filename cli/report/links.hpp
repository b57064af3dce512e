#pragma once

#include <filesystem>
#include <string>

namespace taut::cli {

/// Addresses of the files that a page shows.
class Links {
 public:
  /// `page` is the folder of the page. With `embed`, pictures become data URIs.
  Links(const std::filesystem::path& page, bool embed);

  bool embeds() const { return embed_; }
  /// Relative to the page, percent-encoded. "/a/b/out/x" from the page in "/a/b/report" is "../out/x".
  std::string to(const std::filesystem::path& file) const;
  /// Address of a PNG file, or its content as a data URI. Throws UsageError if it cannot be read.
  std::string to_picture(const std::filesystem::path& file) const;

 private:
  std::filesystem::path page_;
  bool embed_;
};

}  // namespace taut::cli
