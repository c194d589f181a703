#pragma once

#include <graze/report.hpp>
#include <vector>

#include "calls/calls.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"
#include "step/step_reserve.hpp"

namespace graze {

/// Applies the calls of a step, each by `applier(call)`. Most are for the objects, some for the filters of
/// pairs or for the reserve. Stepping thread only.
class CallApplier {
 public:
  CallApplier(ObjectStore& store, PairFilter& filter, StepReserve& reserve,
              std::vector<Diagnostic>& diagnostics)
      : store_(store), filter_(filter), reserve_(reserve), diagnostics_(diagnostics) {}

  void operator()(Diagnostic& diagnostic);
  void operator()(SetRule& call);
  void operator()(IgnorePair& call);
  void operator()(IgnoreGroups& call);
  void operator()(RemoveObject& call);
  void operator()(RefusePose& call);
  void operator()(BindPositions& call);
  void operator()(UnbindPositions& call);
  void operator()(Reserve& call);
  void operator()(AddObject& call);
  void operator()(ReplaceMesh& call);
  template <typename Other>
  void operator()(Other& call) {
    store_.apply(call);
  }

  /// Whether the step has to look at pairs even if no object has changed.
  [[nodiscard]] bool concerns_pairs() const { return concerns_pairs_; }

 private:
  ObjectStore& store_;
  PairFilter& filter_;
  StepReserve& reserve_;
  std::vector<Diagnostic>& diagnostics_;
  bool concerns_pairs_ = false;
};

}  // namespace graze
