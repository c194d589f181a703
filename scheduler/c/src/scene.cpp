#include <graze/graze.h>

#include "calls.hpp"
#include "handles.hpp"
#include "layout.hpp"
#include "reports.hpp"
#include "scheduler_of_caller.hpp"
#include "settings.hpp"

using graze::ObjectId;
using graze::c::array;
using graze::c::given;
using graze::c::guarded;
using graze::c::read_settings;
using graze::c::same;
using graze::c::scene_of;

namespace {

ObjectId id_of(graze_id id) {
  return same<ObjectId>(id);
}

}  // namespace

extern "C" {

graze_status graze_scene_new(const graze_scene_settings* settings, const graze_task_scheduler* scheduler,
                             graze_scene** scene) {
  return guarded([&] {
    auto& room = given(scene, "scene");
    const auto read = read_settings<graze::SceneSettings>(settings, "settings");
    const auto callers = graze::c::scheduler_of_caller(scheduler);
    room = new graze_scene{graze::Scene(read, callers)};
    if (callers) callers->take();
  });
}

void graze_scene_release(graze_scene* scene) {
  delete scene;
}

graze_status graze_scene_get_settings(const graze_scene* scene, graze_scene_settings* settings) {
  return guarded([&] {
    graze::c::fill(settings, given(settings, "settings").struct_size,
                   graze::c::to_c(scene_of(scene).settings()), "settings");
  });
}

graze_status graze_scene_add(graze_scene* scene, const graze_mesh* mesh,
                             const graze_object_settings* settings, graze_id* object) {
  return guarded([&] {
    auto& room = given(object, "object");
    room = same<graze_id>(scene_of(scene).add(given(mesh, "mesh").mesh,
                                              read_settings<graze::ObjectSettings>(settings, "settings")));
  });
}

graze_status graze_scene_replace_mesh(graze_scene* scene, graze_id object, const graze_mesh* mesh,
                                      const uint32_t* new_of_old, size_t new_of_old_count,
                                      const uint8_t* face_groups, size_t face_group_count) {
  return guarded([&] {
    scene_of(scene).replace_mesh(id_of(object), given(mesh, "mesh").mesh,
                                 array(new_of_old, new_of_old_count, "new_of_old"),
                                 array(face_groups, face_group_count, "face_groups"));
  });
}

graze_status graze_scene_remove(graze_scene* scene, graze_id object) {
  return guarded([&] { scene_of(scene).remove(id_of(object)); });
}

size_t graze_scene_object_count(const graze_scene* scene) {
  return scene ? scene->scene.object_count() : 0;
}

bool graze_scene_contains(const graze_scene* scene, graze_id object) {
  return scene != nullptr && scene->scene.contains(id_of(object));
}

graze_status graze_scene_mesh(const graze_scene* scene, graze_id object, graze_mesh** mesh) {
  return guarded([&] { graze::c::give_mesh(scene_of(scene).mesh(id_of(object)), mesh); });
}

graze_status graze_scene_get_object_settings(const graze_scene* scene, graze_id object,
                                             graze_object_settings* settings) {
  return guarded([&] {
    thread_local graze::ObjectSettings kept;  // what the caller's struct points into
    const size_t struct_size = given(settings, "settings").struct_size;
    graze::c::check_struct_size(struct_size, "settings");
    kept = scene_of(scene).object_settings(id_of(object));
    graze::c::fill(settings, struct_size, graze::c::to_c(kept), "settings");
  });
}

graze_status graze_scene_name(const graze_scene* scene, graze_id object, const char** name) {
  return guarded([&] {
    thread_local std::string kept;
    auto& room = given(name, "name");
    kept = scene_of(scene).name(id_of(object));
    room = kept.c_str();
  });
}

graze_status graze_scene_ignore(graze_scene* scene, graze_id a, graze_id b) {
  return guarded([&] { scene_of(scene).ignore(id_of(a), id_of(b)); });
}

graze_status graze_scene_watch(graze_scene* scene, graze_id a, graze_id b) {
  return guarded([&] { scene_of(scene).watch(id_of(a), id_of(b)); });
}

graze_status graze_scene_ignore_groups(graze_scene* scene, graze_id a, uint8_t group_a, graze_id b,
                                       uint8_t group_b) {
  return guarded([&] { scene_of(scene).ignore(id_of(a), group_a, id_of(b), group_b); });
}

graze_status graze_scene_watch_groups(graze_scene* scene, graze_id a, uint8_t group_a, graze_id b,
                                      uint8_t group_b) {
  return guarded([&] { scene_of(scene).watch(id_of(a), group_a, id_of(b), group_b); });
}

graze_status graze_scene_set_rule(graze_scene* scene, uint32_t kind_a, uint32_t kind_b,
                                  const graze_pair_rule* rule) {
  return guarded(
      [&] { scene_of(scene).set_rule(kind_a, kind_b, read_settings<graze::PairRule>(rule, "rule")); });
}

graze_status graze_scene_reserve(graze_scene* scene, const graze_scene_capacity* capacity) {
  return guarded([&] {
    static_cast<void>(given(capacity, "capacity"));
    scene_of(scene).reserve(read_settings<graze::SceneCapacity>(capacity, "capacity"));
  });
}

graze_status graze_scene_step(graze_scene* scene, uint64_t tag, graze_report** report) {
  return guarded([&] {
    graze::c::ReportRoom room(report);
    room.take(scene_of(scene).step(tag));
  });
}

graze_status graze_scene_step_async(graze_scene* scene, uint64_t tag) {
  return guarded([&] { scene_of(scene).step_async(tag); });
}

bool graze_scene_is_stepping(const graze_scene* scene) {
  return scene != nullptr && scene->scene.is_stepping();
}

graze_status graze_scene_wait(graze_scene* scene, graze_report** report) {
  return guarded([&] {
    graze::c::ReportRoom room(report);
    room.take(scene_of(scene).wait());
  });
}

graze_status graze_scene_latest_report(const graze_scene* scene, graze_report** report) {
  return guarded([&] {
    graze::c::ReportRoom room(&given(report, "report"));
    room.take(scene_of(scene).latest_report());
  });
}

}  // extern "C"
