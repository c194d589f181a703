// A program with this file uses all workers in each round. The scenes of tests are small, so that their
// rounds would not pay for a second thread.

#include "base/task_pool.hpp"

namespace graze::tests {
namespace {

[[maybe_unused]] const bool uses_all_workers = (TaskPool::use_all_workers(true), true);

}  // namespace
}  // namespace graze::tests
