#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "cli/formats/mask.hpp"
#include "cli/formats/mesh_file.hpp"
#include "cli/formats/particle_file.hpp"
#include "cli/scene/shape_readers.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/shapes/given_particles.hpp"
#include "engine/scene/shapes/mesh.hpp"
#include "engine/scene/shapes/polygon.hpp"

namespace taut::cli {
namespace {

struct Frame {
  double pixel = 0;             // m
  std::optional<Point> centre;  // m
  Point low{};                  // lower left corner, m
};

double read_size(TomlCursor& shape, double rows, double columns) {
  const TomlValue *height = shape.find("height"), *width = shape.find("width");
  if (height && width)
    shape.fail(*width, "width",
               "width and height are both given; remove one of them, because the file gives the ratio");
  if (!height && !width) shape.need("height");
  return height ? shape.number("height") / rows : shape.number("width") / columns;
}

void read_where(TomlCursor& shape, Frame& frame) {
  const TomlValue *low = shape.find("low"), *centre = shape.find("centre");
  if (low && centre) shape.fail(*low, "low", "low and centre are both given; remove one of them");
  if (!low && !centre) shape.need("centre");
  if (centre)
    frame.centre = shape.point("centre", 2);
  else
    frame.low = shape.point("low", 2);
}

Shape polygon_of(TomlCursor& shape, const Mask& mask, double threshold, const Frame& frame) {
  constexpr std::size_t most_points = 1000000;
  std::vector<Chain> contours = faces_of(mask, threshold);
  const TomlValue& file = shape.need("file");
  if (contours.empty())
    shape.fail(file, "file", "no part of the picture is inside the shape; check 'threshold' and 'inside'");
  std::size_t points = 0;
  for (Chain& contour : contours) {
    points += contour.size();
    for (Point& x : contour) {
      const Point half{0.5 * mask.columns, 0.5 * mask.rows, 0};
      for (std::size_t k = 0; k < 2; ++k)
        x[k] = frame.centre ? (x[k] - half[k]) * frame.pixel : frame.low[k] + x[k] * frame.pixel;
    }
  }
  if (points > most_points)
    shape.fail(file, "file",
               fmt::format("the outline has {} points; at most {} are allowed. Use a picture with less noise",
                           points, most_points));
  return Polygon(std::move(contours), frame.centre);
}

/// Reports a UsageError at the key `file`.
template <class Read>
auto with_place(TomlCursor& shape, const Read& read) {
  try {
    return read();
  } catch (const UsageError& error) {
    shape.fail(shape.need("file"), "file", error.what());
  }
}

struct GivenSites {
  std::vector<Point> places;    // m
  std::vector<double> volumes;  // m², in 3D m³
  bool has_volumes = true;      // false: dp^dim
};

GivenSites tabled_sites(const std::filesystem::path& file, const ShapeSetting& setting) {
  const std::vector<std::string> axes(axis_names.begin(), axis_names.begin() + setting.dim);
  const ColumnTable table = read_columns(file, axes, {"volume"});
  GivenSites given{std::vector<Point>(table.rows()), table.columns.back()};
  given.has_volumes = !given.volumes.empty();
  for (std::size_t i = 0; i < given.places.size(); ++i)
    for (std::size_t k = 0; k < axes.size(); ++k) given.places[i][k] = table.columns[k][i];
  given.volumes.resize(given.places.size(), std::pow(setting.dp, setting.dim));
  for (std::size_t i = 0; i < given.volumes.size(); ++i)
    if (!(given.volumes[i] > 0))
      throw SceneError(file.string(), table.lines[i], 1, "",
                       fmt::format("volume = {} must be greater than 0", exact(given.volumes[i])));
  return given;
}

/// Throws UsageError.
GivenSites saved_sites(const std::filesystem::path& path, std::optional<int> wanted,
                       const ShapeSetting& setting) {
  const ParticleFile file(path);
  const std::vector<double> x = file.positions(3), body = file.field("body"), diameter = file.diameter();
  if (const auto bad = std::ranges::find_if(x, [](double v) { return !std::isfinite(v); }); bad != x.end())
    throw UsageError(fmt::format("particle {} of {} has the coordinate {}; coordinates must be finite",
                                 (bad - x.begin()) / 3 + 1, path.string(), *bad));
  GivenSites given;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (wanted && body[i] != *wanted) continue;
    if (setting.dim == 2 && x[3 * i + 2] != 0)
      throw UsageError(fmt::format(
          "{} is a file of a scene with dim = 3, but this scene has dim = 2; use a file with dim = 2",
          path.string()));
    if (!(diameter[i] > 0 && std::isfinite(diameter[i])))
      throw UsageError(
          fmt::format("particle {} of {} has a diameter of {:g}; it must be finite and greater than 0", i + 1,
                      path.string(), diameter[i]));
    given.places.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    given.volumes.push_back(std::pow(diameter[i], setting.dim));
  }
  if (given.places.empty())
    throw UsageError(
        fmt::format("{} contains no particle{}", path.string(),
                    wanted ? fmt::format(" of body {}; bodies are numbered from 0", *wanted) : ""));
  return given;
}

void refuse_far(const GivenSites& given, const std::filesystem::path& file, const ShapeSetting& setting) {
  constexpr double most_sides = 1e6, farthest = 1e9, max_volume_ratio = 1e6;  // lengths in dp
  const double cell = std::pow(setting.dp, setting.dim);
  double room = 1;
  // cell numbers are limited
  for (std::size_t k = 0; k < static_cast<std::size_t>(setting.dim); ++k) {
    const auto [low, high] = std::ranges::minmax(given.places, {}, [k](const Point& x) { return x[k]; });
    const double side = (high[k] - low[k]) / setting.dp + 1;
    room *= side;
    if (side > most_sides || std::max(-low[k], high[k]) > farthest * setting.dp ||
        (setting.dim == 2 && room > greatest_particle_number))
      throw SceneError(
          file.string(), 0, 0, "",
          fmt::format("the particles are too far apart, or too far from the origin, for a spacing of {:g} m: "
                      "{} goes from {:g} m to {:g} m; check the units",
                      setting.dp, axis_names[k], low[k], high[k]));
  }
  for (const double volume : given.volumes)
    if (volume > max_volume_ratio * cell || volume * max_volume_ratio < cell)
      throw SceneError(
          file.string(), 0, 0, "",
          fmt::format(
              "a volume of {:g} does not fit a spacing of {:g} m, whose cell has {:g}; check the units",
              volume, setting.dp, cell));
}

void refuse_other_spacing(std::vector<double> volumes, const std::filesystem::path& file,
                          const ShapeSetting& setting) {
  const auto middle = volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() / 2);
  std::ranges::nth_element(volumes, middle);
  const double apart = std::pow(*middle, 1.0 / setting.dim);
  if (apart > 2 * setting.dp || setting.dp > 2 * apart)
    throw SceneError(file.string(), 0, 0, "",
                     fmt::format("its particles are about {:.3g} m apart, by their volumes; "
                                 "the scene's spacing of {:g} m must be between half and twice this distance",
                                 apart, setting.dp));
}

void refuse_twins(const std::vector<Point>& places, const std::filesystem::path& file) {
  std::vector<std::size_t> order(places.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return places[i]; });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (places[order[k]] == places[order[k - 1]])
      throw SceneError(
          file.string(), 0, 0, "",
          fmt::format("particles {} and {} are at the same place, ({:g}, {:g}, {:g}) m; remove one of them",
                      std::min(order[k], order[k - 1]) + 1, std::max(order[k], order[k - 1]) + 1,
                      places[order[k]][0], places[order[k]][1], places[order[k]][2]));
}

/// Median distance of at most 1000 particles from their nearest particle, m.
double usual_distance(std::vector<Point> places) {
  constexpr std::size_t asked = 1000;
  std::size_t longest = 0;  // axis of largest extent
  double length = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::ranges::minmax(places, {}, [k](const Point& x) { return x[k]; });
    if (high[k] - low[k] > length) longest = k, length = high[k] - low[k];
  }
  std::ranges::sort(places, {}, [longest](const Point& x) { return x[longest]; });
  std::vector<double> nearest;
  const auto look = [&](const Point& a, const Point& b, double& squared) {
    const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2], along = b[longest] - a[longest];
    squared = std::min(squared, x * x + y * y + z * z);
    return along * along < squared;
  };
  for (std::size_t k = 0; k < places.size(); k += 1 + places.size() / asked) {
    double squared = std::numeric_limits<double>::infinity();
    for (std::size_t other = k + 1; other < places.size() && look(places[k], places[other], squared);
         ++other) {
    }
    for (std::size_t other = k; other > 0 && look(places[k], places[other - 1], squared); --other) {
    }
    nearest.push_back(std::sqrt(squared));
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::ranges::nth_element(nearest, middle);
  return *middle;
}

/// Distances are 1 to 1.12 dp in lattices, down to 0.75 dp in disordered particles.
void refuse_other_mass(double apart, const std::filesystem::path& file, const ShapeSetting& setting) {
  if (std::isfinite(apart) && (apart < 0.7 * setting.dp || apart > 1.3 * setting.dp))
    throw SceneError(
        file.string(), 0, 0, "",
        fmt::format("its particles are about {:.3g} m apart, but the scene's spacing is {:g} m: "
                    "without a column volume, each particle would get the mass of a cell of that spacing. "
                    "Add a column volume, or choose a spacing that fits",
                    apart, setting.dp));
}

}  // namespace

Shape read_svg(TomlCursor& shape, const ShapeSetting& setting) {
  constexpr double finely = 16;  // pixels per spacing
  constexpr int fewest = 64, first_look = 1024;
  constexpr std::uintmax_t most_bytes = 4 << 20;
  const std::filesystem::path file = named_file(shape, setting.folder, "file");
  std::error_code error;
  if (std::filesystem::file_size(file, error) > most_bytes)
    shape.fail(shape.need("file"), "file",
               "the SVG file is larger than 4 MiB, the limit for outlines; simplify it");
  Frame frame;
  read_where(shape, frame);
  const auto painted = [&](int rows) { return with_place(shape, [&] { return paint_svg(file, rows); }); };
  Mask mask;
  double height = 0;
  if (shape.find("height")) {
    height = read_size(shape, 1, 1);
  } else {
    mask = painted(first_look);
    height = read_size(shape, 1, static_cast<double>(mask.columns) / mask.rows);
  }
  const double rows = std::ceil(finely * height / setting.dp);
  mask = painted(static_cast<int>(std::clamp<double>(rows, fewest, greatest_mask_side)));
  frame.pixel = read_size(shape, mask.rows, mask.columns);
  return polygon_of(shape, mask, 0.5, frame);
}

Shape read_mask_file(TomlCursor& shape, const ShapeSetting& setting) {
  const std::filesystem::path file = named_file(shape, setting.folder, "file");
  Frame frame;
  read_where(shape, frame);
  const double threshold = shape.number("threshold");
  const bool light = shape.choice("inside") == "light";
  Mask mask = with_place(shape, [&] { return read_mask(file, MaskOf::darkness); });
  if (light)
    for (float& solid : mask.solid) solid = 1 - solid;
  frame.pixel = read_size(shape, mask.rows, mask.columns);
  return polygon_of(shape, mask, light ? 1 - threshold : threshold, frame);
}

Shape read_mesh_file(TomlCursor& shape, const ShapeSetting& setting) {
  const std::filesystem::path file = named_file(shape, setting.folder, "file");
  const double scale = shape.find("scale") ? shape.number("scale") : 1;
  Triangles mesh = with_place(shape, [&] { return read_mesh(file); });
  for (Point& x : mesh.points)
    for (double& component : x) component *= scale;
  Mesh body(std::move(mesh));
  if (!shape.find("centre")) return body;
  const Point centre = shape.point("centre", 3), middle = body.middle();
  for (std::size_t k = 0; k < 3; ++k) body.shift(k, centre[k] - middle[k]);
  return body;
}

Shape read_particles(TomlCursor& shape, const ShapeSetting& setting) {
  const std::filesystem::path file = named_file(shape, setting.folder, "file");
  const bool saved = file.extension() == ".vtp";
  if (const TomlValue* body = shape.find("of_body"); body && !saved)
    shape.fail(*body, "of_body",
               "of_body needs a .vtp file, which holds the particles of a run; remove it for other files");
  if (!setting.alone)
    shape.fail(shape.need("type"), "type",
               "a shape of type \"particles\" must be the only shape of its body; "
               "it cannot be combined with other shapes or have cut-outs");
  std::optional<int> body;
  if (shape.find("of_body")) body = shape.whole("of_body");
  GivenSites given = saved ? with_place(shape, [&] { return saved_sites(file, body, setting); })
                           : tabled_sites(file, setting);
  refuse_far(given, file, setting);
  refuse_other_spacing(given.volumes, file, setting);
  refuse_twins(given.places, file);
  if (!given.has_volumes) refuse_other_mass(usual_distance(given.places), file, setting);
  return GivenParticles(std::move(given.places), std::move(given.volumes), setting.dim);
}

}  // namespace taut::cli
