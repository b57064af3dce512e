#include "cli/report/page.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "cli/report/page_files.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

constexpr std::string_view generator = "<meta name=\"generator\" content=\"taut report\">";

bool is_page(const fs::path& file) {
  const auto text = read_whole(file);
  return text && text->substr(0, 500).find(generator) != std::string::npos;
}

/// Escapes '<', so that no text ends the script element.
std::string script_text(const Json& json) {
  std::string text;
  for (const char c : json.dump())
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string report_script(const PageData& data) {
  return "globalThis.taut_report = " + script_text(data.report) +
         ";\n"
         "globalThis.taut_runs = globalThis.taut_runs || {};\n"
         "globalThis.taut_particles = globalThis.taut_particles || {};\n";
}

std::vector<std::pair<std::string, std::string>> run_scripts(const PageData& data) {
  std::vector<std::pair<std::string, std::string>> scripts;
  const auto add = [&](std::string name, const std::string& target, std::size_t run, const Json& value) {
    if (!value.is_null())
      scripts.emplace_back(std::move(name), "globalThis." + target + "[" + std::to_string(run) +
                                                "] = " + script_text(value) + ";\n");
  };
  for (std::size_t k = 0; k < data.runs.size(); ++k) add(run_script_name(k), "taut_runs", k, data.runs[k]);
  for (std::size_t k = 0; k < data.particles.size(); ++k)
    add(particle_script_name(k), "taut_particles", k, data.particles[k]);
  return scripts;
}

void replace(std::string& text, std::string_view old, const std::string& by) {
  text.replace(text.find(old), old.size(), by);
}

std::string script_element(std::string_view script) { return "<script>" + std::string(script) + "</script>"; }

}  // namespace

std::string run_script_name(std::size_t run) { return "runs/" + std::to_string(run) + ".js"; }
std::string particle_script_name(std::size_t run) { return "runs/" + std::to_string(run) + "-particles.js"; }

void check_page(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return;
  if (fs::is_directory(path, error)) {
    if (fs::is_empty(path, error) || is_page(path / "index.html")) return;
    throw UsageError(
        "'" + path.string() +
        "' contains files that are not from `taut report`; empty it or name another folder with --out");
  }
  if (!is_page(path))
    throw UsageError("'" + path.string() +
                     "' exists and is not a page of `taut report`; name another file with --out");
}

void begin_page(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "index.html", error)) return;
  make_folders(folder);
  write_atomically(
      folder / "index.html",
      fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n{}\n"
                  "<title>taut report</title>\n<p>This page is unfinished; repeat taut report.</p>\n",
                  generator));
}

void write_page(const fs::path& folder, const PageData& data) {
  begin_page(folder);
  make_folders(folder / "runs");
  const auto scripts = run_scripts(data);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "runs", error)) {
    const std::string name = "runs/" + entry.path().filename().string();
    const bool used = std::ranges::any_of(scripts, [&](const auto& script) { return script.first == name; });
    if (!used && entry.path().extension() == ".js") fs::remove(entry.path(), error);  // of an older page
  }
  write_atomically(folder / "taut.css", page::taut_css);
  write_atomically(folder / "taut.js", page::taut_js);
  write_atomically(folder / "chart.js", page::chart_js);
  for (const auto& [name, script] : scripts) write_atomically(folder / name, script);
  write_atomically(folder / "data.js", report_script(data));
  write_atomically(folder / "index.html", page::index_html);
}

void write_embedded_page(const fs::path& file, const PageData& data) {
  std::string scripts = report_script(data);
  for (const auto& [name, script] : run_scripts(data)) scripts += script;
  std::string html(page::index_html);
  replace(html, "<link rel=\"stylesheet\" href=\"taut.css\">",
          "<style>" + std::string(page::taut_css) + "</style>");
  replace(html, "<script src=\"chart.js\"></script>", script_element(page::chart_js));
  replace(html, "<script src=\"data.js\"></script>", script_element(scripts));
  replace(html, "<script src=\"taut.js\"></script>", script_element(page::taut_js));
  make_folder_of(file);
  write_atomically(file, html);
}

}  // namespace taut::cli
