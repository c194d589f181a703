// A haptic thread at 1 kHz beside steps at 50 Hz. Between two steps it has the contacts of a report that is
// 20 to 40 ms old, and the newest positions. The program compares ways to use them at the same positions. The
// truth is a query in each tick. The others are the contacts as the report has them, graze::evaluate() for
// all of them, evaluate() where the closest points are inside their features, and graze::follow().
//
// The instrument goes where the proxy of the truth is. For each way the program counts the ticks in which the
// depth is off by 0.1 mm or the force by 0.1 N, and the jumps of the force above 0.1 N. It exits with 1 in
// three cases: follow() misses depth, its force is off in more than a tenth of evaluate()'s ticks, or it has
// more jumps than the truth and a tenth.

#include <algorithm>
#include <array>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

#include "examples/loops/instrument.hpp"
#include "examples/loops/options.hpp"
#include "examples/loops/organ_history.hpp"
#include "examples/loops/organs.hpp"
#include "examples/loops/walk/finding.hpp"

namespace {

constexpr int ticks_of_step = 20;
constexpr double furthest_step = 0.1;  // mm, of the proxy in a tick

/// The organs and the instrument at one tick.
struct Positions {
  std::array<std::vector<Eigen::Vector3f>, 2> organs;
  std::vector<Eigen::Vector3d> instrument;
  loops::Held held;
};

struct Report {
  std::array<std::vector<graze::Contact>, 2> contacts;  ///< of either organ with the instrument
  loops::Held held;
};

class Comparison {
 public:
  explicit Comparison(const loops::Organs& organs)
      : organs_(organs),
        instrument_(highest(organs.shapes[0]), {0, -0.3, 1}, 0),
        meshes_{loops::make_mesh(organs.shapes[0]), loops::make_mesh(organs.shapes[1])},
        queries_{query_of(0), query_of(1)} {
    for (std::size_t i = 0; i < 2; ++i) now_.organs[i] = organs.shapes[i].points;
    now_.held.proxy = instrument_.pose(0).translation();
  }

  void run(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      place(0.001 * tick);
      Report truth = report_now();
      if (tick % ticks_of_step == 0) {
        used_ = std::move(next_);
        next_ = truth;
      }
      compare(truth, tick >= 2 * ticks_of_step);
    }
  }
  [[nodiscard]] bool print() const {
    loops::FindingTrack::print_head();
    for (const auto* track : {&truth_, &report_, &evaluate_, &interior_, &follow_}) track->print();
    std::printf("  %d contacts were followed, of which %d changed their features and %d were not known\n",
                followed_, changed_, unknown_);
    return follow_.missed == 0 && follow_.force_off * 10 <= evaluate_.force_off &&
           follow_.jumps * 10 <= truth_.jumps * 11 + 10;
  }

 private:
  static Eigen::Vector3d highest(const loops::Shape& shape) {
    const auto is_lower = [](const auto& p, const auto& q) { return p.z() < q.z(); };
    return std::max_element(shape.points.begin(), shape.points.end(), is_lower)->cast<double>();
  }
  graze::RepeatedQuery query_of(std::size_t organ) const {
    graze::QuerySettings settings;
    settings.contact_distance = 2;  // mm
    settings.range = 2;
    settings.detail = graze::ContactDetail::nearest;
    settings.a_is_solid = settings.b_is_solid = true;
    return {*meshes_[organ], *instrument_.mesh(), settings};
  }

  void place(double time) {
    for (std::size_t i = 0; i < 2; ++i) deform(organs_.shapes[i], time, now_.organs[i]);
    now_.held.hand = instrument_.pose(time);
    Eigen::Isometry3d pose = now_.held.hand;
    pose.translation() = now_.held.proxy;
    now_.instrument.clear();
    for (const Eigen::Vector3d& point : instrument_.mesh()->rest()) now_.instrument.push_back(pose * point);
  }
  Report report_now() {
    Report report;
    report.held = now_.held;
    for (std::size_t i = 0; i < 2; ++i)
      for (const graze::Contact& contact : queries_[i].ask(now_.organs[i], now_.instrument).contacts)
        if (contact.kind != graze::ContactKind::EF) report.contacts[i].push_back(contact);
    return report;
  }

  void compare(const Report& truth, bool is_counted) {
    const loops::Held& held = now_.held;
    loops::Finding exact(held), as_reported(held), evaluated(held), interior(held), followed(held);
    const Eigen::Vector3d way = held.proxy - used_.held.proxy;  // of the instrument since the report
    for (std::size_t i = 0; i < 2; ++i) {
      for (const graze::Contact& contact : truth.contacts[i]) exact.add(contact.push(), contact.separation());
      for (const graze::Contact& contact : used_.contacts[i]) {
        const double reported = contact.separation() + contact.push().dot(way);
        as_reported.add(contact.push(), reported);
        const graze::ContactGeometry now =
            graze::evaluate(*meshes_[i], now_.organs[i], *instrument_.mesh(), now_.instrument, contact);
        evaluated.add(now.push, now.separation);
        interior.add(now.is_interior ? now.push : contact.push(),
                     now.is_interior ? now.separation : reported);
        follow(i, contact, followed);
      }
    }
    if (is_counted) {
      truth_.take(exact, exact);
      report_.take(as_reported, exact);
      evaluate_.take(evaluated, exact);
      interior_.take(interior, exact);
      follow_.take(followed, exact);
    }
    const Eigen::Vector3d step = held.hand.translation() + exact.way() - held.proxy;
    now_.held.proxy += step * std::min(1.0, furthest_step / std::max(step.norm(), furthest_step));
  }

  void follow(std::size_t organ, const graze::Contact& contact, loops::Finding& found) {
    const auto take = [&](const graze::FollowedContact& now) {
      ++followed_;
      changed_ += now.is_known && now.steps > 0;
      unknown_ += !now.is_known;
      if (now.is_known) found.add(now.geometry.push, now.geometry.separation);
    };
    take(graze::follow(*meshes_[organ], now_.organs[organ], *instrument_.mesh(), now_.instrument, contact));
    if (contact.kind == graze::ContactKind::VV)
      take(graze::follow_vertex_of_b(*meshes_[organ], now_.organs[organ], *instrument_.mesh(),
                                     now_.instrument, contact));
  }

  const loops::Organs& organs_;
  loops::Instrument instrument_;
  std::array<std::shared_ptr<const graze::Mesh>, 2> meshes_;
  std::array<graze::RepeatedQuery, 2> queries_;
  Positions now_;
  Report used_, next_;
  loops::FindingTrack truth_{"a query in each tick"}, report_{"contacts as in the report"},
      evaluate_{"evaluate() for all"}, interior_{"evaluate() where inside"}, follow_{"follow()"};
  int followed_ = 0, changed_ = 0, unknown_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const loops::Options options = loops::read_options(argc, argv);
  const loops::Organs organs = load_organs(options);
  std::printf("the organs were %s\n", organs.source.c_str());
  Comparison comparison(organs);
  comparison.run(options.length > 0 ? options.length : 12000);
  const bool holds = comparison.print();
  std::printf("%s\n", holds ? "the loop holds" : "THE LOOP DOES NOT HOLD");
  return holds ? 0 : 1;
}
