#include "cli/report/particle_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/core.h>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/staging.hpp"
#include "cli/report/base64.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/saved_run.hpp"
#include "cli/text/format.hpp"
#include "render/colormap.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

constexpr std::size_t most_particles = 2000000;  // summed over the times
constexpr int colors_of_key = 32;

struct Box {
  std::array<double, 3> low, high;

  explicit Box(const std::vector<StagedParticles>& all) {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const StagedParticles& particles : all)
      for (std::size_t k = 0; k < particles.x.size(); ++k) {
        if (!std::isfinite(particles.x[k])) continue;
        low[k % 3] = std::min(low[k % 3], particles.x[k]);
        high[k % 3] = std::max(high[k % 3], particles.x[k]);
      }
  }
  std::uint16_t part(double x, std::size_t axis) const {
    const double width = high[axis] - low[axis];
    const double share = width > 0 && std::isfinite(x) ? (x - low[axis]) / width : 0;
    return static_cast<std::uint16_t>(std::lround(65535 * share));
  }
};

render::Rgb color_of(double value, const render::Look& look) {
  if (!look.categories.empty()) return render::category_color(static_cast<std::size_t>(value));
  if (!std::isfinite(value)) return render::not_a_number_color;
  const double low = look.range->low, high = look.range->high, clamped = std::clamp(value, low, high);
  const double most = std::max(look.middle - low, high - look.middle);
  if (look.colormap->diverging && low < look.middle && look.middle < high)
    return look.colormap->at(0.5 + 0.5 * (clamped - look.middle) / most);
  return look.colormap->at(high > low ? (clamped - low) / (high - low) : 0.5);
}

/// All coordinates, little-endian, then all colours.
std::string bytes_of(const StagedParticles& particles, const Box& box, const render::Look& look) {
  std::string bytes;
  for (std::size_t k = 0; k < particles.x.size(); ++k) {
    const std::uint16_t part = box.part(particles.x[k], k % 3);
    bytes += static_cast<char>(part & 255);
    bytes += static_cast<char>(part >> 8);
  }
  for (const double value : particles.value)
    for (const std::uint8_t channel : color_of(value, look)) bytes += static_cast<char>(channel);
  return bytes;
}

std::string hex(render::Rgb color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

Json key_of(const Drawing& drawing) {
  const render::Look& look = drawing.look;
  const bool named = drawing.formula.empty();
  Json key{{"label", named ? std::string(drawing.field->name) : drawing.formula},
           {"unit", named ? std::string(drawing.field->unit) : ""}};
  Json colors = Json::array();
  if (!look.categories.empty()) {
    Json names = Json::array();
    for (std::size_t k = 0; k < look.categories.size(); ++k) {
      if (std::ranges::count(look.unlisted, static_cast<int>(k)) > 0) continue;
      names.add(look.categories[k]);
      colors.add(hex(render::category_color(k)));
    }
    key["names"] = names;
  } else {
    key["low"] = look.range->low;
    key["high"] = look.range->high;
    for (int k = 0; k < colors_of_key; ++k)
      colors.add(
          hex(color_of(std::lerp(look.range->low, look.range->high, k / (colors_of_key - 1.0)), look)));
  }
  key["colors"] = colors;
  return key;
}

Json vector_of(const std::array<double, 3>& vector) {
  Json list = Json::array();
  for (const double component : vector) list.add(component);
  return list;
}

}  // namespace

std::optional<Json> particle_data(const fs::path& run_folder) {
  const RunFolder folder(run_folder);
  std::error_code error;
  if (!fs::exists(folder.particle_file(0), error)) return std::nullopt;
  SavedRun run = open_saved_run(run_folder);
  if (run.file.scene.dim != 3) return std::nullopt;
  apply_scene(run.file.drawing, run.file);
  const Origins origins = origins_of(run.file.scene);
  const Staging staging(run.file.drawing, origins);
  const std::size_t particles = std::max<std::size_t>(staging.size(), 1);
  const std::size_t every = (run.particles.size() * particles + most_particles - 1) / most_particles;
  SequenceBounds bounds(run.file.drawing.look.camera);
  std::vector<StagedParticles> shown;
  Json times = Json::array();
  for (std::size_t k = 0; k < run.particles.size(); k += every) {
    const ColoredParticles read = read_colored(run.particles[k], run.file.drawing, origins);
    shown.push_back(staging(read.view()));
    staging.extend(bounds, shown.back());
    times.add(run.particles[k].time());
  }
  const Drawing drawing = fitted(run.file.drawing, bounds);
  const Box box(shown);
  Json data = Json::array();
  for (const StagedParticles& each : shown) data.add(base64(bytes_of(each, box, drawing.look)));
  const std::vector<double>& diameter = shown.front().diameter;
  return Json{{"times", times},
              {"every", every},
              {"particles", particles},
              {"diameter", diameter.empty() ? 0.0 : *std::ranges::max_element(diameter)},
              {"low", vector_of(box.low)},
              {"high", vector_of(box.high)},
              {"towards", vector_of(drawing.look.camera->from)},
              {"up", vector_of(drawing.look.camera->up)},
              {"key", key_of(drawing)},
              {"data", data}};
}

}  // namespace taut::cli
