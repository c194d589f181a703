#include "experiment/paper/feature_checks.hpp"

#include <array>
#include <map>
#include <memory>
#include <tuple>

#include "experiment/paper/contact_checks.hpp"
#include "progress.hpp"
#include "support/oracle/oracle.hpp"

namespace graze::tools {
namespace {

using FeatureName = std::tuple<ContactKind, Feature, Feature>;

/// The faces of an object within reach of a box, as the oracle takes them, and the numbers that the object's
/// own mesh gives them and their edges.
struct Clipped {
  oracle::Shape shape;
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> edges;

  [[nodiscard]] Feature own(const Feature& feature) const {
    if (feature.kind == FeatureKind::vertex) return feature;
    return {feature.kind, feature.kind == FeatureKind::edge ? edges[feature.index] : faces[feature.index]};
  }
};

class Frame {
 public:
  Frame(const RecordedMotion& motion, std::size_t frame) {
    for (const RecordedObject& object : motion.objects) {
      Body& body = bodies_.emplace_back();
      body.mesh = object.mesh.get();
      for (std::size_t i = 0; i < object.positions(frame).size(); ++i) {
        body.points.push_back(object.positions(frame)[i]);
        body.box.add(body.points.back());
      }
    }
  }

  [[nodiscard]] std::vector<FeatureName> truth(std::size_t a, std::size_t b, double distance) const {
    const Clipped clipped_a = clipped(bodies_[a], bodies_[b].box, distance);
    const Clipped clipped_b = clipped(bodies_[b], bodies_[a].box, distance);
    std::vector<FeatureName> names;
    if (clipped_a.faces.empty() || clipped_b.faces.empty()) return names;
    for (const oracle::Named& named : oracle::features(clipped_a.shape, clipped_b.shape, distance))
      names.emplace_back(named.kind, clipped_a.own(named.a), clipped_b.own(named.b));
    std::ranges::sort(names);
    return names;
  }

 private:
  struct Body {
    const Mesh* mesh = nullptr;
    std::vector<Eigen::Vector3d> points;
    Box box;
  };

  /// A feature that is within the distance of the box belongs to a face whose box is.
  static Clipped clipped(const Body& body, const Box& near, double distance) {
    const Box reach = grown(near, distance);
    Clipped result{{body.points, {}}, {}, {}};
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> edges;
    for (std::uint32_t face = 0; face < body.mesh->face_count(); ++face) {
      Box box;
      for (const std::uint32_t corner : body.mesh->face(face)) box.add(body.points[corner]);
      if (lower_distance(box, reach) > 0) continue;
      result.faces.push_back(face);
      const auto corners = body.mesh->face(face);
      result.shape.faces.emplace_back(corners.begin(), corners.end());
      for (const std::uint32_t edge : body.mesh->face_edges(face)) edges[body.mesh->edge(edge)] = edge;
    }
    for (const auto& ends : oracle::edges_of(result.shape)) result.edges.push_back(edges.at(ends));
    return result;
  }

  std::vector<Body> bodies_;
};

std::vector<FeatureName> names_of(std::span<const Contact> contacts) {
  std::vector<FeatureName> names;
  for (const Contact& contact : contacts)
    names.emplace_back(contact.kind, contact.feature_a, contact.feature_b);
  return names;
}

std::vector<PlayedSetting> feature_settings(double distance) {
  return {exact_setting(ContactDetail::features, distance, 0),
          within_setting(ContactDetail::features, distance, 5)};
}

/// Which pairs of objects are compared.
class Sample {
 public:
  explicit Sample(std::size_t every) : every_(every) {}
  [[nodiscard]] bool takes(bool in_contact) { return counts_[in_contact ? 1 : 0]++ % every_ == 0; }

 private:
  std::size_t every_;
  std::array<std::size_t, 2> counts_{};
};

/// The scenes of all settings, and how they compare.
class Comparison {
 public:
  Comparison(const RecordedMotion& motion, double contact_distance)
      : motion_(motion), contact_distance_(contact_distance) {
    for (const PlayedSetting& setting : feature_settings(contact_distance)) {
      scenes_.push_back(std::make_unique<PlayedMotion>(motion, setting));
      checks_.emplace_back();
      checks_.back().name = setting.name;
      checks_.back().detail = ContactDetail::features;
      checks_.back().contact_distance = contact_distance;
    }
  }

  void step(std::size_t index, Sample& sample) {
    std::vector<ReportHandle> reports;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      reports.push_back(scenes_[i]->step(index));
      count_work(reports.back()->statistics(), checks_[i]);
    }
    const Frame frame(motion_, index);
    for (std::size_t a = 0; a < motion_.objects.size(); ++a)
      for (std::size_t b = a + 1; b < motion_.objects.size(); ++b)
        if (!motion_.in_one_group(a, b)) compare(frame, reports, a, b, sample);
  }

  [[nodiscard]] const std::vector<ContactCheck>& checks() const { return checks_; }

 private:
  void compare(const Frame& frame, const std::vector<ReportHandle>& reports, std::size_t a, std::size_t b,
               Sample& sample) {
    std::vector<std::vector<FeatureName>> names;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      const PairReport* row = scenes_[i]->row(*reports[i], a, b);
      names.push_back(row == nullptr ? std::vector<FeatureName>() : names_of(reports[i]->contacts(*row)));
    }
    if (!sample.takes(!names[0].empty())) return;
    const auto truth = frame.truth(a, b, contact_distance_);
    for (std::size_t i = 0; i < names.size(); ++i) tally_contacts(truth, names[i], checks_[i]);
  }

  const RecordedMotion& motion_;
  double contact_distance_;
  std::vector<std::unique_ptr<PlayedMotion>> scenes_;
  std::vector<ContactCheck> checks_;
};

}  // namespace

std::vector<ContactCheck> check_features(const RecordedMotion& motion, double contact_distance,
                                         std::size_t every) {
  Comparison comparison(motion, contact_distance);
  Sample sample(every);
  Progress progress(motion.name + ": features, step", motion.frame_count());
  for (std::size_t index = 0; index < motion.frame_count(); ++index) {
    progress.at(index);
    comparison.step(index, sample);
  }
  return comparison.checks();
}

}  // namespace graze::tools
