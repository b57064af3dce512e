#include "cli/run/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/core.h>

#include "cli/run/checkpoint.hpp"
#include "cli/run/outputs.hpp"
#include "cli/run/report.hpp"
#include "cli/run/schedule.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/machine.hpp"
#include "cli/text/format.hpp"
#include "engine/core/team.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"
#include "engine/warnings.hpp"

namespace taut::cli {
namespace {

constexpr double record_interval = 5.0;  // s, for run.json

class Run {
 public:
  Run(const RunPlan& plan, std::unique_ptr<Simulation> simulation, const Interrupts& interrupts,
      Progress& progress, RunRecord record);
  Run(const Run&) = delete;  // its parts refer to one another
  Run& operator=(const Run&) = delete;

  RunResult execute();

 private:
  void begin();
  void resume_from(const std::string& state);
  void load(const std::string& state);
  void open_files(AppendFile::Start start);
  std::string state();
  void save_checkpoint();
  void put_on_disk();
  void write_checkpoint(std::string state) const;
  void plan_next_checkpoint();
  void simulate();
  void step_through();
  bool has_deferred_work() const;
  double next_output() const;
  double next_between_steps() const;
  void show_what_is_due(bool at_end);
  void advance(double target);
  void step_to(double target);
  bool complete();
  RunRecord::Status how_it_ended() const;
  void save(RunRecord::Status status);
  void save_failure(const std::string& reason);
  std::string record_text() const;
  void write_record() const;
  std::string state_line() const;

  const RunPlan& plan_;
  std::unique_ptr<Simulation> simulation_;
  const Interrupts& interrupts_;
  Progress& progress_;
  RunResult result_;
  RunRecord& record_ = result_.record;
  LastStep last_step_;
  std::vector<std::unique_ptr<RunOutput>> outputs_;
  Pace pace_;
  Stopwatch since_saved_;
  double next_checkpoint_ = std::numeric_limits<double>::infinity();  // s
  std::optional<std::string> final_state_;
};

Run::Run(const RunPlan& plan, std::unique_ptr<Simulation> simulation, const Interrupts& interrupts,
         Progress& progress, RunRecord record)
    : plan_(plan),
      simulation_(std::move(simulation)),
      interrupts_(interrupts),
      progress_(progress),
      result_{std::move(record), 0, {}, ""},
      last_step_(*simulation_),
      outputs_(make_outputs(plan, *simulation_, last_step_, result_)),
      pace_(record_.until) {
  simulation_->set_stop_flag(Interrupts::flag());
}

RunResult Run::execute() {
  if (!plan_.state) plan_.folder.claim(record_text());
  if (plan_.state) resume_from(*plan_.state);  // a UsageError leaves all files unchanged
  try {
    if (!plan_.state) begin();
    simulate();
    const RunRecord::Status status = how_it_ended();
    using enum RunRecord::Status;
    put_on_disk();
    save(status == finished ? running : status);  // frames may be missing
    const bool all_done = complete();
    put_on_disk();  // before run.json reports the end
    const bool keeps = final_state_ && (plan_.keep_checkpoint || !all_done);
    if (keeps) write_checkpoint(*final_state_);
    save(status == finished && !all_done ? interrupted : status);
    if (all_done && record_.status != interrupted && !keeps) plan_.folder.clear_checkpoint();
  } catch (...) {
    save_failure(current_failure().message);
    throw;
  }
  return std::move(result_);
}

/// Restart files come first: the run may be killed.
void Run::begin() {
  write_atomically(plan_.folder.scene(), plan_.scene_text(), Durability::on_disk);
  plan_.checkpoint_every ? write_checkpoint("") : plan_.folder.clear_checkpoint();
  plan_.folder.clear();
  open_files(AppendFile::Start::empty);
  plan_next_checkpoint();
}

void Run::resume_from(const std::string& state) {
  const double setup = record_.seconds.setup;
  open_files(AppendFile::Start::as_it_is);
  try {
    load(state);
  } catch (const UsageError& e) {
    throw UsageError(fmt::format("'{}' cannot be used: {}", plan_.folder.checkpoint().string(), e.what()));
  }
  if (plan_.runs_on)
    for (const auto& output : outputs_) output->run_on();
  for (const auto& output : outputs_) output->discard_newer();
  record_.seconds.setup += setup;
  record_.reached = simulation_->time();
  record_.steps = simulation_->steps();
  plan_next_checkpoint();
  save(RunRecord::Status::running);
  if (!plan_.runs_on) return;
  save_checkpoint();
  write_atomically(plan_.folder.scene(), plan_.scene_text(), Durability::on_disk);
}

void Run::load(const std::string& state) {
  Loader loader(state);
  std::string simulation;
  loader(simulation, record_.seconds);
  for (const auto& output : outputs_) output->load(loader);
  loader.finish();
  simulation_->load(simulation);
  if (!plan_.runs_on)
    loader.check("the time of the next output", [&] { return next_output() > simulation_->time(); });
}

void Run::open_files(AppendFile::Start start) {
  for (const auto& output : outputs_) output->open(start);
}

/// The state refers to files, which must be on disk.
std::string Run::state() {
  put_on_disk();
  const Timed timed(record_.seconds.write);
  Saver saver;
  std::string simulation = simulation_->save();
  saver(simulation, record_.seconds);
  for (const auto& output : outputs_) output->save(saver);
  return saver.take();
}

void Run::save_checkpoint() {
  write_checkpoint(state());
  plan_next_checkpoint();
}

void Run::put_on_disk() {
  for (const auto& output : outputs_) output->wait();
  const Timed timed(record_.seconds.write);
  for (const auto& output : outputs_) output->put_on_disk();
}

void Run::write_checkpoint(std::string state) const {
  Checkpoint checkpoint{record_.method,
                        plan_.scene_text(),
                        {},
                        plan_.particle_form,
                        plan_.requested_spacing,
                        plan_.checkpoint_every.value_or(0),
                        plan_.drawing.has_value(),
                        std::move(state)};
  for (const Field* field : plan_.particle_fields) checkpoint.fields.emplace_back(field->key);
  cli::write_checkpoint(plan_.folder.checkpoint(), std::move(checkpoint));
}

void Run::plan_next_checkpoint() {
  if (!plan_.checkpoint_every) return;
  const double every = *plan_.checkpoint_every;
  next_checkpoint_ = std::fmax((std::floor(record_.reached / every) + 1) * every,
                               std::nextafter(record_.reached, record_.until));
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
  progress_.begin(
      fmt::format("{}, {}, {} particles", plan_.file.scene.name, record_.method, record_.particles),
      record_.reached / record_.until);
  if (!plan_.state)
    for (const auto& output : outputs_) output->write_due();
  for (bool going = result_.failure.empty(); going;) {
    advance(std::min({next_output(), next_checkpoint_, record_.until}));
    const bool stopped = interrupts_.interrupted();
    show_what_is_due(false);
    // the checkpoint precedes the final row, which a continued run must not have
    const bool well = result_.failure.empty();
    if (well && (stopped || record_.reached >= next_checkpoint_)) save_checkpoint();
    going = well && !stopped && record_.reached < record_.until;
    if (well && record_.reached >= record_.until && (plan_.keep_checkpoint || has_deferred_work()))
      final_state_ = state();
  }
  show_what_is_due(true);
  progress_.end(state_line());
}

bool Run::has_deferred_work() const {
  return std::ranges::any_of(outputs_, [](const auto& output) { return output->has_deferred_work(); });
}

double Run::next_output() const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& output : outputs_) next = std::min(next, output->next());
  return next;
}

/// Time of the next interpolated output, in s.
double Run::next_between_steps() const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& output : outputs_)
    if (output->needs_exact_time()) next = std::min(next, output->next());
  return next;
}

void Run::show_what_is_due(bool at_end) {
  for (const auto& output : outputs_) {
    if (!result_.failure.empty()) return;
    if (output->next() <= record_.reached || (at_end && output->needs_final_state())) output->write_due();
  }
}

/// Slices, for progress and run.json, do not change the steps.
void Run::advance(double target) {
  while (record_.reached < target && !interrupts_.interrupted()) {
    const Stopwatch watch;
    const double from = record_.reached;
    step_to(std::min(target, from + pace_.slice()));
    record_.reached = simulation_->time();
    record_.steps = simulation_->steps();
    pace_.took(record_.reached - from, watch.seconds());
    progress_.show(record_.reached / record_.until, state_line());
    if (since_saved_.seconds() > record_interval) save(RunRecord::Status::running);
  }
}

/// Stores the state before an interpolated output.
void Run::step_to(double target) {
  const auto advance = [&](double short_of) {
    const Timed timed(record_.seconds.solve);
    const double cpu = Team::own().cpu_seconds();
    simulation_->advance(target, short_of);
    record_.seconds.cpu += Team::own().cpu_seconds() - cpu;
  };
  advance(next_between_steps());
  if (simulation_->time() >= target) return;
  {
    const Timed timed(record_.seconds.write);
    last_step_.begin();
  }
  advance(std::numeric_limits<double>::infinity());
}

RunRecord::Status Run::how_it_ended() const {
  if (!result_.failure.empty()) return RunRecord::Status::failed;
  return record_.reached >= record_.until ? RunRecord::Status::finished : RunRecord::Status::interrupted;
}

bool Run::complete() {
  return std::ranges::all_of(outputs_,
                             [&](const auto& output) { return output->complete(interrupts_, progress_); });
}

void Run::save(RunRecord::Status status) {
  since_saved_ = {};
  record_.status = status;
  record_.reason = result_.failure;
  for (const auto& output : outputs_) output->update_result();
  write_record();
}

std::string Run::record_text() const { return to_json(record_).dump(2) + "\n"; }

void Run::write_record() const {
  write_atomically(plan_.folder.record(), record_text(), Durability::on_disk);
}

/// Tries each part, even with a full disk.
void Run::save_failure(const std::string& reason) {
  const auto tried = [](const auto& work) {
    try {
      work();
    } catch (...) {
    }
  };
  for (const auto& output : outputs_) {
    tried([&] { output->wait(); });
    tried([&] { output->update_result(); });
  }
  record_.status = RunRecord::Status::failed;
  record_.reason = reason;
  tried([&] { write_record(); });
}

std::string Run::state_line() const {
  std::string text = fmt::format("t = {} s", brief(record_.reached));
  if (const auto speed = record_.particle_steps_per_second())
    text += fmt::format(", {} particle-steps/s", with_prefix(*speed));
  return text;
}

RunRecord new_record(const RunPlan& plan, const Simulation& simulation) {
  const SceneFile& file = plan.file;
  const Snapshot& start = simulation.snapshot();
  RunRecord record;
  record.scene = file.scene.name;
  record.method = file.settings.method;
  const MethodInfo& method = *find_method(record.method);
  record.material_law = material_law(method, plan.file.settings, plan.file.scene.dim);
  record.remark = file.remark;
  for (const std::string& warning : warnings_at_start(file.scene, method, simulation))
    record.remark += (record.remark.empty() ? "" : "; ") + warning;
  if (plan.file.scene.bodies.size() > 1 || !plan.file.scene.walls.empty())
    record.contact = std::string(name(contact_law(plan.file.scene, method)));
  record.stepping = file.find_resolved("stepping")->value;
  record.cfl = file.settings.cfl;
  for (const Parameter& p : file.parameters) record.parameters.emplace_back(p.name, p.value);
  record.dim = file.scene.dim;
  record.spacing = file.scene.spacing;
  if (const auto asked = plan.requested_spacing;
      asked && std::abs(*asked - record.spacing) > 1e-9 * record.spacing)
    record.requested_spacing = asked;
  record.jitter = file.scene.jitter;
  record.file_checksum = plan.file_checksum;
  record.saved_particles = plan.saved_particles();
  record.particles = static_cast<long>(start.size());
  record.mass = std::accumulate(start.m.begin(), start.m.end(), 0.0);
  record.until = file.scene.until;
  record.threads = simulation.threads();
  record.machine = machine_name();
  return record;
}

}  // namespace

std::optional<SavedParticles> RunPlan::saved_particles() const {
  if (particle_fields.empty()) return std::nullopt;
  SavedParticles saved{
      std::string(name(particle_form.format)), particle_form.single_precision ? "single" : "double", {}};
  for (const Field* field : particle_fields) saved.fields.emplace_back(field->key);
  return saved;
}

std::unique_ptr<Simulation> start(const SceneFile& file) try {
  return make_simulation(file.scene, file.settings);
} catch (const SceneError& e) {
  throw locate(file, e);
}

RunResult run_scene(const RunPlan& plan, const Interrupts& interrupts, Progress& progress,
                    double setup_seconds, const std::function<void()>& before_it_begins) {
  const Stopwatch watch;
  const Provenance provenance;
  std::unique_ptr<Simulation> simulation;
  {
    const Interrupts::ExitOnSignal nothing_to_lose;
    progress.prepare(fmt::format("{}, {}, setting up ...", plan.file.scene.name, plan.file.settings.method));
    simulation = start(plan.file);
  }
  RunRecord record = new_record(plan, *simulation);
  record.seconds.setup = setup_seconds + watch.seconds();
  record.provenance = provenance;
  Run run(plan, std::move(simulation), interrupts, progress, std::move(record));
  if (before_it_begins) {
    progress.clear();
    before_it_begins();
  }
  return run.execute();
}

}  // namespace taut::cli
