#include "bench/soft_bodies/soft_body_study.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "bench/stopwatch.hpp"
#include "distribution.hpp"
#include "output/text.hpp"
#include "progress.hpp"

namespace graze::bench {
namespace {

struct Contestant {
  std::string name;
  std::unique_ptr<SoftBodyRun> run;
  std::unique_ptr<ContactSource> source;
};

/// Adds Bullet once for each margin, or not at all where the module lacks it.
std::vector<Contestant> contestants_of(const PeerModule& module, const SoftBodyScene& scene) {
  std::vector<Contestant> contestants;
  contestants.push_back({"graze", std::make_unique<SoftBodyRun>(scene), graze_source()});
  for (const double margin : scene.margins) {
    SoftContactSettings settings;
    settings.margin = margin;
    settings.time_step = frame_time / scene.steps_per_frame;
    auto run = std::make_unique<SoftBodyRun>(scene);
    std::unique_ptr<ContactSource> source = bullet_source(module, run->world(), run->kinds(), settings);
    if (source == nullptr) break;
    contestants.push_back(
        {"Bullet, margin " + tools::rounded(1000 * margin, 3) + " mm", std::move(run), std::move(source)});
  }
  return contestants;
}

void add_rows(const PeerModule& module, const SoftBodyScene& scene, std::size_t frames,
              tools::ResultTable& table) {
  const std::vector<Contestant> contestants = contestants_of(module, scene);
  tools::Progress progress(scene.name + ": frame", frames);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    progress.at(frame);
    for (const Contestant& contestant : contestants) contestant.run->frame(*contestant.source);
  }
  for (const Contestant& contestant : contestants) {
    const SoftBodyFigures figures = contestant.run->figures();
    table.rows.push_back({scene.name, static_cast<std::uint64_t>(scene.steps_per_frame), contestant.name,
                          std::uint64_t{figures.through}, std::uint64_t{figures.most_through},
                          figures.contacts, figures.look_ms, figures.frame_ms});
  }
}

}  // namespace

SoftBodyRun::SoftBodyRun(const SoftBodyScene& scene)
    : scene_(scene), world_(scene.settings), kinds_(scene.fill(world_)), referee_(world_, scene.is_out) {}

void SoftBodyRun::frame(ContactSource& source) {
  scene_.lead(world_, frame_ms_.size());
  double look_ms = 0;
  const Stopwatch whole(1);
  for (int i = 0; i < scene_.steps_per_frame; ++i) {
    const Stopwatch look(1);
    source.find(world_, constraints_);
    look_ms += look.ms();
    contacts_.push_back(static_cast<double>(constraints_.size()));
    world_.move(constraints_, frame_time / scene_.steps_per_frame);
  }
  frame_ms_.push_back(whole.ms());
  look_ms_.push_back(look_ms);
  through_.push_back(referee_.count());
}

SoftBodyFigures SoftBodyRun::figures() const {
  return {through_.back(), *std::ranges::max_element(through_), tools::Distribution(contacts_).median(),
          tools::Distribution(look_ms_).median(), tools::Distribution(frame_ms_).median()};
}

tools::ResultTable compare_soft_bodies(const PeerModule& module, std::size_t frames) {
  tools::ResultTable table{"soft_bodies",
                           "One solver under the contacts of graze and of Bullet, on one thread",
                           tools::columns_of({"scene", "looks: looks a frame", "contacts_from",
                                              "through: vertices through at the end",
                                              "most_through: most in a frame", "contacts: contacts a look",
                                              "look_ms: ms a frame to look", "frame_ms: ms a frame"})};
  table.timed = true;
  for (const SoftBodyScene& scene :
       {cloth_on_ball(), balls_in_bowl(), with_steps(balls_in_bowl(), 1), balls_in_tray(),
        with_steps(balls_in_tray(), 1), balls_inside_each_other()})
    add_rows(module, scene, frames, table);
  return table;
}

}  // namespace graze::bench
