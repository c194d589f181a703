#include "hard_cases/scene_comparison.hpp"

#include <iostream>

#include "scheduler/report_text.hpp"
#include "support/catch.hpp"

namespace graze::tests {

BodyScene::BodyScene(const std::vector<Body>& bodies, const SceneSettings& settings) : scene_(settings) {
  for (const Body& body : bodies) ids_.push_back(scene_.add(mesh_of(body.rest)));
}

ReportHandle BodyScene::step(const std::vector<Body>& bodies) {
  for (std::size_t i = 0; i < ids_.size(); ++i) scene_.set_positions(ids_[i], bodies[i].now.positions);
  return scene_.step();
}

void Tally::compare(const std::vector<Body>& bodies, double threshold) {
  for (const ContactDetail detail : all_details) compare(bodies, threshold, detail);
}

void Tally::compare(const std::vector<Body>& bodies, double threshold, ContactDetail detail) {
  BodyScene scene(bodies, settings_of(threshold, infinity, detail));
  const ReportHandle report = scene.step(bodies);
  INFO("detail " << static_cast<int>(detail));
  CHECK(report->diagnostics().empty());
  CHECK(inconsistency_of(*report) == "");
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      INFO("objects " << a << " and " << b);
      const PairReport* const row = find_pair(*report, scene.ids()[a], scene.ids()[b]);
      REQUIRE(row != nullptr);
      const Expected expected =
          expected_of(bodies[a].now, bodies[b].now, threshold, detail, bodies[a].rest, bodies[b].rest);
      const Tolerance tolerance(bodies[a].now, bodies[b].now);
      CHECK((row->phase == PairPhase::began) == expected.in_contact);
      CHECK(difference_of(row->distance, row->witness, expected.distance, tolerance) == "");
      CHECK(difference_of(report->contacts(*row), expected.contacts, tolerance) == "");
      contacts += expected.contacts.size();
    }
  ++scenes;
}

void Tally::print(const char* what) const {
  std::cout << "compared " << scenes << " scenes of " << what << ", " << contacts << " contacts\n";
}

}  // namespace graze::tests
