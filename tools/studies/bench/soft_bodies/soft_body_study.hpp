#pragma once

#include <cstddef>
#include <vector>

#include "bench/peer_module.hpp"
#include "bench/soft_bodies/soft_body_scenes.hpp"
#include "bench/soft_bodies/soft_body_sources.hpp"
#include "bench/soft_bodies/vertices_through.hpp"
#include "examples/support/world.hpp"
#include "figures/result_table.hpp"

namespace graze::bench {

/// Describes how a scene went with one source of contacts. Times are medians of the frames.
struct SoftBodyFigures {
  std::size_t through = 0;       ///< vertices through after the last frame
  std::size_t most_through = 0;  ///< after any frame
  double contacts = 0;           ///< of a look, median
  double look_ms = 0;            ///< a frame, to look for contacts and to make constraints of them
  double frame_ms = 0;           ///< a frame, with the solver
};

/// One play of a scene on one thread.
class SoftBodyRun {
 public:
  explicit SoftBodyRun(const SoftBodyScene& scene);

  /// Plays the next frame under contacts of a source.
  void frame(ContactSource& source);

  [[nodiscard]] examples::World& world() { return world_; }
  /// Returns what each body is.
  [[nodiscard]] const std::vector<SoftBodyKind>& kinds() const { return kinds_; }
  [[nodiscard]] SoftBodyFigures figures() const;

 private:
  const SoftBodyScene& scene_;
  examples::World world_;
  std::vector<SoftBodyKind> kinds_;
  VerticesThrough referee_;
  std::vector<examples::ContactConstraint> constraints_;
  std::vector<std::size_t> through_;  ///< of each frame, as what follows but contacts
  std::vector<double> look_ms_;
  std::vector<double> frame_ms_;
  std::vector<double> contacts_;  ///< of each look
};

/// Plays scenes with graze and with Bullet as the source of contacts, frame by frame in turn. Where the
/// module lacks Bullet's soft bodies, there are graze's rows alone.
tools::ResultTable compare_soft_bodies(const PeerModule& module, std::size_t frames);

}  // namespace graze::bench
