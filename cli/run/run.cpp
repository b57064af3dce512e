#include "cli/run/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <nlohmann/json.hpp>

#include "cli/drawing/frames.hpp"
#include "cli/run/checkpoint.hpp"
#include "cli/run/history.hpp"
#include "cli/run/particle_file.hpp"
#include "cli/run/report.hpp"
#include "cli/run/schedule.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/core/archive.hpp"
#include "engine/error.hpp"
#include "engine/families/catalogue.hpp"

namespace taut::cli {
namespace {

constexpr double record_interval = 5.0;  // s between two states of run.json while running

/// Drives a simulation from one output time to the next and records what it shows.
class Run {
 public:
  Run(const RunPlan& plan, std::unique_ptr<Simulation> simulation, LineRecorder lines,
      const Interrupts& interrupts, Progress& progress, RunRecord record);
  Run(const Run&) = delete;  // its parts refer to one another
  Run& operator=(const Run&) = delete;

  RunResult execute();

 private:
  void begin();
  void open_files(AppendFile::Start start);
  void take_up(const std::string& state);
  template <class Archive>
  void serialize(Archive& archive);
  void save_checkpoint();
  void plan_next_checkpoint();
  void simulate();
  void step_through();
  RunRecord::Status how_it_ended() const;
  void advance(double target);
  void look();
  void sample_lines();
  void take_verdict();
  void show_what_is_due();
  bool draw_the_rest();
  void save(RunRecord::Status status);
  void save_what_can_be_saved();
  std::string state_line() const;

  const RunPlan& plan_;
  std::unique_ptr<Simulation> simulation_;
  LineRecorder lines_;
  const Interrupts& interrupts_;
  Progress& progress_;
  RunResult result_;
  RunRecord& record_ = result_.record;
  Agenda frame_agenda_, history_agenda_;
  Judge judge_;
  IndicatorGauge gauge_;
  Drift drift_;
  std::optional<History> history_;
  std::optional<LineSamplesFile> lines_file_;  // of a scene with lines
  std::optional<Frames> frames_;
  std::optional<ParticleSeries> particles_;
  Pace pace_;
  bool exchanges_momentum_ = false;
  Stopwatch since_saved_;
  double next_checkpoint_ = std::numeric_limits<double>::infinity();  // s
};

Run::Run(const RunPlan& plan, std::unique_ptr<Simulation> simulation, LineRecorder lines,
         const Interrupts& interrupts, Progress& progress, RunRecord record)
    : plan_(plan),
      simulation_(std::move(simulation)),
      lines_(std::move(lines)),
      interrupts_(interrupts),
      progress_(progress),
      result_{std::move(record), 0, ""},
      frame_agenda_(plan.frame_times),
      history_agenda_(plan.history_times),
      judge_(plan.file.scene, simulation_->snapshot(), simulation_->support()),
      gauge_(plan.file.scene, simulation_->snapshot()),
      pace_(record_.until),
      exchanges_momentum_(
          std::ranges::any_of(simulation_->snapshot().held, [](unsigned char held) { return held != 0; }) ||
          has_drives(plan.file.scene) || has_loads(plan.file.scene) || plan.file.scene.damping > 0) {
  if (plan.drawing)
    frames_.emplace(*plan.drawing, plan.folder.frames(),
                    Captions{plan.file.scene.title, record_.method, record_.until}, record_.seconds);
  if (!plan.particle_fields.empty()) particles_.emplace(plan.particle_fields, plan.folder, record_.seconds);
}

RunResult Run::execute() {
  if (!plan_.state) plan_.folder.claim(to_json(record_).dump(2) + "\n");
  try {
    plan_.state ? take_up(*plan_.state) : begin();
    simulate();
    const RunRecord::Status status = how_it_ended();
    save(status);  // the drawing of frames that were kept takes time, and may be interrupted as well
    const bool all_drawn = draw_the_rest();
    save(status == RunRecord::Status::finished && !all_drawn ? RunRecord::Status::interrupted : status);
    // a diverged run has come to its end as well
    if (all_drawn && record_.status != RunRecord::Status::interrupted) plan_.folder.clear_checkpoint();
  } catch (const OutputError&) {
    save_what_can_be_saved();
    throw;
  }
  return std::move(result_);
}

void Run::begin() {
  write_atomically(plan_.folder.scene(), plan_.file.resolved);
  open_files(AppendFile::Start::empty);
  plan_next_checkpoint();
}

void Run::open_files(AppendFile::Start start) {
  const Scene& scene = plan_.file.scene;
  history_.emplace(plan_.folder.history(), scene, start);
  if (!scene.lines.empty()) lines_file_.emplace(plan_.folder.lines(), scene, record_.material_law, start);
}

/// What the folder holds from after the checkpoint is taken back: it comes again.
void Run::take_up(const std::string& state) {
  const double setup = record_.seconds.setup;
  open_files(AppendFile::Start::as_it_is);
  Loader loader(state);
  std::string simulation;
  loader(simulation);
  serialize(loader);
  loader.finish();
  simulation_->load(simulation);
  record_.seconds.setup += setup;
  record_.reached = simulation_->time();
  record_.steps = simulation_->steps();
  take_verdict();
  plan_.folder.keep(frames_ ? frames_->written() : 0, particles_ ? particles_->written() : 0);
  plan_next_checkpoint();
  save(RunRecord::Status::running);
}

/// All that changes as the run goes by, beside the simulation itself.
template <class Archive>
void Run::serialize(Archive& archive) {
  archive(frame_agenda_, history_agenda_, judge_, drift_, lines_, *history_, record_.indicator,
          record_.seconds);
  if (lines_file_) archive(*lines_file_);
  if (frames_) archive(*frames_);
  if (particles_) archive(*particles_);
}

void Run::save_checkpoint() {
  if (!plan_.checkpoint_every) return;
  const Timed timed(record_.seconds.write);
  Saver saver;
  std::string simulation = simulation_->save();
  saver(simulation);
  serialize(saver);
  Checkpoint checkpoint{record_.method,          plan_.file.resolved,       {},          plan_.spacing_asked,
                        *plan_.checkpoint_every, plan_.drawing.has_value(), saver.take()};
  for (const Field* field : plan_.particle_fields) checkpoint.fields.emplace_back(field->key);
  write_checkpoint(plan_.folder.checkpoint(), std::move(checkpoint));
  plan_next_checkpoint();
}

void Run::plan_next_checkpoint() {
  if (!plan_.checkpoint_every) return;
  const double every = *plan_.checkpoint_every;
  next_checkpoint_ = std::fmax((std::floor(record_.reached / every) + 1) * every,
                               std::nextafter(record_.reached, record_.until));
}

RunRecord::Status Run::how_it_ended() const {
  if (!result_.failure.empty()) return RunRecord::Status::failed;
  return record_.reached >= record_.until ? RunRecord::Status::finished : RunRecord::Status::interrupted;
}

/// When some output could not be written, run.json can often still say so.
void Run::save_what_can_be_saved() {
  try {
    save(RunRecord::Status::failed);
  } catch (const OutputError&) {
    // the first failure is the one to report
  }
}

void Run::simulate() {
  try {
    step_through();
  } catch (const NumericalError& e) {
    result_.failure = describe_divergence(e);
    record_.verdict = Verdict::diverged;
    record_.since.try_emplace(Verdict::diverged, e.time);
    record_.reached = e.time;
    record_.steps = e.step;
  }
}

void Run::step_through() {
  progress_.begin(plan_.file.scene.name + ", " + record_.method + ", " + std::to_string(record_.particles) +
                  " particles");
  if (!plan_.state) {
    look();
    sample_lines();
    show_what_is_due();
  }
  for (bool going = result_.failure.empty(); going;) {
    advance(std::min({frame_agenda_.next(), history_agenda_.next(), lines_.next(), record_.until}));
    going = record_.reached < record_.until && !interrupts_.asked();
    // before the look at the end, which is one more than a run that goes on has
    if (interrupts_.asked()) save_checkpoint();
    if (history_agenda_.next() <= record_.reached || !going) look();
    if (!result_.failure.empty()) break;
    sample_lines();
    show_what_is_due();
  }
  progress_.end(state_line());
}

/// In slices, so that an interrupt is seen soon: a stop in between does not change the steps.
void Run::advance(double target) {
  while (record_.reached < target && !interrupts_.asked()) {
    const Stopwatch watch;
    const double from = record_.reached;
    simulation_->advance_to(std::min({target, from + pace_.slice(), next_checkpoint_}));
    record_.seconds.solve += watch.seconds();
    record_.reached = simulation_->time();
    record_.steps = simulation_->steps();
    pace_.took(record_.reached - from, watch.seconds());
    progress_.show(record_.reached / record_.until, state_line());
    if (record_.reached >= next_checkpoint_) save_checkpoint();
    if (since_saved_.seconds() > record_interval) save(RunRecord::Status::running);
  }
}

/// The state at hand goes into the history and before the judge.
void Run::look() {
  const Timed timed(record_.seconds.write);
  history_agenda_.reached(record_.reached);
  const Snapshot& now = simulation_->snapshot();
  const Balance sums = balance(now, plan_.file.scene);
  const Readings readings = gauge_(now);
  judge_.look(now, sums, readings);
  drift_.look(sums);
  history_->add(*simulation_, sums, judge_.pieces(), readings);
  for (std::size_t k = 0; k < readings.size(); ++k) record_.indicator[k].look(readings[k], now.time);
  take_verdict();
  if (record_.verdict == Verdict::diverged) result_.failure = describe_divergence(now, sums);
}

void Run::take_verdict() {
  record_.pieces = judge_.pieces();
  record_.verdict = judge_.verdict();
  record_.since = judge_.since();
}

void Run::sample_lines() {
  const Timed timed(record_.seconds.write);
  lines_.look(simulation_->snapshot());
  if (lines_file_) lines_file_->add(lines_.samples());
}

void Run::show_what_is_due() {
  // several frames may show one step, where they are asked for closer together than the steps are
  for (int due = frame_agenda_.reached(record_.reached); due > 0; --due) {
    if (frames_) frames_->add(simulation_->snapshot());
    if (particles_) particles_->add(simulation_->snapshot());
  }
}

/// False if it was interrupted.
bool Run::draw_the_rest() {
  if (!frames_ || frames_->kept() == 0) return true;
  const int count = frames_->kept();
  const bool asked_before = interrupts_.asked();  // what there is of an interrupted run is drawn all the same
  progress_.begin("drawing " + std::to_string(count) + " frames");
  const bool all = frames_->draw_kept([&](int drawn) {
    progress_.show(static_cast<double>(drawn) / count, "frame " + std::to_string(drawn + 1));
    return asked_before || !interrupts_.asked();
  });
  progress_.end(std::to_string(frames_->written()) + " frames");
  return all;
}

void Run::save(RunRecord::Status status) {
  since_saved_ = {};
  record_.status = status;
  record_.conservation = drift_.conservation(exchanges_momentum_);
  record_.measures = measure(plan_.file.scene, simulation_->series(), record_.material_law, lines_.samples(),
                             &simulation_->snapshot());
  if (frames_) result_.frames = frames_->written();
  if (particles_) particles_->save_index();
  write_atomically(plan_.folder.record(), to_json(record_).dump(2) + "\n");
}

std::string Run::state_line() const {
  std::string text = "t = " + brief(record_.reached) + " s";
  if (const auto speed = record_.particle_steps_per_second())
    text += ", " + with_prefix(*speed) + " particle-steps/s";
  return text;
}

LineRecorder start_lines(const SceneFile& file, const Simulation& simulation) try {
  return {file.scene, simulation.snapshot(), simulation.support()};
} catch (const SceneError& e) {
  throw locate(file, e);
}

RunRecord new_record(const RunPlan& plan, const Simulation& simulation) {
  const SceneFile& file = plan.file;
  const Snapshot& start = simulation.snapshot();
  RunRecord record;
  record.scene = file.scene.name;
  record.method = file.settings.method;
  const MethodInfo& method = *find_method(record.method);
  record.material_law = material_law(method, plan.file.settings);
  if (plan.file.scene.bodies.size() > 1 || !plan.file.scene.walls.empty())
    record.contact = std::string(name(contact_law(plan.file.scene, method)));
  record.stepping = file.settings.stepping == Stepping::single ? "single" : "dual";
  record.cfl = file.settings.cfl;
  record.parameters = file.parameters;
  record.dim = file.scene.dim;
  record.spacing = file.scene.spacing;
  if (const auto asked = plan.spacing_asked;
      asked && std::abs(*asked - record.spacing) > 1e-9 * record.spacing)
    record.spacing_asked = asked;
  record.particles = static_cast<long>(start.size());
  record.mass = std::accumulate(start.m.begin(), start.m.end(), 0.0);
  record.until = file.scene.until;
  record.threads = simulation.threads();
  record.machine = machine_name();
  return record;
}

}  // namespace

std::unique_ptr<Simulation> start(const SceneFile& file) try {
  return make_simulation(file.scene, file.settings);
} catch (const SceneError& e) {
  throw locate(file, e);
}

RunResult run_scene(const RunPlan& plan, const Interrupts& interrupts, Progress& progress,
                    double setup_seconds) {
  const Stopwatch watch;
  std::unique_ptr<Simulation> simulation = start(plan.file);
  RunRecord record = new_record(plan, *simulation);
  record.seconds.setup = setup_seconds + watch.seconds();
  LineRecorder lines = start_lines(plan.file, *simulation);
  return Run(plan, std::move(simulation), std::move(lines), interrupts, progress, std::move(record))
      .execute();
}

}  // namespace taut::cli
