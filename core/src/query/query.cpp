#include <algorithm>
#include <graze/error.hpp>
#include <graze/query.hpp>
#include <memory>
#include <optional>
#include <string>

#include "core/base/bad_vertex_text.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/base/view_check.hpp"
#include "core/mesh/closed.hpp"
#include "core/pair/pair_query.hpp"
#include "core/pair/setting_checks.hpp"
#include "core/search/pair_detector.hpp"
#include "core/surface/surface.hpp"

namespace graze {
namespace {

/// Says in one sentence what is wrong with settings, or nothing if they are valid.
std::optional<std::string> problem_of(const QuerySettings& settings) {
  constexpr const char* owner = "query: ";
  if (auto problem = problem_of_enumerator(owner, "detail", settings.detail)) return problem;
  if (auto problem = problem_of_distance(owner, "contact_distance", settings.contact_distance))
    return problem;
  if (auto problem = problem_of_range(owner, "range", settings.range)) return problem;
  if (auto problem = problem_of_accuracy(owner, settings.accuracy, settings.detail)) return problem;
  if (settings.max_contacts == 0)
    return "query: max_contacts is at least 1; ContactDetail::none lists no contacts";
  return std::nullopt;
}

/// The question of a query. It refers to the numbers of the settings' accuracy.
PairQuery question_of(const QuerySettings& settings) {
  PairQuery question;
  question.detail = settings.detail;
  question.mode = settings.accuracy.mode();
  question.tolerance = settings.accuracy.tolerance();
  question.epsilon = settings.accuracy.epsilon();
  question.threshold = threshold_of(settings.contact_distance, question.epsilon);
  question.reach = std::max(settings.range, question.threshold);
  question.contact_limit = settings.max_contacts.value_or(0);
  if (is_about_vertices(settings.detail)) return question;
  question.a_is_solid = settings.a_is_solid;
  question.b_is_solid = settings.b_is_solid;
  question.wants_way_out = settings.ways_out;
  return question;
}

/// Makes the bounds that a question asks for.
void refit_for(const PairQuery& question, Surface& surface) {
  if (wants_blocks(question.detail, question.mode)) return surface.make_blocks();
  surface.refit(boxes_for(question.detail));
  if (question.mode == AccuracyMode::paper) surface.refit(RefitOf::radii);
}

/// One of the two surfaces of a query.
class QueriedSurface {
 public:
  /// `name` is its name in messages.
  QueriedSurface(const Mesh& mesh, const char* name, bool is_solid)
      : name_(name), surface_(std::make_shared<const Mesh>(mesh)) {
    if (!is_solid) return;
    if (const auto problem = why_not_closed(surface_.mesh()))
      throw Error(name_ + ": a solid has a closed surface; " + *problem);
  }

  /// Throws Error if a view cannot be its positions. The coordinates are not looked at.
  void check(const PositionView& positions) const {
    if (const auto problem = problem_of_view(positions, surface_.mesh().vertex_count()))
      throw Error(name_ + " got " + problem->got);
  }
  void read(const PositionView& positions) {
    const Surface::ReadResult read = surface_.set_positions(positions);
    if (!read.taken()) throw Error(name_ + ": " + bad_vertex_text(read.bad_vertex, read.bad_position));
  }
  [[nodiscard]] Surface& surface() { return surface_; }

 private:
  std::string name_;
  Surface surface_;
};

}  // namespace

struct RepeatedQuery::State {
  State(const Mesh& mesh_a, const Mesh& mesh_b, const QuerySettings& given)
      : settings(checked(given)),
        question(question_of(settings)),
        a(mesh_a, "query: surface a", settings.a_is_solid),
        b(mesh_b, "query: surface b", settings.b_is_solid) {}

  static const QuerySettings& checked(const QuerySettings& settings) {
    if (const auto problem = problem_of(settings)) throw Error(*problem);
    return settings;
  }

  void ask(const PositionView& positions_a, const PositionView& positions_b) {
    a.check(positions_a);
    b.check(positions_b);
    a.read(positions_a);
    b.read(positions_b);
    // The vector of the last result is filled again.
    answer.contacts.swap(result.contacts);
    result.is_in_range = search();
    if (!result.is_in_range) bound_from_outside();
    take_answer();
  }

  /// Answers, and returns whether the surfaces are in range. No search is needed if their boxes are not.
  bool search() {
    bound_from_outside();
    if (!answer.listed) return false;
    refit_for(question, a.surface());
    refit_for(question, b.surface());
    detector.detect(a.surface(), b.surface(), question, answer, counters);
    return answer.listed;
  }

  /// Answers with bounds that need no search.
  void bound_from_outside() { PairDetector::outer_bounds(a.surface(), b.surface(), question, answer); }

  void take_answer() {
    result.in_contact = answer.in_contact;
    result.contacts_cut = answer.cut;
    result.inside = answer.inside;
    result.distance = answer.distance;
    if (!result.is_in_range) result.distance.lower = std::max(result.distance.lower, question.reach);
    result.witness = answer.witness;
    result.way_out = answer.way_out;
    result.contacts.swap(answer.contacts);
  }

  const QuerySettings settings;
  const PairQuery question;
  QueriedSurface a;
  QueriedSurface b;
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
  QueryResult result;
};

RepeatedQuery::RepeatedQuery(const Mesh& mesh_a, const Mesh& mesh_b, const QuerySettings& settings) {
  const FloatingPointScope scope;
  state_ = std::make_unique<State>(mesh_a, mesh_b, settings);
}
RepeatedQuery::~RepeatedQuery() = default;
RepeatedQuery::RepeatedQuery(RepeatedQuery&&) noexcept = default;
RepeatedQuery& RepeatedQuery::operator=(RepeatedQuery&&) noexcept = default;

const QueryResult& RepeatedQuery::ask(PositionView positions_a, PositionView positions_b) {
  const FloatingPointScope scope;
  state_->ask(positions_a, positions_b);
  return state_->result;
}

QueryResult query(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b, PositionView positions_b,
                  const QuerySettings& settings) {
  return RepeatedQuery(mesh_a, mesh_b, settings).ask(positions_a, positions_b);
}

}  // namespace graze
