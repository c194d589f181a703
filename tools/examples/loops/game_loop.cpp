// A game: 200 animated characters and 300 rigid props on a terrain, at 60 frames a second. graze's step runs
// beside the frame's other work. Characters push props, and props push each other.
//
// A frame has five parts:
//
// 1. Animation writes the points of all characters and the poses of all props. No step runs meanwhile, since
// graze
//    reads the points where they are.
// 2. step_async() begins the step. Meanwhile the frame's other work reads the same points: steering, and
// normals.
// 3. wait() returns the report.
// 4. Begin and end events change the game: a prop hops when a character begins to touch it, and a character
//    stretches high in each step until nothing touches it.
// 5. Contacts change the velocities of props. The next frame moves them.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>
#include <string>
#include <vector>

#include "examples/loops/crowd.hpp"
#include "examples/loops/events.hpp"
#include "examples/loops/options.hpp"
#include "examples/loops/props.hpp"
#include "examples/loops/push_constraint.hpp"
#include "examples/loops/terrain.hpp"
#include "examples/loops/times.hpp"
#include "examples/support/record_option.hpp"

namespace {

constexpr double frame_time = 1.0 / 60;  // s
/// In m. What comes nearer than this in a frame is seen one frame before it touches: up to 1.8 m/s, faster
/// than anyone walks here. What is faster goes in, and is pushed out, since all surfaces are solid.
constexpr double contact_distance = 0.03;
constexpr int iterations = 8;    // over all contacts
constexpr double hop_speed = 2;  // m/s

/// The kind of an object. It stands in the upper half of its user data, and its index in the lower half.
enum class Role : std::uint64_t { ground, character, prop };

std::uint64_t user_data(Role role, std::size_t index) {
  return static_cast<std::uint64_t>(role) << 32 | index;
}
Role role_of(std::uint64_t data) {
  return static_cast<Role>(data >> 32);
}
std::size_t index_of(std::uint64_t data) {
  return data & 0xffffffff;
}

/// Returns the name under which the viewer shows an object.
std::string name_of(Role role, std::size_t index) {
  if (role == Role::ground) return "terrain";
  return (role == Role::character ? "walker " : "prop ") + std::to_string(index);
}

/// Layers. Characters walk on the ground and dodge each other by themselves, so graze need not look at that.
constexpr std::uint32_t ground_layer = 1, character_layer = 2, prop_layer = 4;

class Game {
 public:
  explicit Game(unsigned threads) : scene_(settings(threads)) {
    add(make_mesh(loops::terrain()), graze::Motion::fixed, Role::ground, 0, ground_layer, prop_layer);
    for (std::size_t i = 0; i < crowd_.characters().size(); ++i)
      scene_.bind_positions(
          add(crowd_.mesh(), graze::Motion::deformable, Role::character, i, character_layer, prop_layer),
          crowd_.characters()[i].points);
    for (std::size_t i = 0; i < props_.props().size(); ++i) {
      prop_ids_.push_back(add(props_.mesh(i), graze::Motion::rigid, Role::prop, i, prop_layer, ~0u));
      starts_.push_back(props_.props()[i].position);
    }
  }

  void animate() {
    crowd_.animate(frame_time);
    props_.move(frame_time);
    scene_.set_poses(prop_ids_, props_.poses());
  }

  void do_other_work() {
    crowd_.steer(frame_time);
    crowd_.dodge();
    crowd_.compute_normals();
  }

  /// Changes the game where two objects begin to touch or part.
  void take_events(const graze::FrameReport& report) {
    for (const graze::PairReport& pair : report.pairs()) {
      const bool began = pair.phase == graze::PairPhase::began;
      if ((!began && pair.phase != graze::PairPhase::ended) || role_of(pair.user_data_a) != Role::character)
        continue;
      crowd_.characters()[index_of(pair.user_data_a)].touches += began ? 1 : -1;
      if (began) props_.props()[index_of(pair.user_data_b)].velocity.z() += hop_speed;
    }
  }

  /// Changes the velocities of props so that no contact closes.
  void respond(const graze::FrameReport& report) {
    constraints_.clear();
    for (const graze::PairReport& pair : report.pairs()) {
      if (role_of(pair.user_data_b) != Role::prop) continue;  // of two objects, props were added last
      for (const graze::Contact& contact : report.contacts(pair)) {
        // An edge that pierces a face has no depth. The vertices that are inside push instead.
        if (contact.kind == graze::ContactKind::EF && contact.distance == 0) continue;
        constraints_.emplace_back(contact, side(pair.user_data_a, contact.feature_a, contact.point_a),
                                  side(pair.user_data_b, contact.feature_b, contact.point_b), frame_time);
      }
    }
    for (int i = 0; i < iterations; ++i)
      for (auto constraint = constraints_.rbegin(); constraint != constraints_.rend(); ++constraint)
        constraint->solve();  // those of the ground come first in a report: the last word is theirs
    props_.rest();
  }

  graze::Scene& scene() { return scene_; }

  /// Counts props that are not where they belong: on the ground, and on the terrain.
  std::size_t count_lost() {
    return count_props([](const loops::Prop& prop) {
      const Eigen::Vector3d& p = prop.position;
      const bool is_inside = p.head<2>().cwiseAbs().maxCoeff() < loops::terrain_half_width;
      const double height = p.z() - loops::ground_height(p.x(), p.y());
      return !p.allFinite() || !is_inside || height < 0 || height > 6;
    });
  }

  /// Counts props that have been moved by more than half a metre from where they began.
  std::size_t count_moved() {
    std::size_t count = 0;
    for (std::size_t i = 0; i < starts_.size(); ++i)
      count += (props_.props()[i].position - starts_[i]).head<2>().norm() > 0.5;
    return count;
  }

  /// Returns how many touches characters know of. They are the pairs of a character and a prop in contact.
  long count_touches() {
    long sum = 0;
    for (const loops::Character& character : crowd_.characters()) sum += character.touches;
    return sum;
  }

  static long count_touching_pairs(const graze::FrameReport& report) {
    return std::count_if(report.pairs().begin(), report.pairs().end(), [](const graze::PairReport& pair) {
      const bool is_touching =
          pair.phase == graze::PairPhase::began || pair.phase == graze::PairPhase::touching;
      return is_touching && role_of(pair.user_data_a) == Role::character &&
             role_of(pair.user_data_b) == Role::prop;
    });
  }

 private:
  static graze::SceneSettings settings(unsigned threads) {
    graze::SceneSettings settings;
    settings.contact_distance = contact_distance;
    settings.detail = graze::ContactDetail::nearest;
    settings.threads = threads;
    return settings;
  }

  graze::ObjectId add(std::shared_ptr<const graze::Mesh> mesh, graze::Motion motion, Role role,
                      std::size_t index, std::uint32_t layer, std::uint32_t collides_with) {
    graze::ObjectSettings object;
    object.name = name_of(role, index);
    object.motion = motion;
    object.layer = layer;
    object.collides_with = collides_with;
    object.solid = true;
    object.user_data = user_data(role, index);
    return scene_.add(std::move(mesh), object);
  }

  loops::ContactSide side(std::uint64_t data, const graze::Feature& feature, const Eigen::Vector3d& point) {
    loops::ContactSide side;
    side.point = point;
    if (role_of(data) == Role::prop) side.prop = &props_.props()[index_of(data)];
    if (role_of(data) == Role::character)
      side.velocity = crowd_.velocity_at(index_of(data), feature, point, frame_time);
    return side;
  }

  template <typename Condition>
  std::size_t count_props(const Condition& condition) {
    return static_cast<std::size_t>(std::count_if(props_.props().begin(), props_.props().end(), condition));
  }

  loops::Crowd crowd_{200};
  loops::Props props_{300};
  graze::Scene scene_;
  std::vector<graze::ObjectId> prop_ids_;
  std::vector<Eigen::Vector3d> starts_;
  std::vector<loops::PushConstraint> constraints_;
};

struct FrameTimes {
  explicit FrameTimes(std::size_t frames)
      : animation(frames), other(frames), waiting(frames), response(frames), frame(frames), step(frames) {}
  loops::Times animation, other, waiting, response, frame, step;
};

void print(const char* name, const loops::Times& times) {
  std::printf("  %-28s median %7.3f ms, worst %7.3f ms\n", name, times.percentile(0.5), times.percentile(1));
}

void print(const FrameTimes& times) {
  print("animation", times.animation);
  print("other work, beside the step", times.other);
  print("waiting for graze", times.waiting);
  print("events and response", times.response);
  print("the whole frame", times.frame);
  print("graze's step, by itself", times.step);
  const std::vector<double>& frames = times.frame.values();
  const auto late = std::count_if(frames.begin(), frames.end(), [](double ms) { return ms > 1000 / 60.0; });
  std::printf("  %zu of %zu frames were ready in time for 60 Hz\n",
              frames.size() - static_cast<std::size_t>(late), frames.size());
}

}  // namespace

int main(int argc, char** argv) {
  const loops::Options options = loops::read_options(argc, argv);
  const std::size_t frames = options.length > 0 ? static_cast<std::size_t>(options.length) : 600;
  Game game(options.threads);
  const std::unique_ptr<graze::Recorder> recorder = examples::make_recorder(options.record, game.scene());

  FrameTimes times(frames);
  loops::EventCheck events;
  std::size_t diagnostics = 0, lost = 0;
  graze::ReportHandle report;
  for (std::size_t frame = 1; frame <= frames; ++frame) {
    const loops::Clock::time_point begin = loops::Clock::now();
    loops::Clock::time_point now = begin;
    game.animate();
    times.animation.lap(now);
    game.scene().step_async(frame);
    game.do_other_work();
    times.other.lap(now);
    report = game.scene().wait();
    times.waiting.lap(now);
    game.take_events(*report);
    game.respond(*report);
    times.response.lap(now);
    times.frame.add(loops::milliseconds(begin, now));
    times.step.add(report->statistics().times.step_ms);

    events.take(*report);
    diagnostics += report->diagnostics().size() + (report->tag() != frame);
    lost += game.count_lost();
    if (frame % 60 == 0)
      std::printf("frame %4zu: %4zu pairs, %5zu contacts\n", frame, report->pairs().size(),
                  report->contacts().size());
  }

  print(times);
  const bool agree = game.count_touches() == Game::count_touching_pairs(*report);
  std::printf("%zu contacts began, %zu ended, %zu events without their partner\n", events.began(),
              events.ended(), events.mistakes());
  std::printf("%zu props were pushed away, %zu left the terrain\n", game.count_moved(), lost);
  finish(options, recorder.get());
  const bool holds =
      events.mistakes() == 0 && agree && diagnostics == 0 && lost == 0 && game.count_moved() > 0;
  std::printf("%s\n", holds ? "the game holds" : "THE GAME DOES NOT HOLD");
  return holds ? 0 : 1;
}
