#pragma once

#include <string_view>

/// The files of a page, from the folder page/ of this room; page_files.cmake writes their source.
namespace taut::cli::page {

extern const std::string_view index_html, taut_css, taut_js;
extern const std::string_view chart_js;  // Chart.js, MIT licence, with its notice

}  // namespace taut::cli::page
