#pragma once

/// Everything that a program needs to embed graze: meshes, a scene, its reports.

#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <graze/error.hpp>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/scene.hpp>
#include <graze/settings.hpp>
