// Recordings that no recorder writes, with right checksums: records that a scene would refuse, and an index
// that is not what the file holds. They are refused with the place before anything uses them.

#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <limits>
#include <random>

#include "fuzz/recording/made_recording.hpp"
#include "fuzz/recording/recording_builder.hpp"
#include "fuzz/recording/recording_judge.hpp"
#include "recording/chunks.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

constexpr ObjectId sheet_id{0, 1};  ///< deformable, of 4 vertices and 1 face
constexpr ObjectId stone_id{1, 1};  ///< rigid, of 3 vertices and 1 face
constexpr double no_promise = std::numeric_limits<double>::infinity();

/// The message of a refusal, or nothing.
template <typename Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void replay_all(const Recording& recording, std::size_t first_frame = 0) {
  Replay replay(recording, {.threads = 1, .first_frame = first_frame});
  while (replay.step()) continue;
}

AddRecord addition_of(ObjectId id, std::uint64_t serial, std::uint32_t mesh, ObjectSettings settings = {}) {
  return {id, serial, mesh, std::move(settings)};
}

/// Writes a recording whose first step adds two objects, and whose second step has these records. `records`
/// stand in a keyframe too where `in_keyframe` says so.
void write_recording(const std::filesystem::path& path, const std::vector<Record>& records,
                     bool in_keyframe = false) {
  fuzz::RecordingBuilder builder(path, settings_of(0.5, 1));
  builder.add_mesh(*plate_mesh());
  builder.add_mesh(*needle_mesh());
  const std::vector<Record> additions{addition_of(sheet_id, 0, 0),
                                      addition_of(stone_id, 1, 1, motion_of(Motion::rigid))};
  builder.add_keyframe({});
  builder.add_step(additions, {}, true);
  if (in_keyframe) {
    std::vector<Record> all = additions;
    all.insert(all.end(), records.begin(), records.end());
    builder.add_keyframe(all);
    builder.add_step({});
  } else {
    builder.add_step(records);
  }
  builder.finish();
}

/// What views of positions in records point to.
struct Coordinates {
  std::vector<double> four = std::vector<double>(12, 0.5);
  std::vector<double> bad = std::vector<double>(12, std::numeric_limits<double>::quiet_NaN());
  std::vector<float> four_floats = std::vector<float>(12, 0.5F);

  [[nodiscard]] PositionView view(std::size_t count) const { return {four.data(), count}; }
  [[nodiscard]] PositionView bad_view() const { return {bad.data(), 4}; }
  [[nodiscard]] PositionView float_view() const { return {four_floats.data(), 4}; }
};

struct RefusedCase {
  std::vector<Record> records;
  std::string complaint;
};

/// Records that do not fit where they stand, the last of each list.
std::vector<RefusedCase> refused_cases(const Coordinates& at) {
  const SetPose doubled{stone_id, {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0}};
  const SetPose pose_of_sheet{sheet_id, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
  const BindRecord bound{sheet_id};
  const UnbindRecord unbound{.object = sheet_id, .positions = at.float_view()};
  const UnbindRecord for_no_reason{.object = sheet_id, .problem = DiagnosticKind::bad_rule, .positions = {}};
  ObjectSettings three_groups;
  three_groups.face_groups = {0, 0, 1};
  return {
      {{PositionsRecord{sheet_id, no_promise, at.view(1)}},
       "record 0: object 0 gets 1 positions for 4 vertices"},
      {{PositionsRecord{sheet_id, no_promise, {}}}, "record 0: object 0 gets 0 positions for 4 vertices"},
      {{bound, PositionsRecord{sheet_id, no_promise, at.view(3)}}, "record 1: object 0 gets 3 positions"},
      {{bound, PositionsRecord{sheet_id, no_promise, at.bad_view()}},
       "record 1: object 0 gets bad positions: vertex 0 is at nan"},
      {{PositionsRecord{sheet_id, -1, at.view(4)}},
       "object 0 gets a max_displacement that is negative or NaN"},
      {{PositionsRecord{stone_id, no_promise, at.view(3)}}, "object 1 gets positions, and is not deformable"},
      {{BindRecord{stone_id}}, "object 1 gets bound memory, and is not deformable"},
      {{MemoryRecord{sheet_id, at.view(4)}}, "object 0 gets memory without a binding"},
      {{bound, MemoryRecord{sheet_id, at.view(3)}}, "record 1: object 0 gets 3 positions for 4 vertices"},
      {{bound, MemoryRecord{sheet_id, at.float_view()}}, "gets memory of another form than its binding"},
      {{bound, unbound}, "object 0 gets positions of another form than its binding"},
      {{for_no_reason}, "object 0 gets the end of a binding for a reason that is none"},
      {{PositionsChanged{sheet_id, std::numeric_limits<double>::quiet_NaN()}}, "negative or NaN"},
      {{pose_of_sheet}, "object 0 gets a pose, and is deformable"},
      {{doubled}, "object 1 gets a bad pose: its matrix is no rotation"},
      {{RefusePose{{sheet_id, DiagnosticKind::bad_pose, ""}}},
       "object 0 gets a refused pose, and is deformable"},
      {{RefusePose{{stone_id, DiagnosticKind::bad_rule, ""}}}, "object 1 gets a refused pose for a reason"},
      {{IgnorePair{stone_id, stone_id, true}}, "a pair is of one object with itself"},
      {{SetRule{256, 0, {}}}, "kinds are 0 to 255"},
      {{addition_of(sheet_id, 2, 0)}, "object 2 is added with the id of an object that was added before"},
      {{RemoveObject{sheet_id}, addition_of(sheet_id, 2, 0)}, "record 1: object 2 is added with the id"},
      {{addition_of({2, 1}, 1, 0)}, "object 1 is added after object 1; the numbers of objects ascend"},
      {{addition_of({2, 0}, 2, 0)}, "object 2 is added with an id that no scene gives"},
      {{addition_of({2, 1}, 2, 7)}, "record 0: mesh 7 is not in the recording"},
      {{addition_of({2, 1}, 2, 0, {.margin = -1})}, "object '2': margin is -1"},
      {{addition_of({2, 1}, 2, 0, {.solid = true})}, "object 2 is a solid whose surface is not closed"},
      {{addition_of({2, 1}, 2, 0, three_groups)}, "object 2 gets 3 groups for 1 faces"},
      {{ReplaceRecord{sheet_id, 1, {0, 1, 2}, {}}},
       "object 0 gets new vertices for 3 old ones, and its mesh has 4"},
      {{ReplaceRecord{sheet_id, 1, {0, 1, 2, 3}, {}}},
       "object 0 gets the new vertex 3, and its new mesh has 3"},
      {{ReplaceRecord{sheet_id, 1, {0, 1, 2, 2}, {1, 1}}}, "object 0 gets 2 groups for 1 faces"},
      {{ReplaceRecord{sheet_id, 1, {0, 1, 2, 2}, {}}, PositionsRecord{sheet_id, no_promise, at.view(4)}},
       "record 1: object 0 gets 4 positions for 3 vertices"},
  };
}

/// Bytes by chance.
std::vector<std::uint8_t> random_bytes(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// Writes a recording of three frames, with an index that `change` has changed and right checksums.
template <typename Change>
void write_with_index(const std::filesystem::path& path, const Change& change) {
  write_recording(path, {});
  const std::string file = read_file(path);
  const auto bytes = std::as_bytes(std::span(file));
  FileEnd end;
  REQUIRE(read_checked(bytes.last(FileEnd::size), end));
  std::vector<IndexEntry> index;
  ByteSource source(bytes.subspan(static_cast<std::size_t>(end.index_offset) + ChunkHead::size));
  source(index);
  change(index);
  ByteBuffer chunk;
  begin_chunk(chunk);
  write_fields(chunk, index);
  seal_chunk(chunk, ChunkKind::index, 0);
  write_checked(chunk, end);
  const auto added = std::as_const(chunk).bytes();
  std::ofstream(path, std::ios::binary)
      << file.substr(0, static_cast<std::size_t>(end.index_offset))
      << std::string_view(reinterpret_cast<const char*>(added.data()), added.size());
}

}  // namespace

TEST_CASE("hostile recording: records that a scene would refuse are refused with their place") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "made.graze";
  const Coordinates coordinates;
  for (const auto& [records, complaint] : refused_cases(coordinates)) {
    INFO(complaint);
    write_recording(file, records);
    const Recording recording(file);
    const std::vector<std::string> messages{
        refusal_of([&] { recording.check(); }), refusal_of([&] { replay_all(recording); }),
        refusal_of([&] { cut_recording(recording, {.first_frame = 1}, folder / "part.graze"); })};
    for (const std::string& message : messages) {
      CHECK_THAT(message, Catch::Matchers::Contains(complaint));
      CHECK(message.find(file.string() + ": byte ") == 0);
      CHECK(message.find(": frame chunk: record ") != std::string::npos);
    }
    write_recording(file, records, true);
    const Recording of_keyframe(file);
    for (const std::size_t first_frame : {0U, 1U}) {
      const std::string message = refusal_of([&] { replay_all(of_keyframe, first_frame); });
      CHECK(message.find(": keyframe chunk: record ") != std::string::npos);
    }
  }
}

TEST_CASE("hostile recording: records about objects that are gone are none") {
  const TemporaryFolder folder;
  const Coordinates at;
  write_recording(
      folder / "made.graze",
      {RemoveObject{sheet_id}, PositionsRecord{sheet_id, no_promise, at.view(1)}, BindRecord{sheet_id},
       RemoveObject{sheet_id}, ReplaceRecord{sheet_id, 9, {}, {}}, IgnorePair{sheet_id, stone_id, true}});
  const Recording recording(folder / "made.graze");
  CHECK(refusal_of([&] { recording.check(); }) == "");
  CHECK(refusal_of([&] { replay_all(recording); }) == "");
}

TEST_CASE("hostile recording: made recordings of every kind of record are refused or taken as a whole") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "made.graze";
  std::size_t good = 0;
  constexpr unsigned count = 400;
  for (unsigned seed = 0; seed < count; ++seed) {
    INFO("seed " << seed);
    fuzz::make_recording(file, random_bytes(seed, 40 + seed));
    CHECK(fuzz::problem_of_recording(file, folder.path(), true) == "");
    if (refusal_of([&] { Recording(file).check(); }).empty()) ++good;
  }
  INFO(good << " of " << count);
  CHECK(good > count / 8);
  CHECK(good < count);
}

TEST_CASE("hostile recording: an index is what the file holds, or it is refused when the file is opened") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "made.graze";
  using Index = std::vector<IndexEntry>;
  const std::vector<std::pair<std::string, void (*)(Index&)>> changes{
      {"the index does not name what stands here",
       [](Index& index) { index.insert(index.end(), 30000, index.back()); }},
      {"the index does not name what stands here", [](Index& index) { index.pop_back(); }},
      {"the index does not name what stands here", [](Index& index) { index.erase(index.begin() + 1); }},
      {"the index does not name what stands here", [](Index& index) { std::swap(index[2], index[3]); }},
      {"the index does not name what stands here", [](Index& index) { index[1].offset += 8; }},
      {"the index names another chunk", [](Index& index) { index[1].number = 5; }},
      {"the index names another chunk", [](Index& index) { index.back().kind = ChunkKind::mesh; }}};
  write_with_index(file, [](Index&) {});
  CHECK(refusal_of([&] { replay_all(Recording(file)); }) == "");
  for (const auto& [complaint, change] : changes) {
    write_with_index(file, change);
    const std::string message = refusal_of([&] { const Recording recording(file); });
    CHECK_THAT(message, Catch::Matchers::Contains(complaint));
    CHECK(message.find(file.string() + ": byte ") == 0);
  }
}

}  // namespace graze::tests
