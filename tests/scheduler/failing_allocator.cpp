#include "scheduler/failing_allocator.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "sanitizers.hpp"

namespace graze::tests {
namespace {

std::atomic<bool> is_counting{false};
std::atomic<std::uint64_t> count{0};
std::atomic<std::uint64_t> first_failure{FailingAllocator::never};
std::atomic<std::uint64_t> last_failure{0};

/// Whether the allocation that is asked for now is one that fails.
bool fails() {
  if (!is_counting.load(std::memory_order_relaxed)) return false;
  const std::uint64_t place = count.fetch_add(1, std::memory_order_relaxed);
  return place >= first_failure.load(std::memory_order_relaxed) &&
         place <= last_failure.load(std::memory_order_relaxed);
}

void* allocated(std::size_t size, std::size_t alignment) {
  if (fails()) throw std::bad_alloc();
  void* const memory = alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
                           ? std::malloc(size)
                           : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void FailingAllocator::begin(std::uint64_t place, Lack lack) {
  count = 0;
  first_failure = place;
  last_failure = lack == Lack::once ? place : never;
  is_counting = true;
}

std::uint64_t FailingAllocator::end() {
  is_counting = false;
  return count;
}

}  // namespace graze::tests

void* operator new(std::size_t size) {
  return graze::tests::allocated(size, 1);
}
void* operator new[](std::size_t size) {
  return graze::tests::allocated(size, 1);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return graze::tests::allocated(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return graze::tests::allocated(size, static_cast<std::size_t>(alignment));
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

#if defined(__GLIBC__) && !defined(GRAZE_HAS_ADDRESS_SANITIZER) && !defined(GRAZE_HAS_THREAD_SANITIZER)

// oneTBB's memory: the program's allocator is replaced by itself, but that what this library asks for may
// fail.

#include <link.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace {

struct Library {
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;
};

int find_tbb(dl_phdr_info* info, std::size_t, void* found) {
  if (std::strstr(info->dlpi_name, "libtbb.so") == nullptr) return 0;
  Library& library = *static_cast<Library*>(found);
  library.begin = info->dlpi_addr;
  for (int i = 0; i < info->dlpi_phnum; ++i)
    if (info->dlpi_phdr[i].p_type == PT_LOAD)
      library.end =
          std::max(library.end, info->dlpi_addr + info->dlpi_phdr[i].p_vaddr + info->dlpi_phdr[i].p_memsz);
  return 1;
}

/// Whether it is oneTBB that asks, and the allocation is one that fails.
bool fails_for(const void* caller) {
  if (!graze::tests::is_counting.load(std::memory_order_relaxed)) return false;
  static const Library tbb = [] {
    Library library;
    dl_iterate_phdr(find_tbb, &library);
    return library;
  }();
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  return address >= tbb.begin && address < tbb.end && graze::tests::fails();
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  return fails_for(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  return fails_for(__builtin_return_address(0)) ? nullptr : __libc_calloc(count, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails_for(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = fails_for(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}

#endif
