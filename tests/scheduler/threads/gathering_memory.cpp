#include "scheduler/threads/gathering_memory.hpp"

#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <new>
#include <stdexcept>
#include <vector>

namespace graze::tests {
namespace {

// State of the signal handler. A handler may only call functions that are safe in it, so this one counts,
// looks at the clock and opens the page.
std::byte* first_page = nullptr;
std::size_t page_size = 0;
std::atomic<unsigned> waited_for{0};
std::atomic<unsigned> arrived{0};
std::atomic<bool> gave_up{false};
struct sigaction previous_action;

bool timed_out(const timespec& start) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec - start.tv_sec > 10;
}

void wait_for_others() {
  // A thread that comes here a second time finds that all have arrived, or that somebody gave up.
  if (arrived.load() >= waited_for.load() || gave_up.load()) return;
  ++arrived;
  timespec start{};
  clock_gettime(CLOCK_MONOTONIC, &start);
  while (arrived.load() < waited_for.load() && !gave_up.load()) {
    if (timed_out(start)) gave_up.store(true);
    sched_yield();
  }
}

void on_touch(int signal, siginfo_t* info, void*) {
  auto* const address = static_cast<std::byte*>(info->si_addr);
  if (address < first_page || address >= first_page + GatheringMemory::page_count * page_size) {
    sigaction(signal, &previous_action, nullptr);  // not ours: it happens again, to whom it belongs
    return;
  }
  wait_for_others();
  const auto offset = static_cast<std::size_t>(address - first_page) / page_size * page_size;
  mprotect(first_page + offset, page_size, PROT_READ | PROT_WRITE);
}

}  // namespace

GatheringMemory::GatheringMemory(unsigned threads) {
  page_size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, page_count * page_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  pages_ = first_page = static_cast<std::byte*>(memory);
  waited_for = threads;
  arrived = 0;
  gave_up = false;
  for (std::size_t index = 0; index < page_count; ++index) {
    auto* const points = reinterpret_cast<double*>(pages_ + index * page_size);
    const std::array<double, 9> triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (std::size_t i = 0; i < triangle.size(); ++i)
      points[i] = triangle[i] + (i % 3 == 0 ? 8.0 * static_cast<double>(index) : 0.0);
  }
  struct sigaction action {};
  action.sa_sigaction = on_touch;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  if (sigaction(SIGSEGV, &action, &previous_action) != 0) throw std::runtime_error("no handler for SIGSEGV");
}

GatheringMemory::~GatheringMemory() {
  sigaction(SIGSEGV, &previous_action, nullptr);
  munmap(pages_, page_count * page_size);
}

std::shared_ptr<const Mesh> GatheringMemory::mesh() {
  const std::vector<std::array<double, 3>> rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 1, 2}};
  return std::make_shared<const Mesh>(Mesh::from_triangles(rest, faces));
}

PositionView GatheringMemory::positions(std::size_t index) const {
  return {reinterpret_cast<const double*>(pages_ + index * page_size), 3};
}

void GatheringMemory::close() {
  mprotect(pages_, page_count * page_size, PROT_NONE);
}

unsigned GatheringMemory::threads_seen_at_once() const {
  return gave_up ? 0 : arrived.load();
}

}  // namespace graze::tests
