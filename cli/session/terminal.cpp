#include "cli/session/terminal.hpp"

#include <algorithm>
#include <array>
#include <chafa.h>
#include <cstdlib>
#include <iostream>
#include <sys/ioctl.h>
#include <unistd.h>

#include "engine/error.hpp"

namespace taut::cli {
namespace {

template <auto Release>
struct Releaser {
  template <class T>
  void operator()(T* thing) const {
    Release(thing);
  }
};
using TermInfo = std::unique_ptr<ChafaTermInfo, Releaser<chafa_term_info_unref>>;
using Config = std::unique_ptr<ChafaCanvasConfig, Releaser<chafa_canvas_config_unref>>;
using Canvas = std::unique_ptr<ChafaCanvas, Releaser<chafa_canvas_unref>>;
using Symbols = std::unique_ptr<ChafaSymbolMap, Releaser<chafa_symbol_map_unref>>;

struct Geometry {
  int columns = 80, rows = 24;
  int cell_width = 8, cell_height = 16;  // pixels
};

Geometry geometry() {
  Geometry g;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return g;
  g.columns = size.ws_col;
  g.rows = size.ws_row;
  if (size.ws_xpixel > 0 && size.ws_ypixel > 0) {
    g.cell_width = std::max(1, size.ws_xpixel / size.ws_col);
    g.cell_height = std::max(1, size.ws_ypixel / size.ws_row);
  }
  return g;
}

ChafaPixelMode pixel_mode(const ChafaTermInfo* info) {
  constexpr std::array<std::pair<ChafaTermSeq, ChafaPixelMode>, 3> modes{{
      {CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1, CHAFA_PIXEL_MODE_KITTY},
      {CHAFA_TERM_SEQ_BEGIN_ITERM2_IMAGE, CHAFA_PIXEL_MODE_ITERM2},
      {CHAFA_TERM_SEQ_BEGIN_SIXELS, CHAFA_PIXEL_MODE_SIXELS},
  }};
  for (const auto& [sequence, mode] : modes)
    if (chafa_term_info_have_seq(info, sequence)) return mode;
  return CHAFA_PIXEL_MODE_SYMBOLS;
}

ChafaCanvasMode canvas_mode(const ChafaTermInfo* info) {
  constexpr std::array<std::pair<ChafaTermSeq, ChafaCanvasMode>, 3> modes{{
      {CHAFA_TERM_SEQ_SET_COLOR_FGBG_DIRECT, CHAFA_CANVAS_MODE_TRUECOLOR},
      {CHAFA_TERM_SEQ_SET_COLOR_FGBG_256, CHAFA_CANVAS_MODE_INDEXED_240},
      {CHAFA_TERM_SEQ_SET_COLOR_FGBG_16, CHAFA_CANVAS_MODE_INDEXED_16},
  }};
  for (const auto& [sequence, mode] : modes)
    if (chafa_term_info_have_seq(info, sequence)) return mode;
  return CHAFA_CANVAS_MODE_FGBG;
}

}  // namespace

struct Terminal::Screen {
  TermInfo info;
  Config config;
  Geometry size;
  bool of_pixels;
};

Terminal::Terminal(const std::ostream& out) {
  if (&out != &std::cout || !::isatty(STDOUT_FILENO))
    throw UsageError("preview needs a terminal on standard output; use `frame FILE.png` instead");
  TermInfo info(chafa_term_db_detect(chafa_term_db_get_default(), environ));
  Config config(chafa_canvas_config_new());
  Geometry size = geometry();
  size.rows = std::max(4, size.rows - 3);  // for command, caption and prompt
  const ChafaPixelMode mode = pixel_mode(info.get());
  chafa_canvas_config_set_geometry(config.get(), size.columns, size.rows);
  chafa_canvas_config_set_cell_geometry(config.get(), size.cell_width, size.cell_height);
  chafa_canvas_config_set_pixel_mode(config.get(), mode);
  chafa_canvas_config_set_canvas_mode(config.get(), canvas_mode(info.get()));
  // blocks have exact shapes in every font
  const Symbols symbols(chafa_symbol_map_new());
  for (const ChafaSymbolTags tag :
       {CHAFA_SYMBOL_TAG_SPACE, CHAFA_SYMBOL_TAG_SOLID, CHAFA_SYMBOL_TAG_HALF, CHAFA_SYMBOL_TAG_QUAD})
    chafa_symbol_map_add_by_tags(symbols.get(), tag);
  chafa_canvas_config_set_symbol_map(config.get(), symbols.get());
  // for terminals without colours
  chafa_canvas_config_set_fg_color(config.get(), 0x000000);
  chafa_canvas_config_set_bg_color(config.get(), 0xffffff);
  screen_ = std::make_unique<Screen>(
      Screen{std::move(info), std::move(config), size, mode != CHAFA_PIXEL_MODE_SYMBOLS});
}

Terminal::~Terminal() = default;

void Terminal::adapt(render::Look& look) const {
  const Geometry& size = screen_->size;
  const auto within = [](int side) { return std::clamp(side, render::least_size, render::greatest_size); };
  look.size = {within(size.columns * size.cell_width), within(size.rows * size.cell_height)};
  look.bare = look.bare || !screen_->of_pixels;
}

std::string Terminal::text_of(const render::Image& image) const {
  const Canvas canvas(chafa_canvas_new(screen_->config.get()));
  chafa_canvas_draw_all_pixels(canvas.get(), CHAFA_PIXEL_BGRA8_UNASSOCIATED, image.pixels.data(), image.width,
                               image.height, image.width * 4);
  GString* const printed = chafa_canvas_print(canvas.get(), screen_->info.get());
  std::string text(printed->str, printed->len);
  g_string_free(printed, TRUE);
  return text + '\n';
}

}  // namespace taut::cli
