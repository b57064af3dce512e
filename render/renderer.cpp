#include "render/renderer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "engine/error.hpp"
#include "render/coloring.hpp"
#include "render/disc_painter.hpp"
#include "render/gl/gl_context.hpp"
#include "render/gl/solid_painter.hpp"
#include "render/page/segments.hpp"
#include "render/page/wall_line.hpp"
#include "render/solids.hpp"

namespace taut::render {
namespace {

void check_size(const Size& size) {
  const auto in_bounds = [](int side) { return side >= least_size && side <= greatest_size; };
  if (!in_bounds(size.width) || !in_bounds(size.height)) {
    throw UsageError(fmt::format("size {}x{} is out of bounds; width and height must be from {} to {}",
                                 size.width, size.height, least_size, greatest_size));
  }
}

void check_view(const View& view) {
  const double width = view.x_max - view.x_min;
  const double height = view.y_max - view.y_min;
  if (!(width > 0) || !(height > 0) || !std::isfinite(width) || !std::isfinite(height)) {
    throw UsageError("the view is empty or not finite; it needs x_min < x_max and y_min < y_max");
  }
}

void check_camera(const Camera& camera) {
  for (const auto& [name, way] : {std::pair("direction", camera.from), std::pair("up", camera.up)}) {
    const double square = dot(way, way);
    if (!(square > 0) || !std::isfinite(square))
      throw UsageError(fmt::format("the camera's {} {:g}:{:g}:{:g} has no length, or is not finite", name,
                                   way[0], way[1], way[2]));
  }
  if (!(camera.field_of_view >= 0 && camera.field_of_view <= greatest_field_of_view))
    throw UsageError(
        fmt::format("the field of view {:g} is out of bounds; it must be from 0 (parallel) to {} degrees",
                    camera.field_of_view, greatest_field_of_view));
}

void check_glyph(double glyph) {
  if (!(glyph >= least_glyph && glyph <= greatest_glyph))
    throw UsageError(fmt::format("the glyph size {:g} is out of bounds; it must be from {} to {} diameters",
                                 glyph, least_glyph, greatest_glyph));
}

void check_range(const Range& range) {
  if (!(range.low <= range.high) || !std::isfinite(range.high - range.low)) {
    throw UsageError(fmt::format("the range {:g}:{:g} is reversed or not finite; write LO:HI with LO < HI",
                                 range.low, range.high));
  }
}

void check_room(const Look& look) {
  const Rect plot =
      make_layout(look.size->width, look.size->height, *look.view, true, room_of_bar, look.texts).plot;
  constexpr int least = 16;  // pixels
  if (plot.width < least || plot.height < least)
    throw UsageError(
        fmt::format("texts of {:.0f} pixels leave no room in a picture of {}x{}; "
                    "use a smaller font, a larger picture or fewer texts",
                    look.texts.font, look.size->width, look.size->height));
}

Look checked(const Look& look) {
  const bool counts = !look.categories.empty();
  if (!look.size || !look.view || (!look.range && !counts))
    throw std::logic_error("size, view and range must be set before drawing");
  check_size(*look.size);
  check_view(*look.view);
  check_glyph(look.glyph);
  if (!counts) check_range(*look.range);
  if (look.camera) check_camera(*look.camera);
  if (!counts && !look.colormap)
    throw UsageError("no colour map is given; choose one from `taut list colormaps`");
  if (!look.bare && look.texts.font > 0) check_room(look);
  return look;
}

double width_of(const ColorKey& key, const Look& look) {
  const TextSize size = text_size(look.size->width, look.size->height, look.texts);
  return size.font > 0 ? key.width(size.key_height, size.font, look.unit) : 0;
}

/// Bytes R, G, B, 255.
std::uint32_t line_color(Rgb background) {
  constexpr double contrast = 0.4;
  const double most = is_light(background) ? 0 : 255;
  std::array<std::uint8_t, 4> bytes{0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k)
    bytes[k] = static_cast<std::uint8_t>(std::lround(std::lerp(background[k], most, contrast)));
  return std::bit_cast<std::uint32_t>(bytes);
}

}  // namespace

struct Renderer::Parts {
  Coloring coloring;
  double key_width;  // em
  PageTexts texts;
  PageLayout layout;
  Image image;
  std::optional<Projection> projection;
  std::optional<DiscPainter> disc_painter;
  std::optional<GlContext> context;
  std::optional<SolidPainter> solid_painter;  // also for cells and surfaces in 2D
  std::optional<Annotation> annotation;
  std::optional<Canvas> canvas;
  Rgb background;
  bool transparent, bare;
  double glyph;
  std::vector<Dot> discs;
  Solids solids;
  OffScale off_scale;

  Parts(const Look& look, double until);
  void check(const FrameView& frame) const;
  void place_discs(const FrameView& frame);
  bool has_lines(const FrameView& frame) const;
  void draw_lines(const FrameView& frame);
  void draw_discs(const FrameView& frame);
  std::vector<float> places_of(const FrameView& frame) const;
  void draw_solids(const FrameView& frame);
};

Renderer::Parts::Parts(const Look& look, double until)
    : coloring(look),
      key_width(width_of(coloring.key(), look)),
      texts(look.texts),
      layout(make_layout(look.size->width, look.size->height, *look.view, !look.bare, key_width, look.texts)),
      image(look.size->width, look.size->height),
      background(look.background),
      transparent(look.transparent),
      bare(look.bare),
      glyph(look.glyph),
      solids(layout, glyph) {
  image.transparent = transparent;
  if (look.camera) projection.emplace(*look.camera, *look.view);
  if (layout.font > 0) annotation.emplace(image, layout, coloring.key(), until, background, texts);
  if (annotation && look.camera) {
    annotation->show(marker_of(*look.camera));
    if (look.camera->field_of_view > 0) annotation->hide_scale_bar();
  }
}

void Renderer::Parts::check(const FrameView& frame) const {
  const std::size_t dim = projection ? 3 : 2, n = frame.value.size();
  if (static_cast<std::size_t>(frame.dim) != dim)
    throw std::logic_error("a scene in 3D needs a camera; a scene in 2D cannot have one");
  if (frame.x.size() != dim * n || frame.diameter.size() != n ||
      (!frame.cell.empty() && frame.cell.size() != dim * dim * n) || frame.triangle.size() % 3 != 0 ||
      std::ranges::any_of(frame.triangle, [n](std::uint32_t point) { return point >= n; })) {
    throw std::logic_error("the arrays of a frame differ in length, or its triangles are incomplete");
  }
}

void Renderer::Parts::place_discs(const FrameView& frame) {
  const double width = layout.plot.width;
  const double height = layout.plot.height;
  discs.clear();
  discs.reserve(frame.value.size());
  off_scale = {};
  for (std::size_t i = 0; i < frame.value.size(); ++i) {
    // float could not separate particles far from the origin
    const double x = layout.column(frame.x[2 * i]);
    const double y = layout.row(frame.x[2 * i + 1]);
    const double size = 0.5 * glyph * frame.diameter[i] * layout.pixels_per_metre;
    const double radius = drawn_radius(size);
    const double reach = radius + 1;
    // false for NaN
    const bool seen = size > 0 && std::isfinite(size) && x > -reach && x < width + reach && y > -reach &&
                      y < height + reach;
    if (!seen) continue;
    off_scale |= coloring.off_scale(frame.value[i]);
    discs.push_back(
        {static_cast<float>(x), static_cast<float>(y), static_cast<float>(radius), coloring(frame.value[i])});
  }
}

Renderer::Renderer(const Look& look, double until) : parts_(std::make_unique<Parts>(checked(look), until)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

bool Renderer::Parts::has_lines(const FrameView& frame) const {
  return !frame.walls.empty() || !frame.outline.empty() || !frame.undeformed.empty();
}

void Renderer::Parts::draw_lines(const FrameView& frame) {
  if (!has_lines(frame)) return;
  constexpr double em_of_height = 0.022;  // without text
  const double em = layout.font > 0 ? layout.font : std::max(6.0, em_of_height * layout.plot.height);
  if (!canvas) canvas.emplace(image, background);
  canvas->begin();
  draw_segments(*canvas, layout, frame.undeformed, Stroke::thin, em);
  draw_segments(*canvas, layout, frame.outline, Stroke::bold, em);
  for (const WallFace& wall : frame.walls)
    draw_wall_line(*canvas, layout.plot, layout.plot.x + layout.column(wall.at[0]),
                   layout.plot.y + layout.row(wall.at[1]), wall.normal[0], -wall.normal[1], em);
  canvas->end();
}

/// Keeps the page of the previous frame if both frames have only discs and the same field.
void Renderer::Parts::draw_discs(const FrameView& frame) {
  const bool page_stands =
      disc_painter && !has_lines(frame) && (!annotation || annotation->is_current_for(frame));
  if (!page_stands) {
    image.fill(background);
    disc_painter.emplace(layout.plot, background, transparent);
  }
  place_discs(frame);
  disc_painter->draw(image, discs);
  draw_lines(frame);
  if (has_lines(frame)) disc_painter.reset();
  if (!annotation) return;
  page_stands ? annotation->draw_again(frame, off_scale) : annotation->draw(frame, off_scale);
}

std::vector<float> Renderer::Parts::places_of(const FrameView& frame) const {
  std::vector<float> places(frame.value.size());
  std::ranges::transform(frame.value, places.begin(), [this](double value) { return coloring.place(value); });
  return places;
}

void Renderer::Parts::draw_solids(const FrameView& frame) {
  std::vector<std::uint32_t> color(frame.value.size());
  std::ranges::transform(frame.value, color.begin(), [this](double value) { return coloring(value); });
  std::vector<std::uint32_t> palette;
  if (!frame.triangle.empty()) {
    palette = coloring.palette();
    solids.place_surface(frame, projection ? &*projection : nullptr, places_of(frame), color,
                         coloring.has_categories());
  } else if (!projection)
    solids.place_parallelograms(frame, color);
  else if (frame.cell.empty())
    solids.place_balls(frame, *projection, color);
  else
    solids.place_boxes(frame, *projection, color);
  off_scale = {};
  for (const std::size_t i : solids.placed()) off_scale |= coloring.off_scale(frame.value[i]);
  if (projection) solids.place_walls(frame, *projection, line_color(background));
  disc_painter.reset();
  if (!context) context.emplace(image.width, image.height);
  {
    const GlContext::Current current(*context, image);
    if (!solid_painter)
      solid_painter.emplace(image.width, image.height, layout.plot, background, transparent);
    solid_painter->draw(current.framebuffer(), {solids.balls(), solids.corners(), solids.surface(), palette});
  }
  if (!projection) draw_lines(frame);
  if (annotation) annotation->draw(frame, off_scale);
}

void Renderer::look_from(const Camera& camera, const View& view) {
  check_camera(camera);
  Parts& parts = *parts_;
  parts.layout = make_layout(parts.image.width, parts.image.height, view, parts.layout.font > 0,
                             parts.key_width, parts.texts);
  parts.projection.emplace(camera, view);
  parts.solids = Solids(parts.layout, parts.glyph);
  if (parts.annotation) parts.annotation->show(marker_of(camera));
}

const OffScale& Renderer::off_scale() const { return parts_->off_scale; }

std::set<std::string> Renderer::cut_texts() const {
  if (parts_->annotation) return parts_->annotation->cut_texts();
  return parts_->bare ? std::set<std::string>{} : std::set<std::string>{"any text"};
}

const Image& Renderer::draw(const FrameView& frame) {
  Parts& parts = *parts_;
  parts.check(frame);
  if (parts.projection || !frame.cell.empty() || !frame.triangle.empty())
    parts.draw_solids(frame);
  else
    parts.draw_discs(frame);
  return parts.image;
}

}  // namespace taut::render
