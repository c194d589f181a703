#include "examples/support/manifold.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace examples {
namespace {

/// Moves the contact with the largest score, if that is above `least`, from the candidates to those chosen.
template <typename Score>
void choose(std::vector<graze::Contact>& candidates, std::vector<graze::Contact>& chosen, double least,
            const Score& score) {
  auto best = candidates.end();
  for (auto it = candidates.begin(); it != candidates.end(); ++it)
    if (score(*it) > least) {
      best = it;
      least = score(*it);
    }
  if (best == candidates.end()) return;
  chosen.push_back(*best);
  candidates.erase(best);
}

}  // namespace

std::vector<graze::Contact> manifold(std::span<const graze::Contact> contacts) {
  constexpr double least_length = 1e-6;    // m: nearer ones count as one
  constexpr double least_agreement = 0.9;  // cosine of 26 degrees
  std::vector<graze::Contact> candidates;
  for (const graze::Contact& contact : contacts)
    if (contact.kind != graze::ContactKind::EF || contact.distance > 0) candidates.push_back(contact);

  std::vector<graze::Contact> chosen;
  choose(candidates, chosen, -std::numeric_limits<double>::infinity(),
         [](const graze::Contact& contact) { return -contact.separation(); });
  if (chosen.empty()) return chosen;
  const Eigen::Vector3d push = chosen[0].push();
  std::erase_if(candidates,
                [&](const graze::Contact& contact) { return contact.push().dot(push) < least_agreement; });
  const Eigen::Vector3d first = chosen[0].point_b;
  choose(candidates, chosen, least_length,
         [&](const graze::Contact& contact) { return (contact.point_b - first).norm(); });
  if (chosen.size() < 2) return chosen;
  const Eigen::Vector3d line = chosen[1].point_b - first;
  const auto area = [&](const graze::Contact& contact) -> Eigen::Vector3d {
    return line.cross(contact.point_b - first);
  };
  choose(candidates, chosen, least_length * line.norm(),
         [&](const graze::Contact& contact) { return area(contact).norm(); });
  if (chosen.size() < 3) return chosen;
  const Eigen::Vector3d side = area(chosen[2]).normalized();
  choose(candidates, chosen, least_length * line.norm(),
         [&](const graze::Contact& contact) { return -side.dot(area(contact)); });
  return chosen;
}

}  // namespace examples
