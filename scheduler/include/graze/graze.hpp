#pragma once

/// @file
/// Includes everything that a program needs to embed graze: meshes, a scene and its reports. Files are read
/// and written by graze::io, which has headers of its own in `graze/io/`. What records a scene and replays it
/// is in `graze/recorder.hpp` and `graze/recording.hpp`.

#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <graze/contact_geometry.hpp>
#include <graze/contact_walk.hpp>
#include <graze/enumerators.hpp>
#include <graze/error.hpp>
#include <graze/impact.hpp>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/patch.hpp>
#include <graze/position_view.hpp>
#include <graze/query.hpp>
#include <graze/report.hpp>
#include <graze/scene.hpp>
#include <graze/scene_enumerators.hpp>
#include <graze/scene_query.hpp>
#include <graze/settings.hpp>
#include <graze/task_scheduler.hpp>
#include <graze/version.hpp>
#include <graze/weld.hpp>
