#include <zlib.h>

#include <bit>
#include <cmath>
#include <graze/graze.hpp>
#include <graze/io/error.hpp>
#include <graze/io/report_json.hpp>
#include <locale>
#include <random>
#include <string>
#include <vector>

#include "io/marked_report.hpp"
#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Eigen::Vector3d;
using graze::ReportHandle;
using graze::Scene;
using graze::io::InputError;
using graze::io::ReportedFrame;
using graze::io::ReportedPair;
using graze::io::ReportReader;
using graze::io::ReportWriter;
using graze::io::SceneObject;
using graze::tests::TemporaryFolder;

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const Vector3d& a, const Vector3d& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

/// Three crumpled sheets of mixed triangles and quads over each other, moved every frame by chance.
class CrumpledSheets {
 public:
  CrumpledSheets(double scale, unsigned seed) : scale_(scale), random_(seed) {
    graze::SceneSettings settings;
    settings.contact_distance = 0.2 * scale;
    settings.range = 3 * scale;
    settings.threads = 1;
    scene_ = std::make_unique<Scene>(settings);
    for (int i = 0; i < 3; ++i) {
      const auto mesh = std::make_shared<const graze::Mesh>(make_mesh());
      positions_.push_back(crumpled(0.15 * i));
      objects_.push_back({scene_->add(mesh, {.name = "sheet \"" + std::to_string(i) + "\""}),
                          "sheet \"" + std::to_string(i) + "\"", mesh});
    }
  }

  ReportHandle step() {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      positions_[i] = crumpled(0.15 * static_cast<double>(i));
      if (broken_ && i == 1) positions_[i][3].y() = std::nan("");
      scene_->bind_positions(objects_[i].id, positions_[i]);
    }
    return scene_->step();
  }
  void break_one() { broken_ = true; }
  [[nodiscard]] const std::vector<SceneObject>& objects() const { return objects_; }
  [[nodiscard]] const graze::SceneSettings& settings() const { return scene_->settings(); }

 private:
  static constexpr std::uint32_t side = 5;

  std::vector<Vector3d> crumpled(double height) {
    std::uniform_real_distribution<double> noise(-0.12, 0.12);
    std::vector<Vector3d> positions;
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x)
        positions.push_back(
            scale_ * Vector3d{0.5 * x + noise(random_), 0.5 * y + noise(random_), height + noise(random_)});
    positions[0].x() = -0.0;
    return positions;
  }

  graze::Mesh make_mesh() {
    std::vector<std::uint32_t> corners, counts;
    for (std::uint32_t y = 0; y + 1 < side; ++y)
      for (std::uint32_t x = 0; x + 1 < side; ++x) {
        const std::uint32_t a = y * side + x, b = a + 1, c = a + side + 1, d = a + side;
        if ((x + y) % 2 == 0) {
          corners.insert(corners.end(), {a, b, c, d});
          counts.push_back(4);
        } else {
          corners.insert(corners.end(), {a, b, c, a, c, d});
          counts.insert(counts.end(), {3, 3});
        }
      }
    return graze::Mesh::from_polygons(crumpled(0), corners, counts);
  }

  double scale_;
  std::mt19937 random_;
  std::vector<std::vector<Vector3d>> positions_;  // outlive the scene, which reads them
  std::vector<SceneObject> objects_;
  std::unique_ptr<Scene> scene_;
  bool broken_ = false;
};

void check_edge(const graze::Feature& feature, const graze::io::EdgeVertices& read, const graze::Mesh& mesh) {
  if (feature.kind == graze::FeatureKind::edge)
    CHECK(read == mesh.edge(feature.index));
  else
    CHECK(read == graze::io::EdgeVertices{});
}

void check_pair(const ReportedPair& read, const graze::FrameReport& report, const graze::PairReport& pair,
                const std::vector<SceneObject>& objects) {
  CHECK(objects[read.a].id == pair.a);
  CHECK(objects[read.b].id == pair.b);
  CHECK((read.phase == pair.phase && read.complete == pair.complete && read.stale == pair.stale));
  CHECK((same_bits(read.distance.lower, pair.distance.lower) &&
         same_bits(read.distance.upper, pair.distance.upper)));
  const graze::Mesh& mesh_a = *objects[read.a].mesh;
  const graze::Mesh& mesh_b = *objects[read.b].mesh;
  CHECK(
      (read.witness.feature_a == pair.witness.feature_a && read.witness.feature_b == pair.witness.feature_b));
  CHECK(same_bits(read.witness.point_a, pair.witness.point_a));
  CHECK(same_bits(read.witness.point_b, pair.witness.point_b));
  check_edge(pair.witness.feature_a, read.witness_edge_a, mesh_a);
  check_edge(pair.witness.feature_b, read.witness_edge_b, mesh_b);
  const graze::WayOut& way = pair.way_out;
  CHECK((same_bits(read.way_out.direction, way.direction) && same_bits(read.way_out.point, way.point)));
  CHECK((same_bits(read.way_out.fullness, way.fullness) && same_bits(read.way_out.thickness, way.thickness) &&
         same_bits(read.way_out.extent, way.extent)));
  const auto contacts = report.contacts(pair);
  REQUIRE(read.contacts.size() == contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const graze::Contact& contact = contacts[i];
    const graze::Contact& back = read.contacts[i].contact;
    CHECK((back.kind == contact.kind && back.side_a == contact.side_a && back.side_b == contact.side_b));
    CHECK((back.sunk == contact.sunk && same_bits(back.separation(), contact.separation())));
    CHECK((back.feature_a == contact.feature_a && back.feature_b == contact.feature_b));
    CHECK((same_bits(back.point_a, contact.point_a) && same_bits(back.point_b, contact.point_b)));
    CHECK((same_bits(back.normal, contact.normal) && same_bits(back.distance, contact.distance)));
    check_edge(contact.feature_a, read.contacts[i].edge_a, mesh_a);
    check_edge(contact.feature_b, read.contacts[i].edge_b, mesh_b);
  }
}

void check_statistics(const graze::StepStatistics& read, const graze::StepStatistics& written,
                      bool with_times) {
  CHECK(read.objects == written.objects);
  CHECK(read.pairs_total == written.pairs_total);
  CHECK(read.pairs_filtered == written.pairs_filtered);
  CHECK(read.pairs_tested == written.pairs_tested);
  CHECK(read.pairs_near == written.pairs_near);
  CHECK(read.pairs_in_contact == written.pairs_in_contact);
  CHECK(read.contacts == written.contacts);
  CHECK(read.work.region_pairs_tested == written.work.region_pairs_tested);
  CHECK(read.work.leaf_pairs_tested == written.work.leaf_pairs_tested);
  CHECK(read.work.discarded_in_float == written.work.discarded_in_float);
  CHECK(read.work.named_in_float == written.work.named_in_float);
  CHECK(read.work.decided_in_double == written.work.decided_in_double);
  CHECK(read.work.exact_decisions == written.work.exact_decisions);
  CHECK(read.bytes.objects == written.bytes.objects);
  CHECK(read.bytes.reports == written.bytes.reports);
  CHECK(read.work.regions_expanded == written.work.regions_expanded);
  CHECK(read.bytes.threads == (with_times ? written.bytes.threads : 0));
  CHECK(same_bits(read.times.step_ms, with_times ? written.times.step_ms : 0));
  CHECK(same_bits(read.times.read_ms, with_times ? written.times.read_ms : 0));
  CHECK(same_bits(read.times.pairs_ms, with_times ? written.times.pairs_ms : 0));
  CHECK(same_bits(read.times.refit_ms, with_times ? written.times.refit_ms : 0));
  CHECK(same_bits(read.times.jobs_ms, with_times ? written.times.jobs_ms : 0));
  CHECK(same_bits(read.times.publish_ms, with_times ? written.times.publish_ms : 0));
}

/// Writes `frames` steps, reads them back and compares everything. Returns how many contacts that were.
std::size_t check_round_trip(CrumpledSheets& sheets, int frames, bool with_times) {
  const TemporaryFolder folder;
  std::vector<ReportHandle> reports;
  ReportWriter writer(folder / "r.jsonl", sheets.objects(), sheets.settings(), {.include_times = with_times});
  for (int frame = 0; frame < frames; ++frame) {
    if (frame == 2) sheets.break_one();
    reports.push_back(sheets.step());
    writer.write(static_cast<std::uint64_t>(frame) * 7, *reports.back());
  }
  writer.close();
  const std::string text = graze::tests::read_file(folder / "r.jsonl");
  CHECK((text.find("_ms") != std::string::npos) == with_times);

  ReportReader reader(folder / "r.jsonl");
  REQUIRE(reader.objects().size() == sheets.objects().size());
  for (std::size_t i = 0; i < reader.objects().size(); ++i) {
    CHECK((reader.objects()[i].id == i && reader.objects()[i].name == sheets.objects()[i].name));
    CHECK(reader.objects()[i].vertices == sheets.objects()[i].mesh->vertex_count());
    CHECK(reader.objects()[i].faces == sheets.objects()[i].mesh->face_count());
  }
  CHECK(same_bits(reader.settings().contact_distance, sheets.settings().contact_distance));
  CHECK(same_bits(reader.settings().range, sheets.settings().range));
  CHECK(reader.settings().detail == sheets.settings().detail);

  std::size_t contacts = 0;
  for (std::size_t frame = 0; frame < reports.size(); ++frame) {
    const auto read = reader.next();
    REQUIRE(read);
    const graze::FrameReport& report = *reports[frame];
    CHECK((read->frame == frame * 7 && read->complete == report.complete()));
    REQUIRE(read->pairs.size() == report.pairs().size());
    for (std::size_t i = 0; i < read->pairs.size(); ++i)
      check_pair(read->pairs[i], report, report.pairs()[i], sheets.objects());
    REQUIRE(read->diagnostics.size() == report.diagnostics().size());
    for (std::size_t i = 0; i < read->diagnostics.size(); ++i) {
      CHECK(read->diagnostics[i].object == 1U);
      CHECK(read->diagnostics[i].kind == report.diagnostics()[i].kind);
      CHECK(read->diagnostics[i].message == report.diagnostics()[i].message);
    }
    check_statistics(read->statistics, report.statistics(), with_times);
    contacts += report.contacts().size();
  }
  CHECK_FALSE(reader.next());
  CHECK_FALSE(reports.back()->diagnostics().empty());
  return contacts;
}

/// What a scene of crumpled sheets reports in so many frames, written as `options` say.
std::vector<ReportHandle> write_report(const std::filesystem::path& file, std::uint64_t frames,
                                       const ReportWriter::Options& options) {
  CrumpledSheets sheets(1, 3);
  std::vector<ReportHandle> reports;
  ReportWriter writer(file, sheets.objects(), sheets.settings(), options);
  for (std::uint64_t frame = 0; frame < frames; ++frame) {
    reports.push_back(sheets.step());
    writer.write(frame, *reports.back());
  }
  writer.close();
  return reports;
}

}  // namespace

TEST_CASE("a report of each k-th frame has the first, and every k-th after it") {
  const TemporaryFolder folder;
  for (const std::uint64_t every : {1U, 2U, 3U, 50U}) {
    const auto reports = write_report(folder / "r.jsonl", 8, {.every = every});
    ReportReader reader(folder / "r.jsonl");
    CHECK(reader.every() == every);
    CHECK(reader.has_contacts());
    for (std::uint64_t frame = 0; frame < 8; frame += every) {
      const auto read = reader.next();
      REQUIRE(read);
      CHECK(read->frame == frame);
      CHECK(read->statistics.contacts == reports[frame]->contacts().size());
    }
    CHECK_FALSE(reader.next());
  }
  CHECK_THROWS_AS(ReportWriter(folder / "none.jsonl", {}, {}, {.every = 0}), graze::Error);
  CHECK_FALSE(std::filesystem::exists(folder / "none.jsonl"));
}

TEST_CASE("a report of pairs alone has all of a pair but its contacts, which it counts") {
  const TemporaryFolder folder;
  const auto reports = write_report(folder / "pairs.jsonl", 3, {.include_contacts = false});
  (void)write_report(folder / "all.jsonl", 3, {});
  ReportReader pairs(folder / "pairs.jsonl");
  ReportReader all(folder / "all.jsonl");
  CHECK_FALSE(pairs.has_contacts());
  std::size_t contacts = 0;
  for (const ReportHandle& report : reports) {
    const auto short_frame = pairs.next();
    const auto full_frame = all.next();
    REQUIRE((short_frame && full_frame));
    REQUIRE(short_frame->pairs.size() == report->pairs().size());
    for (std::size_t i = 0; i < short_frame->pairs.size(); ++i) {
      const ReportedPair& read = short_frame->pairs[i];
      CHECK(read.contacts.empty());
      CHECK(read.contact_count == report->pairs()[i].contact_count);
      CHECK(full_frame->pairs[i].contact_count == read.contact_count);
      CHECK((read.phase == report->pairs()[i].phase && read.inside == report->pairs()[i].inside));
      CHECK(same_bits(read.distance.upper, report->pairs()[i].distance.upper));
      CHECK(same_bits(read.witness.point_a, report->pairs()[i].witness.point_a));
      contacts += read.contact_count;
    }
  }
  CHECK(contacts > 30);
  CHECK(std::filesystem::file_size(folder / "pairs.jsonl") <
        std::filesystem::file_size(folder / "all.jsonl") / 2);
}

TEST_CASE("a report that is compressed reads back as the same lines, whatever its name is then") {
  const TemporaryFolder folder;
  const ReportWriter::Options options{.include_times = false};
  (void)write_report(folder / "r.jsonl", 40, options);
  (void)write_report(folder / "r.jsonl.gz", 40, options);
  (void)write_report(folder / "again.GZ", 40, options);
  const std::string packed = graze::tests::read_file(folder / "r.jsonl.gz");
  const std::string plain = graze::tests::read_file(folder / "r.jsonl");
  CHECK(packed == graze::tests::read_file(folder / "again.GZ"));
  CHECK(packed.size() < plain.size() / 2);
  std::filesystem::rename(folder / "r.jsonl.gz", folder / "renamed");
  gzFile file = gzopen((folder / "renamed").c_str(), "rb");
  std::string unpacked(plain.size() + 1, ' ');
  REQUIRE(gzread(file, unpacked.data(), static_cast<unsigned>(unpacked.size())) ==
          static_cast<int>(plain.size()));
  gzclose(file);
  CHECK(unpacked.compare(0, plain.size(), plain) == 0);
  ReportReader reader(folder / "renamed");
  std::size_t frames = 0;
  while (reader.next()) ++frames;
  CHECK(frames == 40);
}

TEST_CASE("a compressed report that is cut off or damaged is refused in a line") {
  const TemporaryFolder folder;
  (void)write_report(folder / "r.gz", 10, {});
  const std::string packed = graze::tests::read_file(folder / "r.gz");
  const auto error_of = [&](const std::string& bytes) -> std::string {
    try {
      ReportReader reader(folder.write("bad.gz", bytes));
      while (reader.next()) continue;
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK(error_of(packed) == "accepted");
  for (std::size_t bytes = 2; bytes < packed.size(); bytes += 1 + packed.size() / 97) {
    INFO(bytes << " of " << packed.size());
    CHECK_THAT(error_of(packed.substr(0, bytes)), Catch::Matchers::Contains("is damaged or cut off") ||
                                                      Catch::Matchers::Contains("line 1: not valid JSON"));
  }
  std::string damaged = packed;
  damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
  CHECK(error_of(damaged) != "accepted");
}

TEST_CASE("a report that is read back has the same bits, at every scale") {
  for (const double scale : {1.0, 0x1p-60, 0x1p60}) {
    CrumpledSheets sheets(scale, 3);
    CHECK(check_round_trip(sheets, 4, true) > 50);
  }
}

TEST_CASE(
    "a report keeps contacts that are sunk and ways out, and says nothing of them where there are none") {
  const TemporaryFolder folder;
  CrumpledSheets sheets(1, 3);
  const graze::FrameReport plain = *sheets.step();
  const graze::FrameReport marked = graze::tests::marked_report(plain);
  REQUIRE(graze::tests::sunk_count(marked) > 3);
  const auto text_of = [&](const graze::FrameReport& report, const ReportWriter::Options& options) {
    ReportWriter writer(folder / "r.jsonl", sheets.objects(), sheets.settings(), options);
    writer.write(0, report);
    writer.close();
    return graze::tests::read_file(folder / "r.jsonl");
  };
  for (const bool has_contacts : {true, false}) {
    const std::string text = text_of(marked, {.include_contacts = has_contacts});
    CHECK((text.find("\"sunk\":true") != std::string::npos) == has_contacts);
    ReportReader reader(folder / "r.jsonl");
    const auto read = reader.next();
    REQUIRE((read && read->pairs.size() == marked.pairs().size()));
    for (std::size_t i = 0; has_contacts && i < read->pairs.size(); ++i)
      check_pair(read->pairs[i], marked, marked.pairs()[i], sheets.objects());
    CHECK(same_bits(read->pairs[0].way_out.extent, marked.pairs()[0].way_out.extent));
    CHECK(same_bits(read->pairs[1].way_out.point, marked.pairs()[1].way_out.point));
  }
  const std::string text = text_of(plain, {});
  CHECK((text.find("\"sunk\":true") != std::string::npos) == (graze::tests::sunk_count(plain) > 0));
  for (const char* word : {"way_out", "ways_out", "carrying"}) {
    INFO(word);
    CHECK(text.find(word) == std::string::npos);
  }
}

TEST_CASE("since counts in the frames of the file, which may begin at any number") {
  const TemporaryFolder folder;
  for (const std::uint64_t first : {0U, 1U, 5U}) {
    CrumpledSheets sheets(1, 3);
    std::vector<ReportHandle> reports;
    ReportWriter writer(folder / "r.jsonl", sheets.objects(), sheets.settings());
    for (std::uint64_t frame = first; frame < first + 4; ++frame) {
      reports.push_back(sheets.step());
      writer.write(frame, *reports.back());
    }
    writer.close();
    ReportReader reader(folder / "r.jsonl");
    std::size_t from_the_first = 0;
    std::size_t later = 0;
    for (const ReportHandle& report : reports) {
      const auto read = reader.next();
      REQUIRE(read);
      for (std::size_t i = 0; i < read->pairs.size(); ++i)
        for (std::size_t j = 0; j < read->pairs[i].contacts.size(); ++j) {
          const std::uint64_t since = read->pairs[i].contacts[j].contact.since;
          // Step 1 is the first frame of the file.
          REQUIRE(since == report->contacts(report->pairs()[i])[j].since - 1 + first);
          since == first ? ++from_the_first : ++later;
        }
    }
    CHECK(from_the_first > 10);
    CHECK(later > 10);
  }
}

TEST_CASE("a report without times has none, and the rest unchanged") {
  CrumpledSheets sheets(1, 4);
  CHECK(check_round_trip(sheets, 4, false) > 50);
}

TEST_CASE("a locale with a decimal comma and grouped digits changes no report") {
  struct Commas : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\1"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  CrumpledSheets sheets(1, 3);
  const std::size_t contacts = check_round_trip(sheets, 4, true);
  std::locale::global(before);
  CHECK(contacts > 50);
}

TEST_CASE("settings of every accuracy are kept") {
  const TemporaryFolder folder;
  for (const graze::Accuracy& accuracy :
       {graze::Accuracy::exact(), graze::Accuracy::within(0.1), graze::Accuracy::paper({24, 14, 0.1})}) {
    graze::SceneSettings settings;
    settings.range = std::numeric_limits<double>::infinity();
    settings.detail = graze::ContactDetail::regions;
    settings.accuracy = accuracy;
    settings.work_budget = 12;
    settings.time_budget = std::chrono::microseconds(34);
    settings.max_contacts = 56;
    settings.max_contacts_per_pair = 7;
    settings.ways_out = true;
    settings.carrying = 4;
    settings.carrying_band = 0.1;
    ReportWriter(folder / "r.jsonl", {}, settings).close();
    const ReportReader reader(folder / "r.jsonl");
    CHECK(reader.settings().accuracy.mode() == accuracy.mode());
    CHECK(reader.settings().accuracy.tolerance() == accuracy.tolerance());
    CHECK(reader.settings().accuracy.epsilon() == accuracy.epsilon());
    CHECK(reader.settings().range == settings.range);
    CHECK(reader.settings().detail == settings.detail);
    CHECK(reader.settings().work_budget == settings.work_budget);
    CHECK(reader.settings().time_budget == settings.time_budget);
    CHECK(reader.settings().max_contacts == settings.max_contacts);
    CHECK(reader.settings().max_contacts_per_pair == settings.max_contacts_per_pair);
    CHECK(reader.settings().ways_out);
    CHECK(reader.settings().carrying == settings.carrying);
    CHECK(reader.settings().carrying_band == settings.carrying_band);
  }
}

TEST_CASE("a file that is no report is refused by its line") {
  const TemporaryFolder folder;
  const auto error_of = [&](const std::string& text) -> std::string {
    try {
      ReportReader reader(folder.write("r.jsonl", text));
      while (reader.next()) continue;
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using Catch::Matchers::Contains;
  const std::string header =
      R"({"graze":1,"objects":[],"settings":{"contact_distance":0,"range":0,"detail":"none","accuracy":"exact"}})";
  const std::string frame = R"({"frame":0,"complete":true,"pairs":[],"diagnostics":[],"statistics":)";
  CHECK(error_of(header + "\n") == "accepted");
  CHECK_THAT(error_of(""), Contains("is empty"));
  CHECK_THAT(error_of("hello"), Contains("line 1: not valid JSON"));
  CHECK_THAT(error_of(R"({"graze":2})"), Contains("line 1: not version 1"));
  CHECK_THAT(error_of(R"({"graze":1,"objects":[]})"), Contains("line 1: a key is missing"));
  CHECK_THAT(error_of(header + "\n" + frame + "{}}\n"), Contains("line 2: a key is missing"));
  CHECK_THAT(error_of(header + "\n" + frame.substr(0, 20)),
             Contains("line 2: not valid JSON, the file may be cut off"));
  CHECK_THROWS_AS(ReportReader(folder / "none.jsonl"), InputError);
  CHECK_THROWS_AS(ReportWriter(folder / "none" / "r.jsonl", {}, {}), InputError);
}
