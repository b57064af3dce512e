#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/drawing.hpp"
#include "cli/drawing/staging.hpp"
#include "cli/system/ordered_work.hpp"
#include "cli/system/stopwatch.hpp"
#include "engine/frame_view.hpp"
#include "engine/snapshot.hpp"
#include "render/renderer.hpp"

namespace taut::cli {

std::string frame_name(int number);
/// Also true for temporary files.
bool is_frame(const std::filesystem::path& path);

struct Captions {
  std::string title, method;
  double until = 0;  // s; sets the unit of times
};

Drawing fitted(const Drawing& drawing, const Snapshot& snapshot);
/// Requires a drawing from `fitted`.
render::Image draw_picture(const Drawing& drawing, const Captions& captions, const Snapshot& snapshot);

/// "taut: …" with end of line; empty if all texts fit.
std::string remark_on_texts(const std::set<std::string>& cut);

/// Draws added frames immediately if colours and view are fixed, else in `draw_kept`. Writes files in order.
class Frames {
 public:
  static constexpr double memory_of_pictures = 1e9;  // bytes

  /// Throws UsageError if all particles are hidden. `finish` adds the times of all threads to `seconds`.
  Frames(const Drawing& drawing, Origins origins, std::filesystem::path folder, Captions captions,
         int threads, Seconds& seconds);

  void add(const Snapshot& snapshot);
  /// Requires all particles of the run.
  void add(const FrameView& particles);
  /// Ascending; default: 0, 1, …
  void number_files(std::vector<int> numbers) { file_numbers_ = std::move(numbers); }
  bool draw_kept(const std::function<bool(int drawn)>& go_on);
  /// Waits for pending frames. Rethrows the first error of the drawing threads.
  void finish();

  int kept() const { return static_cast<int>(kept_.size()); }
  int written() const { return written_; }
  /// Fitted once the first frame is drawn.
  const Drawing& drawing() const { return drawing_; }

  /// Texts without room in the pictures. Call after `finish`.
  std::set<std::string> cut_texts() const;
  /// Requires that no frame is pending.
  template <class Archive>
  void serialize(Archive& archive) {
    int written = written_;
    archive(dim_, diameter_, kept_, written);
    archive.check("a stored frame", [&] {
      const std::size_t n = staging_.size(), d = static_cast<std::size_t>(staging_.dim());
      const auto fits = [&](const Kept& frame) {
        const auto is_finite = [](double x) { return std::isfinite(x); };
        return frame.x.size() == d * n && frame.value.size() == n &&
               std::ranges::all_of(frame.x, is_finite) && std::ranges::all_of(frame.origin, is_finite);
      };
      return kept_.empty() || (std::cmp_equal(dim_, d) && diameter_.size() == n && !renderers_.front() &&
                               std::ranges::all_of(kept_, fits));
    });
    written_ = drawn_ = written;
  }

 private:
  /// In double precision: particles can be far from the origin.
  struct Kept {
    double time;   // s
    Point origin;  // m
    std::vector<double> x, value;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(time, origin, x, value);
    }
  };
  struct Standpoint {
    render::Camera camera;
    render::View view;
  };
  void keep(StagedParticles particles);
  StagedParticles staged(const Kept& frame) const;
  SequenceBounds bounds_of_kept() const;
  void begin_drawing(const SequenceBounds& shown);
  void draw(StagedParticles particles, std::optional<Standpoint> from = {});
  std::vector<std::uint8_t> draw_picture(int worker, const StagedParticles& particles,
                                         const std::optional<Standpoint>& from);
  void write(const std::vector<std::uint8_t>& picture, int number);
  Standpoint on_orbit(double share) const;

  Drawing drawing_;
  Staging staging_;
  std::filesystem::path folder_;
  Captions captions_;
  Seconds& seconds_;
  int dim_ = 2;
  std::vector<double> diameter_;  // m
  std::vector<Kept> kept_;
  std::optional<render::Vector> orbited_;  // centre of the orbit, m
  std::vector<int> file_numbers_;
  int drawn_ = 0;  // including pending frames
  std::atomic<int> written_ = 0;
  std::atomic<double> drawing_time_ = 0, writing_time_ = 0;  // s, not yet in `seconds_`
  std::vector<std::optional<render::Renderer>> renderers_;
  OrderedWork work_;  // last: its threads use the other members
};

}  // namespace taut::cli
