// What the viewer's page calls. A function returns -1 where something went wrong, and last_error() says what.
// Arrays and texts lie in the module's memory, where allocate() made room for them.

#include <emscripten/emscripten.h>

#include <cstdlib>
#include <exception>
#include <memory>

#include "page_scene.hpp"

namespace graze::wasm {
namespace {

std::unique_ptr<PageScene> made;
std::string error;

/// The result of a call, or -1.
template <typename Call>
int result_of(const Call& call) {
  try {
    return call();
  } catch (const std::exception& thrown) {
    error = thrown.what();
    return -1;
  }
}

}  // namespace
}  // namespace graze::wasm

extern "C" {

using graze::wasm::result_of;
using std::uint32_t;

EMSCRIPTEN_KEEPALIVE void* allocate(std::size_t bytes) {
  return std::malloc(bytes);
}
EMSCRIPTEN_KEEPALIVE void release(void* memory) {
  std::free(memory);
}
EMSCRIPTEN_KEEPALIVE const char* last_error() {
  return graze::wasm::error.c_str();
}
/// Begins a new scene, and forgets the one before.
EMSCRIPTEN_KEEPALIVE int begin_scene() {
  return result_of([] { return graze::wasm::made = std::make_unique<graze::wasm::PageScene>(), 0; });
}
/// 1 where the setting was taken, 0 for a key that is unknown here.
EMSCRIPTEN_KEEPALIVE int set_number(const char* key, double value) {
  return result_of([&] { return graze::wasm::made->set_number(key, value) ? 1 : 0; });
}
EMSCRIPTEN_KEEPALIVE int set_word(const char* key, const char* word) {
  return result_of([&] { return graze::wasm::made->set_word(key, word) ? 1 : 0; });
}
EMSCRIPTEN_KEEPALIVE int set_accuracy_within(double tolerance) {
  return result_of([&] { return graze::wasm::made->set_accuracy(graze::Accuracy::within(tolerance)), 1; });
}
EMSCRIPTEN_KEEPALIVE int set_accuracy_of_paper(const double* epsilon, std::size_t count) {
  return result_of([&] {
    return graze::wasm::made->set_accuracy(graze::Accuracy::paper({epsilon, epsilon + count})), 1;
  });
}
EMSCRIPTEN_KEEPALIVE int add_mesh(const double* rest, std::size_t vertices, const uint32_t* corners,
                                  std::size_t corner_count, const uint32_t* corner_counts,
                                  std::size_t faces) {
  return result_of([&] {
    return static_cast<int>(
        graze::wasm::made->add_mesh({rest, 3 * vertices}, {corners, corner_count}, {corner_counts, faces}));
  });
}
EMSCRIPTEN_KEEPALIVE int set_object_number(const char* name, double value) {
  return result_of([&] { return graze::wasm::made->set_object_number(name, value) ? 1 : 0; });
}
EMSCRIPTEN_KEEPALIVE int set_face_groups(const uint32_t* groups, std::size_t count) {
  return result_of([&] { return graze::wasm::made->set_face_groups({groups, count}), 1; });
}
EMSCRIPTEN_KEEPALIVE int set_hidden_groups(const uint32_t* groups, std::size_t count) {
  return result_of([&] { return graze::wasm::made->set_hidden_groups({groups, count}), 1; });
}
/// The motion is a number of the enumeration: deformable, rigid, fixed.
EMSCRIPTEN_KEEPALIVE int add_object(uint32_t page_index, uint32_t mesh, uint32_t motion) {
  return result_of(
      [&] { return graze::wasm::made->add_object(page_index, mesh, static_cast<graze::Motion>(motion)), 0; });
}
EMSCRIPTEN_KEEPALIVE int set_positions(uint32_t page_index, const double* positions, std::size_t vertices) {
  return result_of([&] {
    return graze::wasm::made->set_positions(page_index, {positions, 3 * vertices}), 0;
  });
}
EMSCRIPTEN_KEEPALIVE int set_pose(uint32_t page_index, const double* rows) {
  return result_of([&] {
    std::array<double, 12> pose;
    std::copy_n(rows, pose.size(), pose.begin());
    return graze::wasm::made->set_pose(page_index, pose), 0;
  });
}
EMSCRIPTEN_KEEPALIVE int ignore_pair(uint32_t a, uint32_t b) {
  return result_of([&] { return graze::wasm::made->ignore(a, b), 0; });
}
EMSCRIPTEN_KEEPALIVE int ignore_groups(uint32_t a, uint32_t group_a, uint32_t b, uint32_t group_b) {
  return result_of([&] {
    return graze::wasm::made->ignore(a, static_cast<std::uint8_t>(group_a), b,
                                     static_cast<std::uint8_t>(group_b)),
           0;
  });
}
/// A threshold that is not a number is left to the scene.
EMSCRIPTEN_KEEPALIVE int set_rule(uint32_t kind_a, uint32_t kind_b, double contact_distance, double range,
                                  const double* epsilon, std::size_t count) {
  return result_of([&] {
    return graze::wasm::made->set_rule(kind_a, kind_b, contact_distance, range, {epsilon, count}), 0;
  });
}
/// The size of the table, which lies at table().
EMSCRIPTEN_KEEPALIVE int step(double page_frame, double number) {
  return result_of([&] {
    return static_cast<int>(
        graze::wasm::made->step(static_cast<std::uint64_t>(page_frame), static_cast<std::uint64_t>(number))
            .size());
  });
}
EMSCRIPTEN_KEEPALIVE const char* table() {
  return graze::wasm::made->table().data();
}

}  // extern "C"
