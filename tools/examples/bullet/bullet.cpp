// Plays eight soft balls in a pit twice with Bullet's own solver of deformable bodies: once with the contacts
// that Bullet finds, and once with those that graze finds. Then it counts the vertices that are inside other
// bodies, by an exact oracle. On some frames it also compares all contacts of graze with that oracle.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "examples/bullet/outcome.hpp"
#include "examples/support/record_option.hpp"

namespace {

using namespace examples::bullet;

constexpr int compared_frames = 20;  // of a long run

struct Options {
  int frames = 300;
  int steps = 2;      ///< of the solver in a frame of 1/60 s
  double margin = 5;  ///< mm, of Bullet's soft bodies
  std::string recording;
};

/// The figures by which two runs are compared.
struct Outcome {
  double milliseconds = 0;  ///< median of the detection of a step
  double contacts = 0;      ///< average of a step
  Through end;
};

Outcome outcome_of(const World& world, const Bodies& bodies) {
  std::vector<double> times;
  Outcome outcome;
  for (const StepFigures& step : world.figures()) {
    times.push_back(step.milliseconds);
    outcome.contacts += static_cast<double>(step.contacts) / static_cast<double>(world.figures().size());
  }
  std::sort(times.begin(), times.end());
  outcome.milliseconds = times[times.size() / 2];
  outcome.end = through(bodies);
  return outcome;
}

void print(const char* name, const Outcome& outcome) {
  std::printf("%-11s %12.2f %17.0f %18zu %13.1f\n", name, outcome.milliseconds, outcome.contacts,
              outcome.end.vertices, 1e3 * outcome.end.deepest);
}

/// Bullet looks for nodes in rigid bodies. With faces its balls are further in each other at the end.
Outcome play_bullet(const Options& options) {
  using Flags = btSoftBody::fCollision;
  const auto simulation = std::make_unique<Simulation<World>>(Flags::SDF_RD | Flags::SDF_RDN | Flags::VF_DD,
                                                              options.margin / 1000);
  for (int frame = 0; frame < options.frames; ++frame) simulation->play_frame(options.steps);
  return outcome_of(simulation->world, simulation->bodies);
}

struct Comparison {
  int frames = 0;
  std::size_t contacts = 0;
  std::string difference;
};

Outcome play_graze(const Options& options, Comparison& comparison) {
  const auto simulation = std::make_unique<Simulation<GrazeWorld>>(0, options.margin / 1000);
  GrazeWorld& world = simulation->world;
  world.attach(simulation->bodies, 1.0 / 60 / options.steps);
  const auto recorder = examples::make_recorder(options.recording, world.scene());
  const int every = std::max(3, options.frames / compared_frames);
  for (int frame = 1; frame <= options.frames; ++frame) {
    bool is_compared = frame % every == 0;
    world.look = [&] {
      if (!std::exchange(is_compared, false)) return;
      ++comparison.frames;
      comparison.contacts += compare(world, simulation->bodies, comparison.difference);
    };
    simulation->play_frame(options.steps);
  }
  return outcome_of(world, simulation->bodies);
}

/// Ends the program if it was started with anything else.
Options options_of(int argc, char** argv) {
  Options options;
  options.recording = examples::take_option("--record", argc, argv);
  const std::string frames = examples::take_option("--frames", argc, argv);
  const std::string steps = examples::take_option("--steps", argc, argv);
  const std::string margin = examples::take_option("--margin", argc, argv);
  if (!frames.empty()) options.frames = std::atoi(frames.c_str());
  if (!steps.empty()) options.steps = std::atoi(steps.c_str());
  if (!margin.empty()) options.margin = std::atof(margin.c_str());
  const bool are_good = options.frames >= 3 && options.steps > 0 && options.margin > 0;
  if (argc == 1 && are_good) return options;
  std::fprintf(stderr, "usage: %s [--frames N] [--steps N of a frame] [--margin MM] [--record FILE]\n",
               argv[0]);
  std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = options_of(argc, argv);
  Comparison comparison;
  const Outcome bullet = play_bullet(options);
  const Outcome graze = play_graze(options, comparison);
  std::printf("%d frames of %d steps, margin %g mm\n", options.frames, options.steps, options.margin);
  std::printf("contacts by    ms a step   contacts a step   vertices through    deepest mm\n");
  print("Bullet", bullet);
  print("graze", graze);
  const bool is_exact = comparison.difference.empty() && comparison.contacts > 0;
  std::printf("%zu contacts of graze on %d frames: %s\n%s", comparison.contacts, comparison.frames,
              is_exact ? "those of the oracle" : "not those of the oracle", comparison.difference.c_str());
  if (!options.recording.empty())
    std::printf("recorded: graze view %s -o page.html makes a page of it\n", options.recording.c_str());
  const bool has_fewer = graze.end.vertices <= bullet.end.vertices && graze.end.deepest < 0.05;
  std::printf("%s\n", is_exact && has_fewer ? "graze keeps the balls out of each other" : "went wrong");
  return is_exact && has_fewer ? 0 : 1;
}
