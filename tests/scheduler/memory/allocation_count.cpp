#include "scheduler/memory/allocation_count.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>

#include "sanitizers.hpp"

#if !defined(__GLIBC__) || defined(GRAZE_HAS_ADDRESS_SANITIZER) || defined(GRAZE_HAS_THREAD_SANITIZER)

namespace graze::tests {

bool AllocationCount::is_possible() {
  return false;
}
void AllocationCount::begin() {}
void AllocationCount::begin_of_this_thread() {}
void AllocationCount::end() {}
std::uint64_t AllocationCount::by_tbb() {
  return 0;
}
std::uint64_t AllocationCount::by_exceptions() {
  return 0;
}
std::uint64_t AllocationCount::by_others() {
  return 0;
}
std::uint64_t AllocationCount::held_bytes() {
  return 0;
}
std::string AllocationCount::first_of_others() {
  return {};
}

}  // namespace graze::tests

#else

#include <execinfo.h>
#include <link.h>
#include <malloc.h>

#include <cerrno>
#include <cstring>
#include <new>

namespace graze::tests {
namespace {

std::atomic<bool> is_counting{false};
std::atomic<bool> counts_one_thread{false};
thread_local bool is_that_thread = false;
std::atomic<std::uint64_t> count_of_tbb{0};
std::atomic<std::uint64_t> count_of_exceptions{0};
std::atomic<std::uint64_t> count_of_others{0};

/// The range of addresses at which a library is loaded.
struct Library {
  const char* name;
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;

  [[nodiscard]] bool has(std::uintptr_t address) const { return address >= begin && address < end; }
};
Library tbb{"libtbb.so"};
/// Its exceptions alone call malloc: all else in it calls operator new, which is replaced.
Library standard{"libstdc++.so"};
std::array<void*, 24> first_calls;
int first_call_count = 0;

int find(dl_phdr_info* info, std::size_t, void*) {
  for (Library* const library : {&tbb, &standard}) {
    if (std::strstr(info->dlpi_name, library->name) == nullptr) continue;
    library->begin = info->dlpi_addr;
    for (int i = 0; i < info->dlpi_phnum; ++i)
      if (info->dlpi_phdr[i].p_type == PT_LOAD)
        library->end =
            std::max(library->end, info->dlpi_addr + info->dlpi_phdr[i].p_vaddr + info->dlpi_phdr[i].p_memsz);
  }
  return 0;
}

void count(const void* caller) {
  if (!is_counting.load(std::memory_order_relaxed)) return;
  if (counts_one_thread.load(std::memory_order_relaxed) && !is_that_thread) return;
  const auto address = std::uintptr_t(caller);
  if (tbb.has(address))
    ++count_of_tbb;
  else if (standard.has(address))
    ++count_of_exceptions;
  else if (count_of_others.fetch_add(1) == 0)
    first_call_count = backtrace(first_calls.data(), static_cast<int>(first_calls.size()));
}

}  // namespace

bool AllocationCount::is_possible() {
  return true;
}

void AllocationCount::begin() {
  backtrace(first_calls.data(), 1);  // the first call of all loads a library
  dl_iterate_phdr(find, nullptr);
  first_call_count = 0;
  count_of_tbb = 0;
  count_of_exceptions = 0;
  count_of_others = 0;
  is_counting = true;
}

void AllocationCount::begin_of_this_thread() {
  is_that_thread = true;
  counts_one_thread = true;
  begin();
}

void AllocationCount::end() {
  is_counting = false;
  counts_one_thread = false;
  is_that_thread = false;
}

std::uint64_t AllocationCount::by_tbb() {
  return count_of_tbb;
}

std::uint64_t AllocationCount::by_exceptions() {
  return count_of_exceptions;
}

std::uint64_t AllocationCount::by_others() {
  return count_of_others;
}

std::uint64_t AllocationCount::held_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;  // of the heaps, and by pages of their own
}

std::string AllocationCount::first_of_others() {
  std::string text;
  char** const names = backtrace_symbols(first_calls.data(), first_call_count);
  for (int i = 0; i < first_call_count; ++i) text.append(names[i]).append("\n");
  std::free(names);
  return text;
}

}  // namespace graze::tests

// The functions below replace the program's allocator. Each counts the call and passes it on to the
// allocator.

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}

void* operator new(std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  if (void* const memory = __libc_malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) {
  graze::tests::count(__builtin_return_address(0));
  if (void* const memory = __libc_malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  graze::tests::count(__builtin_return_address(0));
  if (void* const memory = __libc_memalign(static_cast<std::size_t>(alignment), size)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  graze::tests::count(__builtin_return_address(0));
  if (void* const memory = __libc_memalign(static_cast<std::size_t>(alignment), size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

#endif
