#pragma once

#include <string_view>

/// Files of page/, embedded by page_files.cmake.
namespace taut::cli::page {

extern const std::string_view index_html, taut_css, taut_js;
extern const std::string_view chart_js;  // Chart.js, MIT licence, with its notice

}  // namespace taut::cli::page
