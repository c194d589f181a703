// A haptic thread at 1 kHz beside steps at 50 Hz. Between two steps it has the contacts of a report that is
// 20 to 40 ms old, and the newest positions. The program compares ways to use them at the same positions. The
// truth is a query in each tick. Four ways use the contacts of the report: as they are, with
// graze::evaluate(), with evaluate() where the closest points are inside their features, and with
// graze::follow(). Two ways ask the patch of the instrument: about the organs of the report, and with
// follow() from there.
//
// The instrument goes where the proxy of the truth is. For each way the program counts the ticks in which the
// depth is off by 0.1 mm or the force by 0.1 N, and the jumps of the force above 0.1 N. It exits with 1 if
// follow(), with or without the patch, misses depth. It also does so if its force is off in more than a tenth
// of evaluate()'s ticks, or if it has more jumps than the truth and a tenth.

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
constexpr double furthest_step = 0.1;   // mm, of the proxy in a tick
constexpr double contact_distance = 2;  // mm

/// What is further from the instrument than this is in no patch. In 40 ticks the proxy moves by 4 mm at most.
constexpr double patch_radius = 8;

/// The organs and the instrument at one tick.
struct Positions {
  std::array<std::vector<Eigen::Vector3f>, 2> organs;
  std::vector<Eigen::Vector3d> instrument;
  loops::Held held;
};

struct Report {
  std::array<std::vector<graze::Contact>, 2> contacts;  ///< of either organ with the instrument
  loops::Held held;
  graze::ReportHandle of_scene;
};

class Comparison {
 public:
  explicit Comparison(const loops::Organs& organs)
      : organs_(organs),
        instrument_(highest(organs.shapes[0]), {0, -0.3, 1}, 0),
        meshes_{loops::make_mesh(organs.shapes[0]), loops::make_mesh(organs.shapes[1])},
        queries_{query_of(0), query_of(1)},
        scene_(
            {.contact_distance = contact_distance, .detail = graze::ContactDetail::nearest, .threads = 1}) {
    for (const auto& mesh : meshes_) organ_ids_.push_back(scene_.add(mesh, {.solid = true}));
    tool_ = scene_.add(instrument_.mesh(),
                       {.motion = graze::Motion::rigid, .solid = true, .patch_radius = patch_radius});
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
        next_.of_scene = step();
      }
      compare(truth, tick >= 2 * ticks_of_step);
    }
  }
  [[nodiscard]] bool print() const {
    loops::FindingTrack::print_head();
    for (const auto* track : {&truth_, &report_, &evaluate_, &interior_, &follow_, &patch_, &patch_follow_})
      track->print();
    std::printf("  %d contacts were followed, of which %d changed their features and %d were not known\n",
                followed_, changed_, unknown_);
    std::printf("  the patch: %zu faces at most, %d incomplete answers, good for %.2f mm more at least\n",
                most_faces_, incomplete_, least_validity_);
    return incomplete_ == 0 && is_good(follow_) && is_good(patch_follow_);
  }

 private:
  [[nodiscard]] bool is_good(const loops::FindingTrack& track) const {
    return track.missed == 0 && track.force_off * 10 <= evaluate_.force_off &&
           track.jumps * 10 <= truth_.jumps * 11 + 10;
  }
  static Eigen::Vector3d highest(const loops::Shape& shape) {
    const auto is_lower = [](const auto& p, const auto& q) { return p.z() < q.z(); };
    return std::max_element(shape.points.begin(), shape.points.end(), is_lower)->cast<double>();
  }
  graze::RepeatedQuery query_of(std::size_t organ) const {
    graze::QuerySettings settings;
    settings.contact_distance = settings.range = contact_distance;
    settings.detail = graze::ContactDetail::nearest;
    settings.a_is_solid = settings.b_is_solid = true;
    return {*meshes_[organ], *instrument_.mesh(), settings};
  }

  void place(double time) {
    for (std::size_t i = 0; i < 2; ++i) deform(organs_.shapes[i], time, now_.organs[i]);
    now_.held.hand = instrument_.pose(time);
    const Eigen::Isometry3d pose = pose_of_proxy();
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

  [[nodiscard]] Eigen::Isometry3d pose_of_proxy() const {
    Eigen::Isometry3d pose = now_.held.hand;
    pose.translation() = now_.held.proxy;
    return pose;
  }
  graze::ReportHandle step() {
    for (std::size_t i = 0; i < 2; ++i) scene_.set_positions(organ_ids_[i], now_.organs[i]);
    scene_.set_pose(tool_, pose_of_proxy());
    return scene_.step();
  }

  void compare(const Report& truth, bool is_counted) {
    const loops::Held& held = now_.held;
    loops::Finding exact(held), as_reported(held), evaluated(held), interior(held), followed(held);
    loops::Finding patched(held), patch_followed(held);
    if (is_counted) ask_patch(patched, patch_followed);
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
      patch_.take(patched, exact);
      patch_follow_.take(patch_followed, exact);
    }
    const Eigen::Vector3d step = held.hand.translation() + exact.way() - held.proxy;
    now_.held.proxy += step * std::min(1.0, furthest_step / std::max(step.norm(), furthest_step));
  }

  /// Asks the patch about the instrument as it is now and the organs as the report has them, and follows the
  /// contacts from there to the organs as they are now.
  void ask_patch(loops::Finding& patched, loops::Finding& followed) {
    const graze::Patch patch = used_.of_scene->patch(tool_);
    const graze::PatchAnswer answer = patch.contacts(pose_of_proxy(), contact_distance, room_);
    incomplete_ += !answer.complete;
    least_validity_ = std::min(least_validity_, answer.validity);
    most_faces_ = std::max(most_faces_, patch.face_count());
    for (const graze::PatchPair& pair : room_.pairs())
      for (const graze::Contact& contact : room_.contacts(pair)) {
        if (contact.kind == graze::ContactKind::EF) continue;
        patched.add(contact.push(), contact.separation());
        follow(pair.a == organ_ids_[0] ? 0 : 1, contact, followed);
      }
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
  graze::Scene scene_;
  std::vector<graze::ObjectId> organ_ids_;
  graze::ObjectId tool_;
  graze::PatchRoom room_;
  Positions now_;
  Report used_, next_;
  loops::FindingTrack truth_{"a query in each tick"}, report_{"contacts as in the report"},
      evaluate_{"evaluate() for all"}, interior_{"evaluate() where inside"}, follow_{"follow()"},
      patch_{"the patch"}, patch_follow_{"the patch, then follow()"};
  int followed_ = 0, changed_ = 0, unknown_ = 0, incomplete_ = 0;
  double least_validity_ = patch_radius;
  std::size_t most_faces_ = 0;
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
