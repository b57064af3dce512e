#include "render/panel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/error.hpp"
#include "render/coloring.hpp"
#include "render/page/annotation.hpp"
#include "render/page/axes_marker.hpp"
#include "render/page/canvas.hpp"
#include "render/page/scales.hpp"
#include "render/renderer.hpp"

namespace taut::render {
namespace {

// Lengths in em.
constexpr double margin = 1.1;
constexpr double title_height = 2.6;
constexpr double heading_height = 1.75;
constexpr double note_height = 1.3;
constexpr double row_label = 1.7;
constexpr double gap = 0.7;
constexpr double key_margin = 0.55;
constexpr double footer = 2.3;
constexpr double least_bar = 13;
constexpr double note_size = 0.94;
constexpr double corner_gap = 0.4;
constexpr double frame_gray = 0.85;

// default, pixels
constexpr double own_font = 16;
constexpr double most_grid_width = 1440, most_grid_height = 1080, most_cell = 540;

int pixels(double length) { return static_cast<int>(std::lround(length)); }

struct Grid {
  double em = own_font;
  int columns = 0, rows = 0;
  int left = 0, top = 0, right = 0, bottom = 0;
  int gap_size = 0;
  int cell_width = 0, cell_height = 0;

  Rect cell(int column, int row) const {
    return {left + column * (cell_width + gap_size), top + row * (cell_height + gap_size), cell_width,
            cell_height};
  }
  int grid_width() const { return columns * cell_width + (columns - 1) * gap_size; }
  int grid_height() const { return rows * cell_height + (rows - 1) * gap_size; }
};

/// Margins of a grid without cells; no texts if bare.
Grid empty_grid(const PanelOptions& options, double em) {
  Grid grid;
  grid.em = em;
  grid.columns = static_cast<int>(options.columns.size());
  grid.rows = static_cast<int>(options.rows.size());
  grid.gap_size = pixels(gap * em);
  if (options.look.bare) {
    grid.left = grid.top = grid.right = grid.bottom = grid.gap_size;
    return grid;
  }
  const bool notes = std::ranges::any_of(options.columns, [](const Heading& h) { return !h.note.empty(); });
  const TextParts& parts = options.look.texts.parts;
  const bool title = (parts.title && !options.title.empty()) || (parts.method && !options.note.empty());
  grid.left = pixels((margin + (parts.time ? row_label : 0)) * em);
  grid.top = pixels((0.4 + (title ? title_height : 0) + heading_height + (notes ? note_height : 0)) * em);
  grid.bottom = pixels((parts.scale ? footer : margin) * em);
  return grid;
}

double key_width(const PanelOptions& options, const Grid& grid) {
  return Coloring(options.look).key().width(grid.grid_height(), grid.em, options.unit);
}

void make_room_for_key(Grid& grid, const PanelOptions& options) {
  if (options.look.bare) return;
  if (!options.look.texts.parts.bar) {
    grid.right = pixels(margin * grid.em);
    return;
  }
  grid.right = pixels((margin + key_width(options, grid) + key_margin + 0.15) * grid.em);
}

double font_or(const PanelOptions& options, double by_default) {
  return options.look.texts.font > 0 ? options.look.texts.font : by_default;
}

/// Keeps the aspect ratio. The key's width depends on the height, a little.
Grid grid_of_width(const PanelOptions& options) {
  Grid grid = empty_grid(options, font_or(options, own_font));
  const View view = options.look.view.value();
  const double aspect = (view.y_max - view.y_min) / (view.x_max - view.x_min);
  grid.cell_height = pixels(aspect * options.width / grid.columns);
  for (int pass = 0; pass < 2; ++pass) {
    make_room_for_key(grid, options);
    grid.cell_width =
        (options.width - grid.left - grid.right - (grid.columns - 1) * grid.gap_size) / grid.columns;
    grid.cell_height = pixels(grid.cell_width * aspect);
  }
  if (grid.cell_width < least_size || grid.cell_height < least_size)
    throw UsageError("a panel " + std::to_string(options.width) + " pixels wide has no room for " +
                     std::to_string(grid.columns) + " columns of pictures; use a larger --width or --dpi");
  return grid;
}

Grid own_grid(const PanelOptions& options) {
  if (options.width > 0) return grid_of_width(options);
  Grid grid = empty_grid(options, font_or(options, own_font));
  const View view = options.look.view.value();
  const double aspect = (view.y_max - view.y_min) / (view.x_max - view.x_min);
  const double width = std::min(
      {most_cell, most_cell / aspect, most_grid_width / grid.columns, most_grid_height / grid.rows / aspect});
  const double least_height = (least_bar * grid.em - (grid.rows - 1) * grid.gap_size) / grid.rows;
  grid.cell_width = std::max(pixels(width), least_size);
  grid.cell_height = std::max({pixels(width * aspect), pixels(least_height), least_size});
  make_room_for_key(grid, options);
  return grid;
}

Grid fitted_grid(const PanelOptions& options) {
  const Size size = options.look.size.value();
  Grid grid = empty_grid(
      options,
      font_or(options, std::max(9.0, own_font * std::sqrt(size.width / 1280.0 * size.height / 720.0))));
  grid.cell_height = (size.height - grid.top - grid.bottom - (grid.rows - 1) * grid.gap_size) / grid.rows;
  make_room_for_key(grid, options);
  grid.cell_width = (size.width - grid.left - grid.right - (grid.columns - 1) * grid.gap_size) / grid.columns;
  if (grid.cell_width < least_size || grid.cell_height < least_size)
    throw UsageError("a panel of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                     " pixels is too small for " + std::to_string(grid.columns) + " x " +
                     std::to_string(grid.rows) + " pictures; use a larger --size");
  return grid;
}

Image empty_image(const PanelOptions& options, const Grid& grid) {
  if (const auto& size = options.look.size) return {size->width, size->height};
  const int width = options.width > 0 ? options.width : grid.left + grid.grid_width() + grid.right,
            height = grid.top + grid.grid_height() + grid.bottom;
  constexpr double most_pixels = 8192.0 * 8192.0;
  if (static_cast<double>(width) * height > most_pixels)
    throw UsageError("a panel of " + std::to_string(grid.columns) + " x " + std::to_string(grid.rows) +
                     " pictures would have " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels; at most 67 million are allowed, such as 8192 x 8192: use fewer runs or times");
  return {width, height};
}

Image transparent_or_not(Image image, bool transparent) {
  image.transparent = transparent;
  return image;
}

Look look_of_cells(Look look, const Grid& grid) {
  look.size = {grid.cell_width, grid.cell_height};
  look.bare = true;
  return look;
}

void copy_into(Image& image, const Rect& place, const Image& picture) {
  for (int row = 0; row < place.height; ++row)
    std::memcpy(&image.pixels[image.offset(place.x, place.y + row)], &picture.pixels[picture.offset(0, row)],
                static_cast<std::size_t>(place.width) * 4);
}

}  // namespace

struct Panel::Parts {
  PanelOptions options;
  Grid grid;
  Image image;
  Canvas canvas;
  Renderer renderer;
  ColorKey key;
  OffScale off_scale;

  explicit Parts(const PanelOptions& options_)
      : options(options_),
        grid(options.look.size ? fitted_grid(options) : own_grid(options)),
        image(transparent_or_not(empty_image(options, grid), options.look.transparent)),
        canvas(image, options.look.background),
        renderer(look_of_cells(options.look, grid)),
        key(Coloring(options.look).key()) {
    image.fill(options.look.background);
  }
  void draw_frames();
  void draw_headings();
  void draw_row_labels();
  void draw_key();
};

void Panel::Parts::draw_frames() {
  canvas.gray(frame_gray);
  for (int column = 0; column < grid.columns; ++column) {
    for (int row = 0; row < grid.rows; ++row) {
      const Rect cell = grid.cell(column, row);
      canvas.fill(cell.x - 1, cell.y - 1, cell.width + 2, 1);
      canvas.fill(cell.x - 1, cell.y + cell.height, cell.width + 2, 1);
      canvas.fill(cell.x - 1, cell.y, 1, cell.height);
      canvas.fill(cell.x + cell.width, cell.y, 1, cell.height);
    }
  }
}

void Panel::Parts::draw_headings() {
  const double em = grid.em;
  const bool notes = std::ranges::any_of(options.columns, [](const Heading& h) { return !h.note.empty(); });
  const double note_line = grid.top - 0.6 * em;
  const double title_line = note_line - (notes ? note_height * em : 0);
  for (int column = 0; column < grid.columns; ++column) {
    const Heading& heading = options.columns[static_cast<std::size_t>(column)];
    const Rect cell = grid.cell(column, 0);
    const double middle = cell.x + 0.5 * cell.width;
    canvas.use(Weight::bold, em);
    canvas.gray(ink);
    canvas.text(canvas.fitted(heading.title, cell.width), middle, title_line, Canvas::Align::centre);
    canvas.use(Weight::regular, note_size * em);
    canvas.gray(faint);
    canvas.text(canvas.fitted(heading.note, cell.width), middle, note_line, Canvas::Align::centre);
  }
}

void Panel::Parts::draw_row_labels() {
  canvas.use(Weight::regular, grid.em);
  canvas.gray(ink);
  for (int row = 0; row < grid.rows; ++row) {
    const Rect cell = grid.cell(0, row);
    canvas.turned_text(
        canvas.fitted(options.rows[static_cast<std::size_t>(row)], cell.height + grid.gap_size),
        grid.left - 0.7 * grid.em, cell.y + 0.5 * cell.height);
  }
}

void Panel::Parts::draw_key() {
  const Rect room{grid.left + grid.grid_width() + pixels(margin * grid.em), grid.top,
                  pixels(key_width(options, grid) * grid.em), grid.grid_height()};
  key.draw(canvas, room, grid.em, options.field, options.unit);
  key.draw_off_scale(canvas, room, grid.em, off_scale);
}

Panel::Panel(const PanelOptions& options) : parts_(std::make_unique<Parts>(options)) {}
Panel::~Panel() = default;

void Panel::draw(int column, int row, const FrameView& particles) {
  copy_into(parts_->image, parts_->grid.cell(column, row), parts_->renderer.draw(particles));
  parts_->off_scale |= parts_->renderer.off_scale();
}

void Panel::write_corner(int column, int row, const std::string& text) {
  Canvas& canvas = parts_->canvas;
  const Rect cell = parts_->grid.cell(column, row);
  canvas.begin();
  canvas.use(Weight::regular, note_size * parts_->grid.em);
  canvas.gray(faint);
  canvas.text(text, cell.x + corner_gap * parts_->grid.em, cell.y + (1 + corner_gap) * parts_->grid.em,
              Canvas::Align::left);
  canvas.end();
}

void Panel::write_middle(int column, int row, const std::string& text) {
  Canvas& canvas = parts_->canvas;
  const Rect cell = parts_->grid.cell(column, row);
  canvas.begin();
  canvas.use(Weight::regular, note_size * parts_->grid.em);
  canvas.gray(faint);
  canvas.text(canvas.fitted(text, cell.width), cell.x + 0.5 * cell.width, cell.y + 0.5 * cell.height,
              Canvas::Align::centre);
  canvas.end();
}

const Image& Panel::finish() {
  Parts& parts = *parts_;
  const Grid& grid = parts.grid;
  const double em = grid.em;
  parts.canvas.begin();
  parts.draw_frames();
  if (parts.options.look.bare) {
    parts.canvas.end();
    return parts.image;
  }
  const TextParts& shown = parts.options.look.texts.parts;
  draw_title(parts.canvas, shown.title ? parts.options.title : "", shown.method ? parts.options.note : "",
             grid.left, 2.1 * em, parts.image.width - grid.left - margin * em, em);
  parts.draw_headings();
  if (shown.time) parts.draw_row_labels();
  if (shown.bar) parts.draw_key();
  const auto& camera = parts.options.look.camera;
  const PageLayout layout = make_layout(grid.cell_width, grid.cell_height, *parts.options.look.view, false);
  if (shown.scale && (!camera || camera->field_of_view == 0))
    draw_scale_bar(parts.canvas, grid.cell(0, grid.rows - 1), layout.pixels_per_metre, em);
  if (camera && shown.axes)
    draw_axes_marker(parts.canvas, grid.cell(grid.columns - 1, grid.rows - 1), marker_of(*camera), em);
  parts.canvas.end();
  return parts.image;
}

}  // namespace taut::render
