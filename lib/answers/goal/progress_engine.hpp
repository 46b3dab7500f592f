#pragma once

#include "answers/analysis_context.hpp"

namespace coordreq {

/// The engine that reads nearness to a goal: a post that leaves through a `safe` side does not come nearer to
/// the goal, and is read as blocked. (Contract, section 5: T has an infinite arrival there, and a pair that
/// may leave through a `goal` side too makes no progress.) Where no side is `safe` it is the engine of the
/// context. Else tables are held a second time, as their rows are cut differently.
class ProgressEngine {
 public:
  /// @pre `context` is set up. @pre unchecked: `context` outlives this object
  explicit ProgressEngine(const AnalysisContext& context);
  ProgressEngine(const ProgressEngine&) = delete;
  ProgressEngine& operator=(const ProgressEngine&) = delete;
  ~ProgressEngine() = default;

  [[nodiscard]] const RowEngine& engine() const { return engine_ ? *engine_ : *context_->engine; }
  [[nodiscard]] const RowHull& hull() const { return hull_ ? *hull_ : *context_->hull; }
  /// The tiles of the context if this is its engine, else null.
  [[nodiscard]] const Tiles* equal_work() const { return engine_ ? nullptr : context_->equal_work(); }

 private:
  const AnalysisContext* context_;
  std::optional<Abstraction> abstraction_;
  std::optional<RowEngine> engine_;
  std::optional<RowHull> hull_;
};

}  // namespace coordreq
