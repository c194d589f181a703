// A play of a cluster whose ranks are processes of MPI. tests/scheduler/cluster/mpirun.sh runs it.

#include <csignal>
#include <graze/cluster/mpi.hpp>

#include "scheduler/cluster/cluster_play.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// MPI for the life of the program.
class Mpi {
 public:
  Mpi() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  }
  ~Mpi() { MPI_Finalize(); }
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;
};

PlaySettings play_of_all() {
  PlaySettings settings;
  settings.scene = settings_of(0.2, 0.5, ContactDetail::nearest);
  settings.scene.threads = 1;
  settings.swept = settings.self = settings.solids = true;
  settings.frames = 30;
  settings.objects = 24;
  return settings;
}

}  // namespace

TEST_CASE("as one scene") {
  const Mpi mpi;
  const PlaySettings settings = play_of_all();
  const auto frames = calls_of(settings);
  const auto one = played_by_one(settings, frames);
  for (const std::optional<double> max_imbalance : {std::optional<double>(), std::optional<double>(1.05)}) {
    PlayingRank rank(settings, cluster::mpi_transport(MPI_COMM_WORLD), {max_imbalance});
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      INFO("frame " << frame + 1);
      rank.take(frames[frame]);
      (void)rank.scene.step();
      const cluster::Report all = rank.scene.gather();
      REQUIRE((all != nullptr) == (rank.scene.rank() == 0));
      if (all != nullptr) REQUIRE(texts_of(*all) == one[frame]);
    }
  }
}

TEST_CASE("killed") {
  const Mpi mpi;
  const PlaySettings settings = play_of_all();
  const auto frames = calls_of(settings);
  PlayingRank rank(settings, cluster::mpi_transport(MPI_COMM_WORLD));
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    if (frame == 10 && rank.scene.rank() == 1) std::raise(SIGKILL);
    rank.take(frames[frame]);
    (void)rank.scene.step();
  }
}

}  // namespace graze::tests
