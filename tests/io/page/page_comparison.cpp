#include "io/page/page_comparison.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "io/decoded_report.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;

/// Counts what differs, so that a failure does not print each number.
struct Differences {
  std::size_t count = 0;
  void expect(bool is_equal) { count += is_equal ? 0 : 1; }
};

void compare_point(Differences& differences, const DecodedReport& decoded, const std::string& array,
                   std::size_t first, const Vector3d& point) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    differences.expect(decoded.real_bits(array, first + axis) ==
                       bits(point[static_cast<Eigen::Index>(axis)]));
}

void compare_feature(Differences& differences, const DecodedReport& decoded, const std::string& array,
                     std::size_t first, const Feature& feature) {
  differences.expect(decoded.word(array, first) == static_cast<std::uint32_t>(feature.kind));
  differences.expect(decoded.word(array, first + 1) == feature.index);
}

void compare_contact(Differences& differences, const DecodedReport& decoded, std::size_t row,
                     const Contact& contact, std::uint64_t since) {
  differences.expect(decoded.byte("contact_kind", row) == static_cast<int>(contact.kind));
  differences.expect(decoded.byte("contact_sides", row) == static_cast<int>(contact.side_a) +
                                                               4 * static_cast<int>(contact.side_b) +
                                                               (contact.sunk ? 16 : 0));
  compare_feature(differences, decoded, "contact_features", 4 * row, contact.feature_a);
  compare_feature(differences, decoded, "contact_features", 4 * row + 2, contact.feature_b);
  compare_point(differences, decoded, "contact_points", 6 * row, contact.point_a);
  compare_point(differences, decoded, "contact_points", 6 * row + 3, contact.point_b);
  compare_point(differences, decoded, "contact_normal", 3 * row, contact.normal);
  differences.expect(decoded.real_bits("contact_distance", row) == bits(contact.distance));
  differences.expect(decoded.word("contact_since", row) == since);
}

void compare_region(Differences& differences, const DecodedReport& decoded, std::size_t row,
                    const RegionDistance& region) {
  differences.expect(decoded.word("region_levels", row) == region.level);
  const std::array<std::uint32_t, 4> ids = {region.region_a, region.region_b, region.vertex_a,
                                            region.vertex_b};
  for (std::size_t i = 0; i < 4; ++i) differences.expect(decoded.word("region_ids", 4 * row + i) == ids[i]);
  compare_point(differences, decoded, "region_points", 6 * row, region.point_a);
  compare_point(differences, decoded, "region_points", 6 * row + 3, region.point_b);
  differences.expect(decoded.real_bits("region_distance", row) == bits(region.distance));
}

/// A pair has a row among the ways out, unless all of its own is 0.
void compare_way_out(Differences& differences, const DecodedReport& decoded, std::size_t pair,
                     const WayOut& way) {
  const std::optional<std::size_t> row = decoded.way_of(pair);
  differences.expect(row.has_value() == (way.fullness != 0 || way.point != Vector3d::Zero()));
  if (!row) return;
  compare_point(differences, decoded, "way_direction", 3 * *row, way.direction);
  compare_point(differences, decoded, "way_point", 3 * *row, way.point);
  differences.expect(decoded.real_bits("way_fullness", *row) == bits(way.fullness));
  differences.expect(decoded.real_bits("way_thickness", *row) == bits(way.thickness));
  differences.expect(decoded.real_bits("way_extent", *row) == bits(way.extent));
}

/// A pair has a row among the sweeps if it met or came near between two steps.
void compare_sweep(Differences& differences, const DecodedReport& decoded, std::size_t pair,
                   const PairReport& played, std::span<const Impact> impacts) {
  const std::optional<std::size_t> row = decoded.sweep_of(pair);
  differences.expect(row.has_value() ==
                     (played.time_of_impact < 1 || played.time_of_gap < 1 || !impacts.empty()));
  if (!row) return;
  differences.expect(decoded.real_bits("sweep_time_of_impact", *row) == bits(played.time_of_impact));
  differences.expect(decoded.real_bits("sweep_time_of_gap", *row) == bits(played.time_of_gap));
  const std::size_t first = decoded.word("sweep_impact_begin", *row);
  REQUIRE(decoded.word("sweep_impact_end", *row) - first == impacts.size());
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const std::size_t at = first + i;
    differences.expect(decoded.byte("impact_kind", at) == static_cast<int>(impacts[i].kind));
    differences.expect(decoded.byte("impact_status", at) == static_cast<int>(impacts[i].status));
    compare_feature(differences, decoded, "impact_features", 4 * at, impacts[i].feature_a);
    compare_feature(differences, decoded, "impact_features", 4 * at + 2, impacts[i].feature_b);
    differences.expect(decoded.real_bits("impact_times", 2 * at) == bits(impacts[i].lower));
    differences.expect(decoded.real_bits("impact_times", 2 * at + 1) == bits(impacts[i].upper));
  }
}

std::uint32_t index_of(const PagePlay& scene, ObjectId id) {
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].id == id) return i;
  return std::numeric_limits<std::uint32_t>::max();
}

void compare_pair(Differences& differences, const DecodedReport& decoded, std::size_t row,
                  const PagePlay& scene, const FrameReport& report, const PairReport& pair) {
  differences.expect(decoded.word("pair_a", row) == index_of(scene, pair.a));
  differences.expect(decoded.word("pair_b", row) == index_of(scene, pair.b));
  differences.expect(decoded.byte("pair_phase", row) == static_cast<int>(pair.phase));
  const int flags = (pair.complete ? 0 : 1) + (pair.stale ? 2 : 0) + (pair.contacts_cut ? 4 : 0);
  differences.expect(decoded.byte("pair_flags", row) == flags);
  differences.expect(decoded.byte("pair_inside", row) == static_cast<int>(pair.inside));
  differences.expect(decoded.real_bits("pair_lower", row) == bits(pair.distance.lower));
  differences.expect(decoded.real_bits("pair_upper", row) == bits(pair.distance.upper));
  compare_feature(differences, decoded, "witness_features", 4 * row, pair.witness.feature_a);
  compare_feature(differences, decoded, "witness_features", 4 * row + 2, pair.witness.feature_b);
  compare_point(differences, decoded, "witness_points", 6 * row, pair.witness.point_a);
  compare_point(differences, decoded, "witness_points", 6 * row + 3, pair.witness.point_b);
  compare_way_out(differences, decoded, row, pair.way_out);
  compare_sweep(differences, decoded, row, pair, report.impacts(pair));
  const std::size_t contacts = decoded.word("pair_contact_begin", row);
  REQUIRE(decoded.word("pair_contact_end", row) - contacts == pair.contact_count);
  for (std::size_t i = 0; i < pair.contact_count; ++i) {
    const Contact& contact = report.contacts(pair)[i];
    compare_contact(differences, decoded, contacts + i, contact, source_number(contact.since - 1));
  }
  const std::size_t regions = decoded.word("pair_region_begin", row);
  REQUIRE(decoded.word("pair_region_end", row) - regions == pair.region_distance_count);
  for (std::size_t i = 0; i < pair.region_distance_count; ++i)
    compare_region(differences, decoded, regions + i, report.region_distances(pair)[i]);
}

void compare_reports(const DecodedPage& page, const PagePlay& scene, std::uint64_t every) {
  Differences differences;
  for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame) {
    const FrameReport& report = scene.reports[static_cast<std::size_t>(frame * every)];
    const DecodedReport decoded(page, frame);
    REQUIRE(decoded.pair_end() - decoded.pair_begin() == report.pairs().size());
    for (std::size_t i = 0; i < report.pairs().size(); ++i)
      compare_pair(differences, decoded, decoded.pair_begin() + i, scene, report, report.pairs()[i]);
    const nlohmann::json& info = decoded.header().at("frames_info").at(decoded.index());
    differences.expect(info.at("frame") == source_number(frame * every));
    differences.expect(info.at("tag") == std::to_string(3 * frame * every));
    differences.expect(info.at("complete") == report.complete());
    differences.expect(info.at("statistics").at("contacts") == report.statistics().contacts);
  }
  CHECK(differences.count == 0);
}

/// Whether a shape is drawn as it was played.
void compare_shape(Differences& differences, const DecodedShape& shape, const PlayedObject& object,
                   std::size_t index, double error) {
  if (object.page.motion != Motion::deformable) {
    for (std::size_t i = 0; i < 12; ++i)
      differences.expect(bits(shape.pose[i]) == bits(object.poses[index][i]));
    return;
  }
  const std::vector<Vector3d>& points = object.positions[index];
  REQUIRE(shape.positions.size() == points.size());
  for (std::uint32_t vertex = 0; vertex < points.size(); ++vertex) {
    const bool is_drawn = object.page.mesh->is_used(vertex) && points[vertex].allFinite();
    const auto& drawn = shape.positions[vertex];
    differences.expect(drawn.has_value() == is_drawn);
    if (drawn && is_drawn) differences.expect((*drawn - points[vertex]).cwiseAbs().maxCoeff() <= error);
  }
}

void compare_motion(const DecodedPage& page, const PagePlay& scene, std::uint64_t every) {
  Differences differences;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const PlayedObject& object = scene.objects[i];
    const nlohmann::json& described = page.head().at("objects").at(i);
    const double error = described.at("position_error");
    if (object.page.motion == Motion::deformable)
      CHECK(error <= std::ldexp(1.3, -16));  // the cloth is 1.2 wide; its waves are less high
    else
      CHECK(error == 0);
    for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame) {
      const std::uint64_t played = frame * every;
      const bool exists = played >= object.added && (!object.removed || played < *object.removed);
      const auto signed_frame = static_cast<std::int64_t>(frame);
      differences.expect(exists == (described.at("first").get<std::int64_t>() <= signed_frame &&
                                    signed_frame <= described.at("last").get<std::int64_t>()));
      const auto shape = page.shape(i, frame);
      if (!exists) continue;
      REQUIRE(shape);
      compare_shape(differences, *shape, object, static_cast<std::size_t>(played - object.added), error);
    }
  }
  CHECK(differences.count == 0);
}

void compare_head(const DecodedPage& page, const PagePlay& scene, std::uint64_t every) {
  const nlohmann::json& head = page.head();
  CHECK(head.at("version") == 2);
  CHECK(head.at("title") == "a </script> title");
  CHECK(head.at("source") == "scene.json");
  CHECK(head.at("settings").at("contact_distance") == 0.03);
  CHECK(head.at("settings").at("range") == "infinity");
  CHECK(head.at("every") == every);
  CHECK(head.at("source_frames") == scene.reports.size());
  REQUIRE(head.at("frames") == (scene.reports.size() + every - 1) / every);
  for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame)
    CHECK(head.at("frame_numbers").at(frame) == source_number(frame * every));
  CHECK(head.at("diverged").at(0) == (10 + every - 1) / every);
  // 11 frames are missing before frame 11, 12 before frame 12, and 3 at the end.
  std::map<std::uint64_t, std::uint64_t> dropped;
  dropped[(11 + every - 1) / every] += 11;
  dropped[(12 + every - 1) / every] += 12;
  dropped[page.frame_count()] += 3;
  nlohmann::json pairs = nlohmann::json::array();
  for (const auto& [before, count] : dropped) pairs.push_back({before, count});
  CHECK(head.at("dropped") == pairs);
  REQUIRE(head.at("objects").size() == scene.objects.size());
  CHECK(head.at("objects").at(0).at("name") == "cloth </script><b>\"");
  CHECK(head.at("objects").at(1).at("user_data") == "9223372036854775808");
  CHECK(head.at("objects").at(2).at("motion") == "fixed");
  CHECK(head.at("objects").at(0).at("solid") == false);
  CHECK(head.at("objects").at(2).at("solid") == true);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    CHECK(head.at("objects").at(i).at("swept") == scene.objects[i].page.swept);
  CHECK(head.at("meshes").size() == 2);
}

void compare_series(const DecodedPage& page, const PagePlay& scene, std::uint64_t every) {
  const nlohmann::json& series = page.head().at("series");
  for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame) {
    const FrameReport& report = scene.reports[static_cast<std::size_t>(frame * every)];
    std::size_t ended = 0;
    std::size_t crossing = 0;
    for (const PairReport& pair : report.pairs()) {
      ended += pair.phase == PairPhase::ended;
      crossing += pair.inside == Inside::crossing;
    }
    CHECK(series.at("contacts").at(frame) == report.contacts().size());
    CHECK(series.at("near").at(frame) == report.pairs().size());
    CHECK(series.at("ended").at(frame) == ended);
    CHECK(series.at("crossing").at(frame) == crossing);
    CHECK(series.at("inside").at(frame) == 0);
    CHECK(series.at("impacts").at(frame) == report.impacts().size());
    CHECK(series.at("diagnostics").at(frame) == report.diagnostics().size());
    CHECK(series.at("step_ms").at(frame) == report.statistics().times.step_ms);
    nlohmann::json deepest;
    for (const Contact& contact : report.contacts())
      if (deepest.is_null() || contact.separation() < deepest.get<double>()) deepest = contact.separation();
    CHECK(series.at("deepest").at(frame) == deepest);
  }
}

}  // namespace

void compare_page(const std::filesystem::path& file, const PagePlay& scene, std::uint64_t every) {
  const DecodedPage page(file);
  compare_head(page, scene, every);
  compare_series(page, scene, every);
  compare_reports(page, scene, every);
  compare_motion(page, scene, every);
}

}  // namespace graze::tests
