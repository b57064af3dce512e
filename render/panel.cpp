#include "render/panel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "engine/error.hpp"
#include "render/coloring.hpp"
#include "render/image/png.hpp"
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
constexpr double frame_gray = 0.85;  // see Canvas

// Defaults in pixels.
constexpr double own_font = 16;
constexpr double most_grid_width = 1440, most_grid_height = 1080, most_cell = 540;

int pixels(double length) { return static_cast<int>(std::lround(length)); }

struct Grid {
  double em = own_font;
  int blocks = 1, columns = 0, rows = 0;  // columns: of each block
  std::vector<int> spaces{};              // left of, between and right of the blocks
  int top = 0, bottom = 0;
  int gap_size = 0;
  int cell_width = 0, cell_height = 0;

  Rect cell(int column, int row) const {
    const int block = column / columns;
    return {left_of(block) + (column - block * columns) * (cell_width + gap_size),
            top + row * (cell_height + gap_size), cell_width, cell_height};
  }
  int block_width() const { return columns * cell_width + (columns - 1) * gap_size; }
  int left_of(int block) const {
    return std::accumulate(spaces.begin(), spaces.begin() + block + 1, 0) + block * block_width();
  }
  int right_of(int block) const { return left_of(block) + block_width(); }
  int width() const { return right_of(blocks - 1) + spaces.back(); }
  int grid_height() const { return rows * cell_height + (rows - 1) * gap_size; }

  int all_columns() const { return blocks * columns; }
  int cell_width_in(int width) const {
    const int taken = std::accumulate(spaces.begin(), spaces.end(), 0) + blocks * (columns - 1) * gap_size;
    return (width - taken) / all_columns();
  }
};

std::vector<PanelBlock> blocks_of(const PanelOptions& options) {
  std::vector<PanelBlock> blocks{options};
  for (PanelBlock block : options.beside) {
    block.look.texts = options.look.texts;
    block.look.background = options.look.background, block.look.transparent = options.look.transparent;
    blocks.push_back(std::move(block));
  }
  return blocks;
}

bool same_colors(const PanelBlock& a, const PanelBlock& b) {
  return a.field == b.field && a.unit == b.unit && a.look.range == b.look.range &&
         a.look.colormap == b.look.colormap && a.look.categories == b.look.categories &&
         a.look.unlisted == b.look.unlisted && a.look.bar_format == b.look.bar_format;
}

/// Cells have no size yet.
Grid empty_grid(const PanelOptions& options, double em) {
  Grid grid;
  grid.em = em;
  grid.blocks = static_cast<int>(options.beside.size()) + 1;
  grid.columns = static_cast<int>(options.columns.size());
  grid.rows = static_cast<int>(options.rows.size());
  grid.gap_size = pixels(gap * em);
  grid.spaces.assign(options.beside.size() + 2, grid.gap_size);
  grid.top = grid.bottom = grid.gap_size;
  if (options.look.bare) return grid;
  const bool notes = std::ranges::any_of(options.columns, [](const Heading& h) { return !h.note.empty(); });
  const PageTexts& texts = options.look.texts;
  const TextParts& parts = texts.parts;
  const bool title = (parts.title && !options.title.empty()) || (parts.method && !options.note.empty());
  grid.top = pixels((0.4 + (title ? title_height : 0) + heading_height + (notes ? note_height : 0)) * em);
  double below = parts.scale ? footer : margin;
  if (texts.has_bar(BarPosition::bottom)) below += room_of_bar_below;
  if (texts.axes_outside && parts.axes) below = std::max(below, room_of_axes);
  grid.bottom = pixels(below * em);
  return grid;
}

/// Width in em; 0 if an adjacent block of equal colours has the key.
double key_width(const std::vector<PanelBlock>& blocks, std::size_t k, const Grid& grid) {
  const PanelBlock& block = blocks[k];
  const bool left = block.look.texts.bar == BarPosition::left;
  const std::size_t next = left ? k - 1 : k + 1;  // the first block's k − 1 wraps around
  if (next < blocks.size() && same_colors(block, blocks[next])) return 0;
  return Coloring(block.look).key().width(grid.grid_height(), grid.em, block.unit);
}

void make_room_for_keys(Grid& grid, const PanelOptions& options) {
  if (options.look.bare) return;
  const PageTexts& texts = options.look.texts;
  const std::vector<PanelBlock> blocks = blocks_of(options);
  const double em = grid.em, labels = margin + (texts.parts.time ? row_label : 0);
  grid.spaces.assign(blocks.size() + 1, pixels(2 * gap * em));
  grid.spaces.front() = pixels(labels * em), grid.spaces.back() = pixels(margin * em);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (!texts.has_bar(BarPosition::right) && !texts.has_bar(BarPosition::left)) continue;
    const double wide = key_width(blocks, k, grid);
    if (wide == 0) continue;
    const double room = margin + wide + key_margin + 0.15;
    if (texts.has_bar(BarPosition::left))
      grid.spaces[k] = pixels((room + (k == 0 ? labels - margin : 0)) * em);
    else
      grid.spaces[k + 1] = pixels((room + (k + 1 < blocks.size() ? gap : 0)) * em);
  }
}

double font_or(const PanelOptions& options, double by_default) {
  return options.look.texts.font > 0 ? options.look.texts.font : by_default;
}

/// Keeps the view's aspect ratio. Two passes, since the key's width depends slightly on the height.
Grid grid_of_width(const PanelOptions& options) {
  Grid grid = empty_grid(options, font_or(options, own_font));
  const View view = options.look.view.value();
  const double aspect = (view.y_max - view.y_min) / (view.x_max - view.x_min);
  grid.cell_height = pixels(aspect * options.width / grid.all_columns());
  for (int pass = 0; pass < 2; ++pass) {
    make_room_for_keys(grid, options);
    grid.cell_width = grid.cell_width_in(options.width);
    grid.cell_height = pixels(grid.cell_width * aspect);
  }
  if (grid.cell_width < least_size || grid.cell_height < least_size)
    throw UsageError("a panel " + std::to_string(options.width) + " pixels wide has no room for " +
                     std::to_string(grid.all_columns()) +
                     " columns of pictures; use a larger --width or --dpi");
  return grid;
}

Grid own_grid(const PanelOptions& options) {
  if (options.width > 0) return grid_of_width(options);
  Grid grid = empty_grid(options, font_or(options, own_font));
  const View view = options.look.view.value();
  const double aspect = (view.y_max - view.y_min) / (view.x_max - view.x_min);
  const double width = std::min({most_cell, most_cell / aspect, most_grid_width / grid.all_columns(),
                                 most_grid_height / grid.rows / aspect});
  const double least_height = (least_bar * grid.em - (grid.rows - 1) * grid.gap_size) / grid.rows;
  grid.cell_width = std::max(pixels(width), least_size);
  grid.cell_height = std::max({pixels(width * aspect), pixels(least_height), least_size});
  make_room_for_keys(grid, options);
  return grid;
}

Grid fitted_grid(const PanelOptions& options) {
  const Size size = options.look.size.value();
  Grid grid = empty_grid(
      options,
      font_or(options, std::max(9.0, own_font * std::sqrt(size.width / 1280.0 * size.height / 720.0))));
  grid.cell_height = (size.height - grid.top - grid.bottom - (grid.rows - 1) * grid.gap_size) / grid.rows;
  make_room_for_keys(grid, options);
  grid.cell_width = grid.cell_width_in(size.width);
  if (grid.cell_width < least_size || grid.cell_height < least_size)
    throw UsageError("a panel of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                     " pixels is too small for " + std::to_string(grid.all_columns()) + " x " +
                     std::to_string(grid.rows) + " pictures; use a larger --size");
  return grid;
}

Image empty_image(const PanelOptions& options, const Grid& grid) {
  if (const auto& size = options.look.size) return {size->width, size->height};
  const int width = options.width > 0 ? options.width : grid.width(),
            height = grid.top + grid.grid_height() + grid.bottom;
  if (std::max(width, height) > greatest_side || std::int64_t{width} * height > most_pixels)
    throw UsageError("a panel of " + std::to_string(grid.all_columns()) + " x " + std::to_string(grid.rows) +
                     " pictures would have " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels; at most 67 million are allowed, such as 8192 x 8192, and 16384 per side: "
                     "use fewer runs or times");
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
  struct Block {
    PanelBlock about;
    Renderer renderer;
    OffScale off_scale{};
  };
  PanelOptions options;
  Grid grid;
  Image image;
  Canvas canvas;
  std::vector<Block> blocks;

  explicit Parts(const PanelOptions& options_)
      : options(options_),
        grid(options.look.size ? fitted_grid(options) : own_grid(options)),
        image(transparent_or_not(empty_image(options, grid), options.look.transparent)),
        canvas(image, options.look.background) {
    for (const PanelBlock& block : blocks_of(options))
      blocks.push_back({block, Renderer(look_of_cells(block.look, grid))});
    image.fill(options.look.background);
  }
  Block& block_of(int column) { return blocks[static_cast<std::size_t>(column / grid.columns)]; }
  double pixels_per_metre(const Block& block) const {
    return make_layout(grid.cell_width, grid.cell_height, *block.about.look.view, false).pixels_per_metre;
  }
  void draw_frames();
  void draw_headings();
  void draw_row_labels();
  void draw_keys();
  void draw_scales();
};

void Panel::Parts::draw_frames() {
  canvas.gray(frame_gray);
  for (int column = 0; column < grid.all_columns(); ++column) {
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
  for (int column = 0; column < grid.all_columns(); ++column) {
    const Heading& heading = options.columns[static_cast<std::size_t>(column % grid.columns)];
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
        grid.left_of(0) - 0.7 * grid.em, cell.y + 0.5 * cell.height);
  }
}

void Panel::Parts::draw_keys() {
  const PageTexts& texts = options.look.texts;
  const int gap_of_key = pixels(margin * grid.em);
  OffScale off_scale;
  for (int k = 0, first = 0; k < grid.blocks; ++k) {
    const Block& block = blocks[static_cast<std::size_t>(k)];
    off_scale |= block.off_scale;
    if (k + 1 < grid.blocks && same_colors(block.about, blocks[static_cast<std::size_t>(k) + 1].about))
      continue;
    ColorKey key = Coloring(block.about.look).key();
    Rect room{grid.right_of(k) + gap_of_key, grid.top, 0, grid.grid_height()};
    room.width = pixels(key.width(room.height, grid.em, block.about.unit) * grid.em);
    if (texts.has_bar(BarPosition::left))
      room.x = first == 0 ? gap_of_key : grid.right_of(first - 1) + gap_of_key;
    if (texts.has_bar(BarPosition::bottom)) {
      const int high = pixels(room_of_bar_below * grid.em);
      const int axes = texts.axes_outside && texts.parts.axes ? pixels(room_of_axes * grid.em) : 0;
      room = {grid.left_of(first), image.height - high, grid.right_of(k) - grid.left_of(first) - axes, high};
    }
    key.draw(canvas, room, grid.em, block.about.field, block.about.unit);
    key.draw_off_scale(canvas, room, grid.em, off_scale);
    first = k + 1, off_scale = {};
  }
}

void Panel::Parts::draw_scales() {
  const TextParts& shown = options.look.texts.parts;
  for (int k = 0; k < grid.blocks; ++k) {
    const Block &block = blocks[static_cast<std::size_t>(k)],
                &before = blocks[static_cast<std::size_t>(std::max(k - 1, 0))];
    const auto &camera = block.about.look.camera, &camera_before = before.about.look.camera;
    const double scale = pixels_per_metre(block);
    if (shown.scale && (!camera || camera->field_of_view == 0) &&
        (k == 0 || scale != pixels_per_metre(before) || camera != camera_before))
      draw_scale_bar(canvas, grid.cell(k * grid.columns, grid.rows - 1), scale, grid.em);
    if (camera && shown.axes &&
        (k + 1 == grid.blocks || camera != blocks[static_cast<std::size_t>(k) + 1].about.look.camera))
      draw_axes_marker(canvas, grid.cell((k + 1) * grid.columns - 1, grid.rows - 1), marker_of(*camera),
                       grid.em, options.look.texts.axes_outside);
  }
}

Panel::Panel(const PanelOptions& options) : parts_(std::make_unique<Parts>(options)) {}
Panel::~Panel() = default;

void Panel::draw(int column, int row, const FrameView& particles) {
  Parts::Block& block = parts_->block_of(column);
  copy_into(parts_->image, parts_->grid.cell(column, row), block.renderer.draw(particles));
  block.off_scale |= block.renderer.off_scale();
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

std::set<std::string> Panel::cut_texts() const { return parts_->canvas.cut(); }

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
             grid.left_of(0), 2.1 * em, parts.image.width - grid.left_of(0) - margin * em, em);
  parts.draw_headings();
  if (shown.time) parts.draw_row_labels();
  if (shown.bar) parts.draw_keys();
  parts.draw_scales();
  parts.canvas.end();
  return parts.image;
}

}  // namespace taut::render
