#include <algorithm>
#include <graze/error.hpp>
#include <graze/io/page.hpp>

#include "page/gzip.hpp"
#include "page/page_block.hpp"
#include "page/page_file.hpp"
#include "page/page_filters.hpp"
#include "page/page_head.hpp"
#include "page/page_objects.hpp"

namespace graze::io {
namespace {

constexpr std::size_t most_block_frames = 32;
constexpr std::uint64_t head_bytes = 40;  // about, for each frame
constexpr std::uint64_t enough_block_bytes = std::uint64_t{4} << 20U;

const PageOptions& checked(const PageOptions& options) {
  if (options.every == 0) throw Error("page: `every` is 0; give 1 for each frame");
  return options;
}

}  // namespace

struct PageWriter::State {
  State(const std::filesystem::path& path, std::string_view page_template, const PageOptions& settings)
      : options(checked(settings)), file(path, page_template) {}

  void require_known_objects(const FrameReport& report) const;
  [[nodiscard]] bool is_block_full() const;
  void end_block();
  [[nodiscard]] std::uint64_t size_with(const PackedBlock& packed) const;
  /// Makes `options.every` larger if the page would become too large. Returns false if it need not be.
  bool take_fewer_frames(std::uint64_t size);
  void write_block(const PackedBlock& packed);
  void forget_block();
  [[nodiscard]] PageHead head();
  [[nodiscard]] std::vector<std::uint64_t> diverged_frames() const;
  [[nodiscard]] std::vector<DroppedFrames> dropped_frames() const;

  PageOptions options;  ///< `every` may grow until the first block is written
  PageFile file;
  PageObjects objects;
  PageMeshes meshes;
  PageFilters filters;
  PageBlock block;                           ///< the frames that wait
  std::uint64_t block_frames = 0;            ///< in a block, 0 until the first one is written
  std::uint64_t calls = 0;                   ///< of frame()
  std::uint64_t estimate = 0;                ///< of the file's size
  std::vector<std::uint64_t> frame_numbers;  ///< of the frames that were written
  PageSeries series;                         ///< of these
  std::vector<std::uint64_t> diverged;       ///< calls of frame()
  std::vector<DroppedFrames> dropped;        ///< before calls of frame()
};

void PageWriter::State::require_known_objects(const FrameReport& report) const {
  for (const PairReport& pair : report.pairs())
    if (!objects.index_of(pair.a) || !objects.index_of(pair.b))
      throw Error("page: the report has an object that the page has not; add objects before the frame");
}

bool PageWriter::State::is_block_full() const {
  const std::size_t count = block.frames().size();
  if (block_frames > 0) return count == block_frames;
  return count == most_block_frames || (count > 0 && block.raw_bytes() >= enough_block_bytes);
}

std::uint64_t PageWriter::State::size_with(const PackedBlock& packed) const {
  const std::uint64_t begin = frame_numbers.size();
  const std::uint64_t block_bytes =
      file.size_of_chunk(numbered_chunk("motion", begin), packed.motion.size()) +
      file.size_of_chunk(numbered_chunk("report", begin), packed.report.size());
  const std::uint64_t frames = page_frames_before(options.expected_frames.value_or(0), options.every);
  return file.byte_count() + head_bytes * frames + block_bytes * frames / block.frames().size();
}

bool PageWriter::State::take_fewer_frames(std::uint64_t size) {
  const std::uint64_t expected = options.expected_frames.value_or(0);
  if (!options.max_bytes || size <= *options.max_bytes || options.every >= expected) return false;
  const std::uint64_t fixed = file.byte_count();
  const std::uint64_t room = *options.max_bytes > fixed ? *options.max_bytes - fixed : 0;
  const std::uint64_t factor = room > 0 ? (size - fixed + room - 1) / room : expected;
  const std::uint64_t most = expected / options.every + 1;
  options.every *=
      static_cast<std::uint32_t>(std::clamp<std::uint64_t>(factor, 2, std::max<std::uint64_t>(most, 2)));
  return true;
}

void PageWriter::State::end_block() {
  const PackedBlock ready =
      packed(block, objects, {frame_numbers.size(), options.every, options.include_times});
  if (block_frames == 0) {
    const std::uint64_t size = options.expected_frames ? size_with(ready) : 0;
    if (estimate == 0) estimate = size;
    if (take_fewer_frames(size)) {
      for (const std::size_t object : block.thin(options.every)) objects.note_motion(object);
      return;
    }
    block_frames = block.frames().size();
  }
  write_block(ready);
  forget_block();
}

void PageWriter::State::write_block(const PackedBlock& packed) {
  const std::uint64_t number = frame_numbers.size() / block_frames;
  file.write_chunk(numbered_chunk("motion", number), packed.motion);
  file.write_chunk(numbered_chunk("report", number), packed.report);
  for (const auto& [object, error] : packed.errors) objects.note_error(object, error);
  for (const WaitingFrame& frame : block.frames()) {
    frame_numbers.push_back(frame.number);
    series.add(frame.report, options.include_times);
  }
}

void PageWriter::State::forget_block() {
  for (const WaitingFrame& frame : block.frames())
    for (const WaitingFrame::Move& move : frame.moves) objects.show(move.object, move.shape);
  block.clear();
  objects.forget_removed([this](std::uint64_t removed) {
    return page_frames_before(removed, options.every) <= frame_numbers.size();
  });
}

std::vector<std::uint64_t> PageWriter::State::diverged_frames() const {
  std::vector<std::uint64_t> frames;
  for (const std::uint64_t call : diverged) {
    const std::uint64_t frame = page_frames_before(call, options.every);
    if (frame < frame_numbers.size() && (frames.empty() || frames.back() != frame)) frames.push_back(frame);
  }
  return frames;
}

std::vector<DroppedFrames> PageWriter::State::dropped_frames() const {
  std::vector<DroppedFrames> frames;
  for (const auto& [call, count] : dropped) {
    const std::uint64_t frame =
        std::min<std::uint64_t>(page_frames_before(call, options.every), frame_numbers.size());
    if (!frames.empty() && frames.back().before == frame)
      frames.back().count += count;
    else
      frames.push_back({frame, count});
  }
  return frames;
}

PageHead PageWriter::State::head() {
  PageHead head;
  head.options = options;
  head.frame_numbers = frame_numbers;
  head.source_frames = calls;
  head.block = std::max<std::uint64_t>(block_frames, 1);
  head.meshes = meshes.counts();
  head.series = series;
  head.diverged = diverged_frames();
  head.dropped = dropped_frames();
  head.filters = filters;
  for (const WrittenObject& object : objects.all()) {
    const std::uint64_t end =
        object.removed ? page_frames_before(*object.removed, options.every) : frame_numbers.size();
    const std::uint64_t begin = page_frames_before(object.added, options.every);
    head.objects.push_back({object.name, object.motion, object.solid, object.swept, object.settings,
                            object.mesh_number, static_cast<std::int64_t>(begin),
                            static_cast<std::int64_t>(end) - 1, object.user_data, object.position_error});
  }
  return head;
}

PageWriter::PageWriter(const std::filesystem::path& path, std::string_view page_template,
                       const PageOptions& options)
    : state_(std::make_unique<State>(path, page_template, options)) {}
PageWriter::~PageWriter() = default;
PageWriter::PageWriter(PageWriter&&) noexcept = default;
PageWriter& PageWriter::operator=(PageWriter&&) noexcept = default;

void PageWriter::add_object(ObjectId id, const PageObject& object) {
  if (!object.mesh) throw Error("page: the object \"" + object.name + "\" has no mesh");
  const auto [number, is_new] = state_->meshes.number_of(object.mesh);
  state_->objects.add(id, object, number, state_->calls);
  if (is_new) state_->file.write_chunk(numbered_chunk("mesh", number), gzipped(mesh_table(*object.mesh)));
}

void PageWriter::remove_object(ObjectId id) {
  state_->objects.remove(id, state_->calls);
}

void PageWriter::set_positions(ObjectId id, const PositionView& positions) {
  state_->objects.set_positions(id, positions);
}

void PageWriter::set_pose(ObjectId id, const std::array<double, 12>& rows) {
  state_->objects.set_pose(id, rows);
}

void PageWriter::set_pair_filters(const PairFilters& filters) {
  state_->filters.set(filters, state_->objects, state_->calls);
}

void PageWriter::mark_diverged() {
  state_->diverged.push_back(state_->calls);
}

void PageWriter::mark_dropped(std::uint64_t frames) {
  if (frames > 0) state_->dropped.push_back({state_->calls, frames});
}

bool PageWriter::takes_next_frame() const {
  return state_->calls % state_->options.every == 0;
}

void PageWriter::frame(std::uint64_t number, const FrameReport& report) {
  state_->require_known_objects(report);
  if (takes_next_frame()) {
    WaitingFrame frame{state_->calls, number, report, {}};
    for (const std::size_t index : state_->objects.take_moved())
      frame.moves.push_back({index, state_->objects.all()[index].latest});
    state_->block.add(std::move(frame));
  }
  ++state_->calls;
  while (state_->is_block_full()) state_->end_block();
}

void PageWriter::close() {
  State& state = *state_;
  if (!state.block.frames().empty()) {
    if (state.block_frames == 0) state.block_frames = state.block.frames().size();
    state.end_block();
  }
  state.file.write_chunk("head", gzipped(state.head().json()));
  state.file.close();
}

std::uint32_t PageWriter::every() const {
  return state_->options.every;
}
std::uint64_t PageWriter::estimated_bytes() const {
  return state_->estimate;
}
std::uint64_t PageWriter::frame_count() const {
  return state_->frame_numbers.size() + state_->block.frames().size();
}
std::uint64_t PageWriter::byte_count() const {
  return state_->file.byte_count();
}

}  // namespace graze::io
