#include "bench/rigid_bodies/rigid_body_study.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <set>
#include <string>

#include "bench/stopwatch.hpp"
#include "distribution.hpp"
#include "progress.hpp"

namespace graze::bench {
namespace {

constexpr double time_step = 1.0 / 60;  // s
constexpr std::size_t last_steps = 60;  // in which bodies should be at rest
constexpr std::size_t look_every = 10;  // steps
constexpr double deep = 0.01;           // m

/// Measures how long a source takes. Then it puts the contacts of lower bodies first, so that the order in
/// which a source names them plays no part.
class TimedSource final : public rigid::ContactSource {
 public:
  explicit TimedSource(rigid::ContactSource& source) : source_(source) {}
  void find(std::span<const rigid::Body> bodies, std::vector<rigid::Contact>& contacts) override {
    const Stopwatch watch(1);
    source_.find(bodies, contacts);
    ms_ = watch.ms();
    std::ranges::stable_sort(contacts, {}, [bodies](const rigid::Contact& contact) {
      return std::min(bodies[contact.a].position.z(), bodies[contact.b].position.z());
    });
  }
  [[nodiscard]] double ms() const { return ms_; }

 private:
  rigid::ContactSource& source_;
  double ms_ = 0;
};

/// Pairs that the solver pushes apart: a contact of theirs is nearer than the gap.
std::set<BodyPair> pushed_pairs(std::span<const rigid::Contact> contacts) {
  std::set<BodyPair> pairs;
  for (const rigid::Contact& contact : contacts)
    if (contact.separation < rigid::SolverSettings().gap) pairs.insert(std::minmax(contact.a, contact.b));
  return pairs;
}

void add_rows(const RigidBodyScene& scene, std::span<const RigidContactEntry> entries,
              tools::ResultTable& table) {
  const std::vector<RigidBodySource> sources = rigid_body_sources(scene, entries);
  std::vector<std::unique_ptr<RigidBodyRun>> runs;
  for (const RigidBodySource& source : sources)
    runs.push_back(std::make_unique<RigidBodyRun>(scene, *source.contacts));
  tools::Progress progress(scene.name + ": step", scene.steps);
  for (std::size_t step = 0; step < scene.steps; ++step) {
    progress.at(step);
    for (const auto& run : runs) run->step();
  }
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const RigidBodyFigures figures = runs[i]->figures();
    const bool has_heights = !scene.heights.empty();
    const auto if_put = [&](tools::Cell cell) { return has_heights ? std::move(cell) : tools::Cell("-"); };
    table.rows.push_back({scene.name, sources[i].name, if_put(std::uint64_t{figures.standing}),
                          if_put(figures.height_error), std::uint64_t{figures.through},
                          std::uint64_t{figures.most_through}, std::uint64_t{figures.silent}, figures.speed,
                          100 * figures.jumps, figures.contacts, figures.find_ms, figures.step_ms});
  }
}

}  // namespace

RigidBodyRun::RigidBodyRun(const RigidBodyScene& scene, rigid::ContactSource& source)
    : scene_(scene), source_(source), bodies_(scene.bodies), referee_(scene.shapes, deep) {}

void RigidBodyRun::step() {
  const std::vector<rigid::Body> before = bodies_;
  TimedSource source(source_);
  const Stopwatch watch(1);
  solver_.step(bodies_, source, time_step);
  step_ms_.push_back(watch.ms());
  find_ms_.push_back(source.ms());
  contacts_.push_back(static_cast<double>(solver_.contacts().size()));
  speeds_.push_back(speed_between(scene_, before, bodies_, time_step));
  jumps_.see(before, solver_.contacts());
  if (steps_ % look_every == 0) look(before);
  ++steps_;
  if (steps_ + last_steps == scene_.steps) jumps_.restart();
}

void RigidBodyRun::look(std::span<const rigid::Body> bodies) {
  const Overlaps overlaps = referee_.find(bodies);
  const std::set<BodyPair> pushed = pushed_pairs(solver_.contacts());
  const auto silent =
      std::ranges::count_if(overlaps.crossing, [&](const BodyPair& pair) { return !pushed.contains(pair); });
  figures_.most_through = std::max(figures_.most_through, overlaps.deep.size());
  figures_.silent = std::max(figures_.silent, static_cast<std::size_t>(silent));
}

RigidBodyFigures RigidBodyRun::figures() {
  const std::vector<double> last(
      speeds_.end() - static_cast<std::ptrdiff_t>(std::min(last_steps, speeds_.size())), speeds_.end());
  figures_.standing = standing(scene_, bodies_);
  figures_.height_error = height_error(scene_, bodies_);
  figures_.through = referee_.find(bodies_).deep.size();
  figures_.most_through = std::max(figures_.most_through, figures_.through);
  figures_.speed = tools::Distribution(last).median();
  figures_.jumps = jumps_.share();
  figures_.contacts = tools::Distribution(contacts_).median();
  figures_.find_ms = tools::Distribution(find_ms_).median();
  figures_.step_ms = tools::Distribution(step_ms_).median();
  return figures_;
}

tools::ResultTable compare_rigid_bodies(const PeerModule& module, bool is_quick) {
  tools::ResultTable table{
      "rigid_bodies", "One solver of rigid bodies under the contacts of graze and of others, on one thread",
      tools::columns_of({"scene", "contacts_from", "standing: bodies that stand",
                         "height_error_mm: error of height, mm", "through: pairs through at the end",
                         "most_through: most in a step", "silent: crossing pairs in silence",
                         "speed_mm_s: speed at rest, mm/s", "jumps_percent: contacts that jump, %",
                         "contacts: contacts a step", "find_ms: ms a step to find", "step_ms: ms a step"})};
  table.timed = true;
  for (const RigidBodyScene& scene : rigid_body_scenes(is_quick))
    add_rows(scene, module.rigid_contact_finders(), table);
  return table;
}

}  // namespace graze::bench
