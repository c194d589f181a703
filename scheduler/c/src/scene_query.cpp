#include "calls.hpp"
#include "handles.hpp"
#include "layout.hpp"
#include "positions.hpp"
#include "reports.hpp"

using graze::c::array;
using graze::c::BadArgument;
using graze::c::given;
using graze::c::guarded;
using graze::c::point_of;
using graze::c::same;

namespace {

graze::SceneQuery& query_of(graze_scene_query* query) {
  return given(query, "query").query;
}
graze::MeshProbe& probe_of(graze_probe* probe) {
  return given(probe, "probe").probe;
}

graze::QueryFilter filter_of(const graze_query_filter* filter) {
  return filter == nullptr ? graze::QueryFilter{} : same<graze::QueryFilter>(*filter);
}

/// Returns the caller's room for answers, as the structs of C++.
template <typename Row>
auto room_of(Row* rows, std::size_t room, const char* name) {
  return std::span(graze::c::cpp_rows(array(rows, room, name).data()), room);
}

/// Returns the handle that a query keeps. A copy of a report keeps its surfaces without one.
graze::ReportHandle handle_of(const graze_report* report) {
  if (report == nullptr) return {};
  if (report->copy) throw BadArgument("report is a copy; ask about the report of the scene");
  return report->handle;
}

}  // namespace

extern "C" {

graze_status graze_scene_query_new(const graze_report* report, graze_scene_query** query) {
  return guarded([&] {
    auto& room = given(query, "query");
    room = new graze_scene_query{graze::SceneQuery(handle_of(report))};
  });
}

graze_status graze_scene_query_set_report(graze_scene_query* query, const graze_report* report) {
  return guarded([&] { query_of(query).set_report(handle_of(report)); });
}

graze_status graze_scene_query_report(const graze_scene_query* query, graze_report** report) {
  return guarded([&] {
    graze_report*& room = given(report, "report");
    const graze::ReportHandle& asked = given(query, "query").query.report();
    if (asked) {
      graze::c::ReportRoom(report).take(asked);
    } else {
      graze_report_release(room);
      room = nullptr;
    }
  });
}

void graze_scene_query_release(graze_scene_query* query) {
  delete query;
}

graze_status graze_scene_query_cast_ray(graze_scene_query* query, const double origin[3],
                                        const double direction[3], double limit,
                                        const graze_query_filter* filter, graze_ray_hit* hits, size_t room,
                                        size_t* count) {
  return guarded([&] {
    given(count, "count") =
        query_of(query).cast_ray(point_of(origin, "origin"), point_of(direction, "direction"), limit,
                                 room_of(hits, room, "hits"), filter_of(filter));
  });
}

graze_status graze_scene_query_cast_sphere(graze_scene_query* query, const double from[3], const double to[3],
                                           double radius, const graze_query_filter* filter,
                                           graze_sphere_hit* hits, size_t room, size_t* count) {
  return guarded([&] {
    given(count, "count") = query_of(query).cast_sphere(point_of(from, "from"), point_of(to, "to"), radius,
                                                        room_of(hits, room, "hits"), filter_of(filter));
  });
}

graze_status graze_scene_query_closest_points(graze_scene_query* query, const double point[3], double limit,
                                              const graze_query_filter* filter, graze_closest_point* points,
                                              size_t room, size_t* count) {
  return guarded([&] {
    given(count, "count") = query_of(query).closest_points(
        point_of(point, "point"), limit, room_of(points, room, "points"), filter_of(filter));
  });
}

graze_status graze_scene_query_is_free(graze_scene_query* query, graze_probe* probe, double clearance,
                                       const graze_query_filter* filter, bool* is_free) {
  return guarded([&] {
    given(is_free, "is_free") = query_of(query).is_free(probe_of(probe), clearance, filter_of(filter));
  });
}

graze_status graze_scene_query_blocking(graze_scene_query* query, graze_probe* probe, double clearance,
                                        const graze_query_filter* filter, graze_id* objects, size_t room,
                                        size_t* count) {
  return guarded([&] {
    given(count, "count") = query_of(query).blocking(probe_of(probe), clearance,
                                                     room_of(objects, room, "objects"), filter_of(filter));
  });
}

graze_status graze_scene_query_objects_in_box(graze_scene_query* query, const double min[3],
                                              const double max[3], const graze_query_filter* filter,
                                              graze_id* objects, size_t room, size_t* count) {
  return guarded([&] {
    given(count, "count") = query_of(query).objects_in_box(
        point_of(min, "min"), point_of(max, "max"), room_of(objects, room, "objects"), filter_of(filter));
  });
}

graze_status graze_probe_new(const graze_mesh* mesh, bool solid, graze_probe** probe) {
  return guarded([&] {
    auto& room = given(probe, "probe");
    room = new graze_probe{graze::MeshProbe(given(mesh, "mesh").mesh, solid)};
  });
}

graze_status graze_probe_set_pose(graze_probe* probe, const double rows[12]) {
  return guarded([&] { probe_of(probe).set_pose(graze::c::pose_of(rows)); });
}

graze_status graze_probe_set_positions(graze_probe* probe, const graze_positions* positions) {
  return guarded([&] { probe_of(probe).set_positions(graze::c::view_of(positions, "positions")); });
}

void graze_probe_release(graze_probe* probe) {
  delete probe;
}

}  // extern "C"
