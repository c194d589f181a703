// Surgery: two organs that touch, and two rigid instruments. The organs deform at 62.5 Hz, on one thread with
// graze's step. A thread at 1 kHz computes the forces that the hands feel.
//
// Each instrument has a proxy, which stays outside the organs while the hand goes in. A spring between the
// two gives the force. graze sees the proxies. So contacts are those of surfaces that hardly touch. The ways
// out of a deep place would turn from one moment to the next.
//
// A step takes longer than a millisecond, so most ticks have no new report. The 1 kHz thread takes the latest
// one, and asks the patch of each instrument for the contacts where its proxy is now. graze::follow() moves
// them to where the organs are now. Beside it the program computes the force from the contacts of the reports
// alone, which jumps with each new report.
//
// With --deterministic ticks are counted and not timed: a step sees the scene of tick 16 k, and its report is
// there from tick 16 k + 8 on. Otherwise two threads run at 1 kHz: one reads reports, and one does without
// graze and shows how late the machine wakes threads up.

#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <graze/graze.hpp>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "examples/loops/events.hpp"
#include "examples/loops/haptic_reader.hpp"
#include "examples/loops/options.hpp"
#include "examples/support/record_option.hpp"

namespace {

using loops::Clock;

constexpr double organ_distance = 0.5;  // mm, between the organs
constexpr double largest_force = 10;    // N, that no tick may exceed
constexpr double jump = 0.1;            // N

enum Kind : std::uint32_t { organ_kind = 1, instrument_kind = 2 };

/// The organs, the instruments, and the scene that looks at them.
class Simulation {
 public:
  explicit Simulation(loops::Organs organs)
      : organs_(std::move(organs)), history_(organs_), scene_(settings()) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      meshes_.push_back(loops::make_mesh(organs_.shapes[i]));
      ids_.push_back(add(meshes_.back(), organs_.names[i], graze::Motion::deformable, organ_kind, i));
      const Eigen::Vector3d outward = Eigen::Vector3d(i == 0 ? -0.2 : 0.2, -0.3, 1).normalized();
      instruments_.emplace_back(furthest(i, outward), outward, 2.0 * static_cast<double>(i));
    }
    for (std::uint64_t i = 0; i < 2; ++i)
      instrument_ids_.push_back(add(instruments_[i].mesh(), "instrument " + std::to_string(i + 1),
                                    graze::Motion::rigid, instrument_kind, loops::first_instrument + i));
    scene_.set_rule(organ_kind, organ_kind, {organ_distance, 0, {}});
  }

  /// Deforms the organs, and puts the instruments where their proxies are.
  void prepare(std::uint64_t frame, double time, const std::array<loops::Held, 2>& held) {
    loops::Snapshot& snapshot = history_.begin_frame(frame);
    snapshot.begin = Clock::now();
    for (std::size_t i = 0; i < 2; ++i) {
      deform(organs_.shapes[i], time, snapshot.points[i]);
      scene_.set_positions(ids_[i], snapshot.points[i]);
      Eigen::Isometry3d pose = held[i].hand;
      pose.translation() = held[i].proxy;
      scene_.set_pose(instrument_ids_[i], pose);
    }
    snapshot.held = held;
  }

  loops::HapticReader reader() { return {scene_, history_, {instruments_, instrument_ids_, meshes_, ids_}}; }
  graze::Scene& scene() { return scene_; }
  [[nodiscard]] const loops::Organs& organs() const { return organs_; }

 private:
  static graze::SceneSettings settings() {
    graze::SceneSettings settings;
    settings.contact_distance = loops::contact_distance;
    settings.detail = graze::ContactDetail::nearest;
    settings.threads = 1;
    return settings;
  }

  graze::ObjectId add(const std::shared_ptr<const graze::Mesh>& mesh, const std::string& name,
                      graze::Motion motion, Kind kind, std::uint64_t user_data) {
    graze::ObjectSettings object;
    object.name = name;
    object.motion = motion;
    object.kind = kind;
    object.solid = true;
    object.user_data = user_data;
    if (kind == instrument_kind) object.patch_radius = loops::patch_radius;
    return scene_.add(mesh, object);
  }

  /// Returns the vertex of an organ that lies furthest in a direction.
  [[nodiscard]] Eigen::Vector3d furthest(std::size_t organ, const Eigen::Vector3d& direction) const {
    Eigen::Vector3d best = organs_.shapes[organ].points[0].cast<double>();
    for (const Eigen::Vector3f& point : organs_.shapes[organ].points)
      if (direction.dot(point.cast<double>()) > direction.dot(best)) best = point.cast<double>();
    return best;
  }

  loops::Organs organs_;
  loops::OrganHistory history_;
  graze::Scene scene_;
  std::vector<std::shared_ptr<const graze::Mesh>> meshes_;
  std::vector<graze::ObjectId> ids_, instrument_ids_;
  std::vector<loops::Instrument> instruments_;
};

/// Follows one force from tick to tick.
struct ForceTrack {
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  double largest = 0, largest_jump = 0;
  std::size_t jumps = 0, ticks_with_force = 0;
  bool is_finite = true;

  void take(const Eigen::Vector3d& force) {
    const double change = (force - last).norm();
    jumps += change > jump;
    largest_jump = std::max(largest_jump, change);
    largest = std::max(largest, force.norm());
    ticks_with_force += force.norm() > 0;
    is_finite = is_finite && force.allFinite();
    last = force;
  }
};

struct ForceTracks {
  ForceTrack moved[2], unlimited[2], report[2];

  void take(const loops::HapticReader& reader) {
    for (std::size_t i = 0; i < 2; ++i) {
      moved[i].take(reader.forces(i).moved);
      unlimited[i].take(reader.forces(i).unlimited);
      report[i].take(reader.forces(i).report);
    }
  }
};

/// The findings of the simulation's own loop.
struct Outcome {
  loops::EventCheck events;
  std::size_t frames = 0, contacts = 0, diagnostics = 0;
  std::size_t incomplete = 0;  ///< ticks in which a patch did not know all contacts
  bool frames_ran_back = false;
  loops::Times steps{100000};

  void take(const graze::FrameReport& report) {
    events.take(report);
    ++frames;
    contacts += report.contacts().size();
    diagnostics += report.diagnostics().size();
    steps.add(report.statistics().times.step_ms);
  }
};

void run_counted(Simulation& simulation, int ticks, ForceTracks& tracks, Outcome& outcome) {
  loops::HapticReader reader = simulation.reader();
  std::uint64_t frame = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    const double time = 0.001 * tick;
    if (tick % 16 == 0) simulation.prepare(++frame, time, reader.held());
    if (tick % 16 == 8) outcome.take(*simulation.scene().step(frame));
    if (reader.tick(time)) tracks.take(reader);
  }
  outcome.incomplete = reader.incomplete();
}

/// The times that a thread at 1 kHz measures, in ms.
struct ThreadTimes {
  explicit ThreadTimes(std::size_t ticks)
      : late(ticks), age(ticks), read(ticks), work(ticks), processor(ticks) {}
  loops::Times late;       ///< how late the thread wakes up
  loops::Times age;        ///< how long before the read the frame began that is read
  loops::Times read;       ///< how long the read takes
  loops::Times work;       ///< how long the whole tick takes
  loops::Times processor;  ///< how long a processor works on it
};

/// Hands the held instruments from the 1 kHz thread to the simulation. Neither waits: the reader tries again
/// if the writer came in between, and takes what it had before if that happens time after time.
class SharedHeld {
 public:
  explicit SharedHeld(const std::array<loops::Held, 2>& held) : last_(held) { store(held); }
  void store(const std::array<loops::Held, 2>& held) {
    const std::uint64_t begun = version_.load() + 1;
    version_.store(begun);
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 16; ++j) numbers_[19 * i + j].store(held[i].hand.data()[j]);
      for (std::size_t j = 0; j < 3; ++j) numbers_[19 * i + 16 + j].store(held[i].proxy.data()[j]);
    }
    version_.store(begun + 1);
  }
  const std::array<loops::Held, 2>& load() {
    for (int attempt = 0; attempt < 10; ++attempt) {
      const std::uint64_t before = version_.load();
      std::array<loops::Held, 2> held;
      for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 16; ++j) held[i].hand.data()[j] = numbers_[19 * i + j].load();
        for (std::size_t j = 0; j < 3; ++j) held[i].proxy.data()[j] = numbers_[19 * i + 16 + j].load();
      }
      if (before % 2 != 0 || version_.load() != before) continue;
      last_ = held;
      break;
    }
    return last_;
  }

 private:
  std::atomic<std::uint64_t> version_ = 0;  ///< odd while the writer writes
  std::array<std::atomic<double>, 38> numbers_;
  std::array<loops::Held, 2> last_;
};

/// Calls `tick` with the index of each tick, a millisecond apart, and measures how late it is.
template <typename Tick>
void run_at_1_khz(int ticks, Clock::time_point start, ThreadTimes& times, const Tick& tick) {
  for (int i = 0; i < ticks; ++i) {
    const Clock::time_point due = start + std::chrono::milliseconds(i);
    std::this_thread::sleep_until(due);
    const Clock::time_point begin = Clock::now();
    const double processor_begin = loops::processor_milliseconds();
    times.late.add(loops::milliseconds(due, begin));
    tick(begin);
    times.work.add(loops::milliseconds(begin, Clock::now()));
    times.processor.add(loops::processor_milliseconds() - processor_begin);
  }
}

void run_timed(Simulation& simulation, int ticks, ForceTracks& tracks, Outcome& outcome, ThreadTimes& haptic,
               ThreadTimes& control) {
  const Clock::time_point start = Clock::now();
  std::atomic<Clock::rep> published = 0;  // when the frame began whose report is the latest, for the control
  SharedHeld shared(simulation.reader().held());
  std::thread haptic_thread([&] {
    loops::HapticReader reader = simulation.reader();
    std::uint64_t last_frame = 0;
    run_at_1_khz(ticks, start, haptic, [&](Clock::time_point now) {
      if (!reader.tick(1e-3 * loops::milliseconds(start, now))) return;
      shared.store(reader.held());
      tracks.take(reader);
      outcome.frames_ran_back = outcome.frames_ran_back || reader.frame() < last_frame;
      last_frame = reader.frame();
      haptic.age.add(loops::milliseconds(reader.frame_begin(), now));
      haptic.read.add(reader.read_ms());
    });
    outcome.incomplete = reader.incomplete();
  });
  std::thread control_thread([&] {
    run_at_1_khz(ticks, start, control, [&](Clock::time_point now) {
      const Clock::rep begin = published.load();
      control.read.add(loops::milliseconds(now, Clock::now()));
      if (begin != 0) control.age.add(loops::milliseconds(Clock::time_point(Clock::duration(begin)), now));
    });
  });
  const auto frames = static_cast<std::uint64_t>(ticks / 16);
  for (std::uint64_t frame = 1; frame <= frames; ++frame) {
    std::this_thread::sleep_until(start + std::chrono::milliseconds(16 * (frame - 1)));
    const Clock::time_point begin = Clock::now();
    simulation.prepare(frame, 1e-3 * loops::milliseconds(start, begin), shared.load());
    outcome.take(*simulation.scene().step(frame));
    published.store(begin.time_since_epoch().count());
  }
  haptic_thread.join();
  control_thread.join();
}

void print(const char* name, const loops::Times& haptic, const loops::Times& control) {
  std::printf("  %-24s p50 %7.4f  p99.9 %7.4f  worst %7.4f ms | without graze %7.4f %7.4f %7.4f ms\n", name,
              haptic.percentile(0.5), haptic.percentile(0.999), haptic.percentile(1), control.percentile(0.5),
              control.percentile(0.999), control.percentile(1));
}

void print(const char* name, const ForceTrack& track) {
  std::printf("  %-32s %6zu ticks with force, largest %6.3f N; %4zu jumps above %.1f N, the largest %.3f N\n",
              name, track.ticks_with_force, track.largest, track.jumps, jump, track.largest_jump);
}

/// Ends the program with exit code 2 if the organs cannot be read.
loops::Organs organs_or_exit(const loops::Options& options) {
  try {
    return load_organs(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "surgery_loop: %s\n", error.what());
    std::exit(2);
  }
}

bool hold(const ForceTrack& track) {
  return track.is_finite && track.largest < largest_force;
}

}  // namespace

int main(int argc, char** argv) {
  const loops::Options options = loops::read_options(argc, argv);
  const int ticks = options.length > 0 ? options.length : 6000;
  Simulation simulation(organs_or_exit(options));
  const loops::Organs& organs = simulation.organs();
  for (std::size_t i = 0; i < 2; ++i)
    std::printf("%s: %zu vertices\n", organs.names[i].c_str(), organs.shapes[i].points.size());
  std::printf("both were %s\n", organs.source.c_str());
  const std::unique_ptr<graze::Recorder> recorder =
      examples::make_recorder(options.record, simulation.scene());

  ForceTracks tracks;
  Outcome outcome;
  const auto count = static_cast<std::size_t>(ticks);
  ThreadTimes haptic(count), control(count);
  if (options.deterministic) run_counted(simulation, ticks, tracks, outcome);
  if (!options.deterministic) run_timed(simulation, ticks, tracks, outcome, haptic, control);

  std::printf("%zu frames, %zu contacts in each; graze's step: median %.3f ms, worst %.3f ms\n",
              outcome.frames, outcome.contacts / std::max<std::size_t>(outcome.frames, 1),
              outcome.steps.percentile(0.5), outcome.steps.percentile(1));
  if (!options.deterministic) {
    print("wakes up late by", haptic.late, control.late);
    print("age of what is read", haptic.age, control.age);
    print("time of the read", haptic.read, control.read);
    print("time of the whole tick", haptic.work, control.work);
    print("processor time of a tick", haptic.processor, control.processor);
  }
  std::printf("%zu answers of patches were not complete\n", outcome.incomplete);
  bool holds = outcome.diagnostics == 0 && outcome.events.mistakes() == 0 && !outcome.frames_ran_back &&
               (outcome.incomplete == 0 || !options.deterministic);
  for (std::size_t i = 0; i < 2; ++i) {
    std::printf("instrument %zu\n", i + 1);
    print("the patch, and follow()", tracks.moved[i]);
    print("the same, any step of the proxy", tracks.unlimited[i]);
    print("contacts as in the report", tracks.report[i]);
    holds = holds && hold(tracks.moved[i]) && hold(tracks.report[i]);
    if (!options.deterministic) continue;
    // With real organs, a proxy without a limit may slide as often as a report comes.
    const bool is_smoother = organs.are_real || tracks.unlimited[i].jumps < tracks.report[i].jumps;
    holds = holds && is_smoother && tracks.moved[i].ticks_with_force > 0 &&
            tracks.moved[i].jumps < tracks.report[i].jumps &&
            tracks.moved[i].largest_jump < tracks.report[i].largest_jump;
  }
  std::printf("%zu contacts began, %zu ended, %zu events without their partner\n", outcome.events.began(),
              outcome.events.ended(), outcome.events.mistakes());
  finish(options, recorder.get());
  std::printf("%s\n", holds ? "the loop holds" : "THE LOOP DOES NOT HOLD");
  return holds ? 0 : 1;
}
