#include "scheduler/memory/failing_allocator.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace graze::tests {
namespace {

std::atomic<bool> is_counting{false};
std::atomic<std::uint64_t> count{0};
std::atomic<std::uint64_t> first_failure{FailingAllocator::never};
std::atomic<std::uint64_t> last_failure{0};
thread_local bool is_exempt = false;

/// Whether the allocation that is asked for now is one that fails.
bool fails() {
  if (!is_counting.load(std::memory_order_relaxed) || is_exempt) return false;
  const std::uint64_t place = count.fetch_add(1, std::memory_order_relaxed);
  return place >= first_failure.load(std::memory_order_relaxed) &&
         place <= last_failure.load(std::memory_order_relaxed);
}

/// Null where there is none.
void* allocated_or_null(std::size_t size, std::size_t alignment) noexcept {
  if (fails()) return nullptr;
  if (alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__) return std::malloc(size);
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* allocated(std::size_t size, std::size_t alignment) {
  if (void* const memory = allocated_or_null(size, alignment)) return memory;
  throw std::bad_alloc();
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

void FailingAllocator::exempt_this_thread() {
  is_exempt = true;
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
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return graze::tests::allocated_or_null(size, 1);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return graze::tests::allocated_or_null(size, 1);
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
