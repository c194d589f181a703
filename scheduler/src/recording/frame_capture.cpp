#include "recording/frame_capture.hpp"

#include "base/wait_while.hpp"

namespace graze {

void CapturedFrame::clear() {
  record_count = 0;
  records.clear();
  is_fresh = is_snapshot = false;
  dropped_before = 0;
  meshes.clear();
  report = ReportHandle();
}

// ---- The queue

CapturedFrame* FrameQueue::free_frame() {
  const std::uint64_t pushed = pushed_.load(std::memory_order_relaxed);
  const bool is_full = pushed - popped_.load(std::memory_order_acquire) == frames_.size();
  return is_full ? nullptr : &frames_[pushed % frames_.size()];
}

CapturedFrame* FrameQueue::wait_for_free_frame() {
  while (true) {
    const std::uint64_t popped = popped_.load(std::memory_order_acquire);
    if (CapturedFrame* const frame = free_frame()) return frame;
    wait_while(popped_, popped);
  }
}

void FrameQueue::push() {
  pushed_.fetch_add(1, std::memory_order_release);
  pushed_.notify_one();
}

void FrameQueue::close() {
  pushed_.fetch_or(closed_bit, std::memory_order_release);
  pushed_.notify_one();
}

CapturedFrame* FrameQueue::wait_for_frame() {
  const std::uint64_t popped = popped_.load(std::memory_order_relaxed);
  while (true) {
    const std::uint64_t seen = pushed_.load(std::memory_order_acquire);
    if ((seen & ~closed_bit) != popped) return &frames_[popped % frames_.size()];
    if ((seen & closed_bit) != 0) return nullptr;
    wait_while(pushed_, seen);
  }
}

void FrameQueue::pop() {
  popped_.fetch_add(1, std::memory_order_release);
  popped_.notify_all();
}

void FrameQueue::wait_until_empty() {
  const std::uint64_t pushed = pushed_.load(std::memory_order_acquire) & ~closed_bit;
  while (true) {
    const std::uint64_t popped = popped_.load(std::memory_order_acquire);
    if (popped >= pushed) return;
    wait_while(popped_, popped);
  }
}

// ---- The capture

namespace {

/// About how many bytes the records of all objects take: so many at once are cheaper than growing.
std::size_t content_size(const ObjectStore& store) {
  constexpr std::size_t bytes_of_others = 512;
  std::size_t size = 0;
  for (const auto& object : store.objects())
    if (object != nullptr)
      size += bytes_of_others + 3 * sizeof(double) * object->mesh->vertex_count() +
              object->settings.face_groups.size();
  return size;
}

}  // namespace

void FrameCapture::begin_step(const ObjectStore& store, const PairFilter& filter) noexcept {
  store_ = &store;
  if (frame_ != nullptr) return;
  if (has_given_up()) return drop();
  frame_ = waits_ ? queue_.wait_for_free_frame() : queue_.free_frame();
  if (frame_ == nullptr) return drop();
  if (wants_whole_scene_.exchange(false, std::memory_order_acquire)) is_complete_ = false;
  frame_->clear();
  frame_->is_fresh = !is_complete_;
  frame_->is_snapshot = frame_->is_fresh && (store.next_serial() > 0 || filter.rules_version() > 0);
  frame_->dropped_before = dropped_before_;
}

void FrameCapture::see_content(const PairFilter& filter) noexcept {
  if (frame_ == nullptr || !frame_->is_snapshot) return;
  keep_or_drop([&] {
    frame_->records.reserve(content_size(*store_));
    for (const auto& object : store_->objects())
      if (object != nullptr) add_object(*object);
    filter.visit_rules([&](std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
      add_record(SetRule{kind_a, kind_b, rule});
    });
    filter.visit_ignored([&](std::uint64_t serial_a, std::uint64_t serial_b) {
      const Object* const a = store_->find_serial(serial_a);
      const Object* const b = store_->find_serial(serial_b);
      if (a != nullptr && b != nullptr) add_record(IgnorePair{a->id, b->id, true});
    });
    filter.ignored_groups().visit(
        [&](std::uint64_t serial_a, std::uint8_t group_a, std::uint64_t serial_b, std::uint8_t group_b) {
          const Object* const a = store_->find_serial(serial_a);
          const Object* const b = store_->find_serial(serial_b);
          if (a != nullptr && b != nullptr) add_record(IgnoreGroups{a->id, group_a, b->id, group_b, true});
        });
  });
  // A step that fails after this is done again with the same frame, which has the scene by then.
  if (frame_ != nullptr) frame_->is_snapshot = false;
}

void FrameCapture::see_memory(const Object& object) noexcept {
  if (frame_ == nullptr) return;
  keep_or_drop([&] { add_record(MemoryRecord{object.id, object.bound->view}); });
}

void FrameCapture::end_step(const ReportHandle& report) noexcept {
  if (frame_ == nullptr) {
    ++dropped_before_;
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  frame_->report = report;
  frame_ = nullptr;
  is_complete_ = true;
  dropped_before_ = 0;
  queue_.push();
}

void FrameCapture::drop() noexcept {
  frame_ = nullptr;
  is_complete_ = false;
}

std::uint32_t FrameCapture::number_of(const std::shared_ptr<const IndexedMesh>& mesh) {
  const auto known = meshes_.find(mesh.get());
  const bool is_known = known != meshes_.end() && !known->second.mesh.expired();
  const std::uint32_t number = is_known ? known->second.number : mesh_count_;
  frame_->meshes.emplace_back(number, mesh);
  if (is_known) return number;
  meshes_.insert_or_assign(mesh.get(), KnownMesh{number, mesh});
  ++mesh_count_;
  return number;
}

void FrameCapture::add_object(const Object& object) {
  add_record(AddRecord{object.id, object.serial, number_of(object.surface().shared_mesh()), object.settings});
  if (object.is_posed()) {
    if (object.pose)
      add_record(SetPose{object.id, *object.pose});
    else if (object.standing_pose)
      add_record(SetPose{object.id, *object.standing_pose});
  } else if (object.bound) {
    add_record(BindRecord{object.id, object.bound->policy, object.bound->view.is_double()});
    add_record(MemoryRecord{object.id, object.bound->view});
  } else if (object.positions) {
    add_record(PositionsRecord{object.id, std::numeric_limits<double>::infinity(), object.positions->view()});
  } else {
    add_record(
        PositionsRecord{object.id, std::numeric_limits<double>::infinity(), object.surface().positions()});
  }
  if (object.frozen && !object.positions) add_freezing_call(object);
}

/// Adds a call that freezes an object as it was frozen before the recording began.
void FrameCapture::add_freezing_call(const Object& object) {
  if (object.is_posed()) {
    if (store_->was_seen(object)) add_record(SettlePose{object.id});
    return add_record(RefusePose{{object.id, DiagnosticKind::bad_pose, "the pose was not taken"}});
  }
  if (object.bound) return;  // by the memory itself
  add_record(BindRecord{object.id});
  add_record(UnbindRecord{.object = object.id, .problem = DiagnosticKind::not_finite, .positions = {}});
}

void FrameCapture::add(const AddObject& call) {
  add_record(AddRecord{call.object, call.serial.value_or(store_->next_serial()),
                       number_of(call.surface->shared_mesh()), call.settings});
}

void FrameCapture::add(const ReplaceMesh& call) {
  add_record(ReplaceRecord{call.object, number_of(call.surface->shared_mesh()), call.new_of_old,
                           call.group_of_face});
}

void FrameCapture::add(const SetPositions& call) {
  if (store_->is_outdated(call)) return;
  add_record(PositionsRecord{call.object, call.max_displacement, call.positions->view()});
}

void FrameCapture::add(const BindPositions& call) {
  add_record(BindRecord{call.object, call.policy, call.view.is_double()});
}

void FrameCapture::add(const UnbindPositions& call) {
  UnbindRecord record{.object = call.object, .is_lost = call.is_lost, .positions = {}};
  const Object* const object = store_->find(call.object);
  const bool is_wanted = store_->wants(call);
  if (is_wanted && call.problem) record.problem = call.problem->kind;
  if (is_wanted && call.positions) record.positions = call.positions->view();
  record.is_frozen = object != nullptr && object->bound && record.positions.size() == 0 &&
                     (object->frozen || call.is_lost || record.problem != DiagnosticKind::stale_id);
  add_record(record);
}

}  // namespace graze
