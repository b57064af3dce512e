#include "cli/run/outputs.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/core.h>

#include "cli/drawing/frames.hpp"
#include "cli/drawing/kept_look.hpp"
#include "cli/run/history.hpp"
#include "cli/run/particle_series.hpp"
#include "cli/run/report.hpp"
#include "cli/run/schedule.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

template <class Kind>
class OutputOf : public RunOutput {
 public:
  void save(Saver& saver) final { saver(static_cast<Kind&>(*this)); }
  void load(Loader& loader) final { loader(static_cast<Kind&>(*this)); }
};

constexpr int judged_parts = 200;

class HistoryOutput final : public OutputOf<HistoryOutput> {
 public:
  HistoryOutput(const RunPlan& plan, const Simulation& simulation, RunResult& result)
      : scene_(plan.file.scene),
        path_(plan.folder.history()),
        simulation_(simulation),
        result_(result),
        agenda_(plan.history_times),
        judge_times_(times_in_parts(plan.file.scene.until, judged_parts)),
        judge_(scene_, simulation),
        gauge_(scene_, simulation.snapshot(), simulation.threads()),
        conservation_(scene_, simulation.snapshot()) {}

  void open(AppendFile::Start start) override { history_.emplace(path_, scene_, start); }
  double next() const override { return std::min(agenda_.next(), judge_times_.next()); }
  bool needs_exact_time() const override { return false; }
  bool needs_final_state() const override {
    return std::min(history_->last_step(), judged_step_) != simulation_.steps();
  }

  void write_due() override {
    const Timed timed(result_.record.seconds.write);
    const double time = simulation_.time();
    const bool row = !agenda_.reached(time).empty(), judged = !judge_times_.reached(time).empty();
    const bool at_end = !row && !judged;
    const Snapshot& now = judged || at_end ? simulation_.snapshot() : simulation_.motion();
    const Balance sums = balance(now, scene_);
    if (judged || at_end) judge(now, sums);
    if (row || at_end) history_->add(simulation_, sums, judge_.pieces(), readings_);
  }

  void put_on_disk() override { history_->put_on_disk(); }
  void update_result() override { result_.record.conservation = conservation_.so_far(); }
  void discard_newer() override { history_->discard_newer(); }
  void run_on() override { judge_times_.skip_to(simulation_.time()); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(agenda_, judge_times_, judge_, conservation_, *history_, readings_, judged_step_,
            result_.record.indicator);
    archive.check("an indicator", [&] {
      const long particle = result_.record.indicator[0].particle;
      return particle >= -1 && particle < static_cast<long>(simulation_.snapshot().size());
    });
    if constexpr (std::is_same_v<Archive, Loader>) take_verdict(simulation_.snapshot());
  }

 private:
  void judge(const Snapshot& now, const Balance& sums) {
    judged_step_ = now.step;
    conservation_.follow(sums);
    readings_ = gauge_(now);
    judge_.observe(now, sums, readings_);
    for (std::size_t k = 0; k < readings_.size(); ++k)
      result_.record.indicator[k].take(readings_[k], now.time);
    take_verdict(now);
    if (judge_.verdict() == Verdict::diverged) result_.failure = describe_divergence(now, sums);
  }
  void take_verdict(const Snapshot& now) {
    if (const long particle = result_.record.indicator[0].particle; particle >= 0) {
      const auto first = now.x0.begin() + now.dim * particle;
      result_.record.patch_body = scene_.bodies[now.body[particle]].name;
      result_.record.patch_place.assign(first, first + now.dim);
    } else {
      result_.record.patch_body.clear();
    }
    result_.record.pieces = judge_.pieces();
    result_.record.verdict = judge_.verdict();
    result_.record.since = judge_.since();
    result_.record.beyond_law = judge_.beyond_law();
    result_.record.energy_gain = judge_.energy_gain();
    result_.record.turn = judge_.turn();
  }

  const Scene& scene_;
  std::filesystem::path path_;
  const Simulation& simulation_;
  RunResult& result_;
  Agenda agenda_, judge_times_;
  Judge judge_;
  IndicatorGauge gauge_;
  long judged_step_ = -1;
  Readings readings_;
  ConservationWatch conservation_;
  std::optional<History> history_;
};

LineRecorder start_lines(const SceneFile& file, const Simulation& simulation) try {
  return {file.scene, simulation.snapshot(), simulation.support()};
} catch (const SceneError& e) {
  throw locate(file, e);
}

class MeasuresOutput final : public OutputOf<MeasuresOutput> {
 public:
  MeasuresOutput(const RunPlan& plan, const Simulation& simulation, LastStep& last_step, RunResult& result)
      : scene_(plan.file.scene),
        path_(plan.folder.lines()),
        simulation_(simulation),
        last_step_(last_step),
        result_(result),
        lines_(start_lines(plan.file, simulation)) {}

  void open(AppendFile::Start start) override {
    if (!scene_.lines.empty()) file_.emplace(path_, scene_, result_.record.material_law, start);
  }
  double next() const override { return lines_.next(); }

  void write_due() override {
    const Timed timed(result_.record.seconds.write);
    while (lines_.next() <= simulation_.time()) lines_.sample(last_step_.at(lines_.next()));
    if (file_) file_->add(lines_.samples());
  }
  void put_on_disk() override {
    if (file_) file_->put_on_disk();
  }

  void update_result() override {
    result_.record.measures = measure(scene_, simulation_.series(), result_.record.material_law,
                                      lines_.samples(), &simulation_.snapshot());
  }

  void discard_newer() override {
    if (file_) file_->discard_newer();
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lines_);
    if (file_) archive(*file_);
  }

 private:
  const Scene& scene_;
  std::filesystem::path path_;
  const Simulation& simulation_;
  LastStep& last_step_;
  RunResult& result_;
  LineRecorder lines_;
  std::optional<LineSamplesFile> file_;
};

bool shows_some(const render::View& view, const Snapshot& now) {
  const auto dim = static_cast<std::size_t>(now.dim);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double x = now.x[i * dim], y = now.x[i * dim + 1];
    if (x >= view.x_min && x <= view.x_max && y >= view.y_min && y <= view.y_max) return true;
  }
  return false;
}

class FramesOutput final : public OutputOf<FramesOutput> {
 public:
  FramesOutput(const RunPlan& plan, const Simulation& simulation, LastStep& last_step, RunResult& result)
      : folder_(plan.folder),
        simulation_(simulation),
        last_step_(last_step),
        result_(result),
        agenda_(plan.frame_times),
        keeps_look_(plan.keeps_look),
        frames_(*plan.drawing, origins_of(simulation.snapshot()), plan.folder.frames(),
                {plan.file.scene.title, result.record.method, result.record.until}, simulation.threads(),
                result.record.seconds) {
    // earlier frames of a continued run are unknown; in 3D the view is in the camera's plane
    if (!plan.drawing->followed && !plan.state && simulation.snapshot().dim == 2)
      unseen_ = plan.drawing->look.view;
  }

  double next() const override { return agenda_.next(); }

  void write_due() override {
    for (const double due : agenda_.reached(simulation_.time())) frames_.add(last_step_.at(due));
    if (unseen_ && shows_some(*unseen_, simulation_.snapshot())) unseen_.reset();
  }

  void wait() override { frames_.finish(); }
  void put_on_disk() override {
    if (on_disk_ == frames_.written()) return;
    while (on_disk_ < frames_.written()) cli::put_on_disk(folder_.frame(on_disk_++));
    cli::put_on_disk(folder_.frames());
  }
  void update_result() override { result_.frames = frames_.written(); }
  void discard_newer() override { folder_.keep_frames(on_disk_ = frames_.written()); }

  bool has_deferred_work() const override { return frames_.kept() > 0; }
  bool complete(const Interrupts& interrupts, Progress& progress) override {
    if (unseen_)
      result_.record.remark += std::string(result_.record.remark.empty() ? "" : "; ") + nothing_seen;
    frames_.finish();
    const bool all = frames_.kept() == 0 || draw_kept(interrupts, progress);
    result_.cut_texts = frames_.cut_texts();
    if (all && keeps_look_)
      write_atomically(folder_.look(), to_json(look_of(frames_.drawing())).dump(2) + "\n",
                       Durability::on_disk);
    return all;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(agenda_, frames_);
    archive.check("the number of frames",
                  [&] { return std::cmp_equal(agenda_.done() - frames_.kept(), frames_.written()); });
    if (Archive::loads) folder_.check_frames(frames_.written());
  }

 private:
  bool draw_kept(const Interrupts& interrupts, Progress& progress) {
    const int count = frames_.kept();
    // an interrupt of the run does not stop the drawing
    const bool interrupted_before = interrupts.interrupted();
    progress.begin("drawing " + std::to_string(count) + " frames");
    const bool all = frames_.draw_kept([&](int drawn) {
      progress.show(static_cast<double>(drawn) / count, "frame " + std::to_string(drawn + 1));
      return interrupted_before || !interrupts.interrupted();
    });
    progress.end(std::to_string(frames_.written()) + " frames");
    return all;
  }

  static constexpr const char* nothing_seen =
      "the view shows no particle in any frame: use --view auto to show the whole motion";

  const RunFolder& folder_;
  const Simulation& simulation_;
  LastStep& last_step_;
  RunResult& result_;
  Agenda agenda_;
  bool keeps_look_;
  Frames frames_;
  std::optional<render::View> unseen_;
  int on_disk_ = 0;
};

class ParticlesOutput final : public OutputOf<ParticlesOutput> {
 public:
  ParticlesOutput(const RunPlan& plan, const Simulation& simulation, LastStep& last_step, RunResult& result)
      : folder_(plan.folder),
        format_(plan.particle_form.format),
        simulation_(simulation),
        last_step_(last_step),
        agenda_(plan.frame_times),
        series_(plan.particle_fields, plan.particle_form, plan.folder, result.record.seconds) {}

  double next() const override { return agenda_.next(); }
  void write_due() override {
    for (const double due : agenda_.reached(simulation_.time())) series_.add(last_step_.at(due));
  }
  void put_on_disk() override { series_.put_on_disk(); }
  void update_result() override { series_.save_index(); }
  void discard_newer() override { folder_.keep_particle_files(series_.written(), format_); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(agenda_, series_);
    archive.check("the number of particle files",
                  [&] { return std::cmp_equal(agenda_.done(), series_.written()); });
    if (Archive::loads) folder_.check_particle_files(series_.written(), format_);
  }

 private:
  const RunFolder& folder_;
  ParticleFormat format_;
  const Simulation& simulation_;
  LastStep& last_step_;
  Agenda agenda_;
  ParticleSeries series_;
};

}  // namespace

const Snapshot& LastStep::at(double t) {
  const Snapshot& now = simulation_.snapshot();
  if (t == now.time) return now;
  if (before_.size() == 0 || before_.step + 1 != now.step)
    throw std::logic_error(fmt::format("no state is stored before the step that passes t = {} s", exact(t)));
  if (shown_.time != t || shown_.step != now.step) shown_ = blend(before_, now, t);
  return shown_;
}

std::vector<std::unique_ptr<RunOutput>> make_outputs(const RunPlan& plan, const Simulation& simulation,
                                                     LastStep& last_step, RunResult& result) {
  std::vector<std::unique_ptr<RunOutput>> all;
  // first: it detects divergence, after which no other output is written
  all.push_back(std::make_unique<HistoryOutput>(plan, simulation, result));
  all.push_back(std::make_unique<MeasuresOutput>(plan, simulation, last_step, result));
  if (plan.drawing) all.push_back(std::make_unique<FramesOutput>(plan, simulation, last_step, result));
  if (!plan.particle_fields.empty())
    all.push_back(std::make_unique<ParticlesOutput>(plan, simulation, last_step, result));
  return all;
}

}  // namespace taut::cli
