// Declared access: a task may do what it declared and nothing else.

#include "base/access.hpp"

#include <graze/graze.hpp>
#include <iostream>
#include <stdexcept>

#include "base/task_pool.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {

#ifdef GRAZE_VALIDATE
namespace {

const int one = 0;
const int other = 0;

bool may_read(StepData data, const void* which) {
  try {
    require_read(data, which);
    return true;
  } catch (const std::logic_error&) {
    return false;
  }
}

bool may_write(StepData data, const void* which) {
  try {
    require_write(data, which);
    return true;
  } catch (const std::logic_error&) {
    return false;
  }
}

}  // namespace

TEST_CASE("access: what is declared may be done, and nothing else") {
  for (const StepData data : {StepData::surfaces, StepData::pairs}) {
    const StepData not_declared = data == StepData::surfaces ? StepData::pairs : StepData::surfaces;
    const auto declared = [&](const AccessRight& right) {
      return data == StepData::surfaces ? AccessRights{right, {}} : AccessRights{{}, right};
    };
    CHECK(may_write(data, &one));  // the thread that steps
    {
      const AccessScope nothing({});
      CHECK_FALSE(may_read(data, &one));
      CHECK_FALSE(may_write(data, &one));
      {
        const AccessScope reading(declared(AccessRight::read()));
        CHECK(may_read(data, &one));
        CHECK(may_read(data, &other));
        CHECK_FALSE(may_write(data, &one));
        CHECK_FALSE(may_read(not_declared, &one));
      }
      {
        const AccessScope writing(declared(AccessRight::write(&one)));
        CHECK(may_read(data, &one));
        CHECK(may_write(data, &one));
        CHECK_FALSE(may_read(data, &other));
        CHECK_FALSE(may_write(data, &other));
        CHECK_FALSE(may_write(not_declared, &one));
      }
      CHECK_FALSE(may_read(data, &one));
    }
    CHECK(may_write(data, &one));
  }
}

TEST_CASE("access: a task that declares nothing may touch nothing, on any number of threads") {
  for (const unsigned threads : {1U, 3U}) {
    TaskPool tasks(threads, ArenaPolicy::own);
    CHECK_THROWS_AS(tasks.run(10, [&](unsigned, std::size_t) { require_read(StepData::surfaces, &one); }),
                    std::logic_error);
    CHECK_NOTHROW(tasks.run(10, [&](unsigned, std::size_t) {
      const AccessScope reading({AccessRight::read(), {}});
      require_read(StepData::surfaces, &one);
    }));
    CHECK(may_write(StepData::pairs, &one));
  }
}

#else

TEST_CASE("access: what is declared may be done, and nothing else") {
  std::cout << "skipped: only builds with GRAZE_VALIDATE check what tasks declare\n";
}

#endif

}  // namespace graze::tests
