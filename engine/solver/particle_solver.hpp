#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/archive.hpp"
#include "engine/core/parallel.hpp"
#include "engine/error.hpp"
#include "engine/solver/solver_parts.hpp"

namespace taut::inline TAUT_ISA {

/// A solver, which has `step`, by the time that `step_size` gives; for a snapshot `prepare_to_show`, for all
/// particles, and `show`, for those of a group of four, which may be asked for at any time between two steps;
/// and, where its steps depend on more than SolverParts, a `serialize` that begins with that of its base. Its
/// constructor ends with `record`.
template <class Solver, int Dim>
class ParticleSolver : public SolverParts<Dim> {
 public:
  void advance(double t, double short_of) final {
    const bool outdated = this->outdated_;
    const long first = this->step_;
    this->outdated_ = this->snapshot_.m.empty();  // a run that breaks off keeps the last one
    this->stepping_ = true;
    this->team_.resume();
    this->refuse_divergence();  // of the last call
    try {
      while (this->time_ < t && !this->asked_to_stop()) {
        const double dt = solver().step_size();
        if (this->time_ + dt >= short_of) break;
        solver().step(dt);
        record();
        this->team_.step_done();
      }
    } catch (NumericalError& e) {
      e.step = this->step_, e.time = this->time_;
      throw;
    }
    this->outdated_ = outdated || this->step_ > first;
  }

  std::string save() final {
    this->refuse_divergence();
    Saver saver;
    solver().serialize(saver);
    return saver.take();
  }
  void load(std::string_view state) final {
    Loader loader(state);
    solver().serialize(loader);
    loader.finish();
    loader.check("the time step", [&] { return this->time_ + solver().step_size() > this->time_; });
    this->outdated_ = true;
  }

 protected:
  using SolverParts<Dim>::SolverParts;

  /// The probes as they are now.
  void record() {
    if (this->recorder_.size() > 0) this->recorder_.record(this->s_, this->time_, *this, this->series_);
  }

 private:
  Solver& solver() { return static_cast<Solver&>(*this); }
  int groups() const { return (this->s_.size() + lanes - 1) / lanes; }

  void take_snapshot(Snapshot&) const final { const_cast<ParticleSolver*>(this)->fill_snapshot(); }
  void fill_snapshot() {
    solver().begin_snapshot();
    solver().prepare_to_show();
    parallel_pass(groups(), this->threads_now(), [&](int group) { solver().show(group); });
  }
  const Snapshot& shown(const std::vector<int>& stored) final {
    std::swap(this->snapshot_, seen_);
    if (this->snapshot_.m.empty()) solver().begin_snapshot();
    solver().prepare_to_show();
    std::set<int> groups;
    for (const int i : stored) groups.insert(i / lanes);
    for (const int group : groups) solver().show(group);
    std::swap(this->snapshot_, seen_);
    return seen_;
  }

  Snapshot seen_;  // of what probes look at only
};

}  // namespace taut::inline TAUT_ISA
