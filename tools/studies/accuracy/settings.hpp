#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <string>
#include <vector>

#include "accuracy/moving_surfaces.hpp"

namespace graze::tools {

/// A family of settings, drawn as one line of the figure.
enum class ModeFamily : std::uint8_t {
  exact,
  within,
  work_budget,
  time_budget,
  paper_formula,
  paper_numbers,
  paper_loose  ///< numbers whose last is above the contact distance
};

std::string title_of(ModeFamily family);

struct ModeSetting {
  std::string name;
  ModeFamily family = ModeFamily::exact;
  SceneSettings settings;
};

/// Exact mode on one thread, with every pair listed.
SceneSettings exact_settings(ContactDetail detail, double contact_distance);

/// Exact, within and work budgets for a detail of surfaces. `exact_work` is how many region pairs a step of
/// exact mode tests. Budgets are parts of it.
std::vector<ModeSetting> surface_settings(const MovingSurfaces& models, ContactDetail detail,
                                          double contact_distance, std::uint64_t exact_work);

/// Exact and paper, by eq. 6 and by numbers, for a detail of vertices.
std::vector<ModeSetting> vertex_settings(const MovingSurfaces& models, ContactDetail detail,
                                         double contact_distance);

/// Time budgets that are parts of `exact_ms`, which a step of exact mode takes.
std::vector<ModeSetting> timed_settings(ContactDetail detail, double contact_distance, double exact_ms);

}  // namespace graze::tools
