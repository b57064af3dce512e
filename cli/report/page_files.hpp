#pragma once

#include <string_view>

/// Embedded by page_files.cmake: files of page/, with all scripts joined in `taut_js`.
namespace taut::cli::page {

extern const std::string_view index_html, taut_css, taut_js;
extern const std::string_view chart_js;  // Chart.js, MIT licence, with its notice

}  // namespace taut::cli::page
