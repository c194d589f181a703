// `graze_studies bench` as a user runs it: a short run with everything that is built in, and bad arguments.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;  // NOLINT: the vocabulary of these tests

namespace {

/// Returns the entry of a contender in one run of a scene.
const nlohmann::json& contender(const nlohmann::json& run, const std::string& name) {
  const auto& all = run.at("contenders");
  const auto place =
      std::find_if(all.begin(), all.end(), [&](const auto& row) { return row.at("name") == name; });
  REQUIRE(place != all.end());
  return *place;
}

void check_times(const nlohmann::json& row) {
  INFO(row.dump());
  REQUIRE_FALSE(row.contains("wrong"));
  CHECK(row.at("median_ms") > 0.0);
  CHECK(row.at("median_ms") <= row.at("p99_ms"));
  CHECK(row.at("p99_ms") <= row.at("worst_ms"));
  CHECK(row.at("first_ms") > 0.0);
}

/// With one instruction set or another.
bool is_graze(const nlohmann::json& row) {
  return row.at("name").get<std::string>().starts_with("graze");
}

bool is_limit(const nlohmann::json& row) {
  return row.at("name") == "read" || row.at("name") == "box";
}

/// The cells of each line but the first, which is `head`. No cell has a comma.
std::vector<std::vector<std::string>> rows_of(const std::string& csv, const std::string& head) {
  std::istringstream lines(read_file(csv));
  std::string line;
  std::getline(lines, line);
  CHECK(line == head);
  std::vector<std::vector<std::string>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

}  // namespace

TEST_CASE("bench: every contender answers right, and all have times") {
  const TemporaryFolder folder;
  const std::string json = (folder / "figures.json").string();
  const std::string csv = (folder / "figures.csv").string();
  const ProgramResult result = run_studies({"bench", "--scenes", "S1", "--frames", "3", "--threads", "1,2",
                                            "--peers", "all", "--json", json, "--csv", csv});
  INFO(result.out);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());

  const nlohmann::json figures = nlohmann::json::parse(read_file(json));
  REQUIRE(figures.at("runs").size() == 6);  // three tasks with one thread and with two
  std::size_t rows = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const nlohmann::json& run = figures.at("runs")[i];
    CHECK(run.at("objects") == 10);
    CHECK(run.at("vertices") == 5 * (768 + 610));
    CHECK(run.at("frames") == 3);
    CHECK(run.at("frames_verified") == 6);  // those before the first that is timed, too
    CHECK(contender(run, "graze").at("found") > 0);
    for (const nlohmann::json& row : run.at("contenders")) {
      check_times(row);
      if (is_limit(row)) CHECK(row.at("found") == 0);
      // Graze finds features, the others triangles.
      else if (run.at("task") != "B" || is_graze(row))
        CHECK(row.at("found") == contender(run, "graze").at("found"));
      else
        CHECK(row.at("found") == contender(run, "clipping").at("found"));
      ++rows;
    }
    if (run.at("task") == "B" && run.at("threads") == 1)
      check_times(contender(run, "graze's kernels, clipping's candidates"));
    // The run on two threads comes right after the run on one, and must give the same bits.
    if (i % 2 == 1) CHECK(run.at("hash") == figures.at("runs")[i - 1].at("hash"));
  }
  const std::string lines = read_file(csv);
  CHECK(static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')) == rows + 1);

  std::set<std::string> aims;
  for (const nlohmann::json& aim : figures.at("aims")) {
    aims.insert(aim.at("what").get<std::string>());
    const double measured = aim.at("measured");
    const double wanted = aim.at("wanted");
    CHECK(aim.at("is_reached") == (aim.at("is_at_least") == true ? measured >= wanted : measured <= wanted));
  }
  for (const char* what : {"A: worst / median", "B: ns a near pair", "memory, bytes a vertex"})
    CHECK(aims.count(what) == 1);
}

TEST_CASE("bench: caches are evicted") {
  const TemporaryFolder folder;
  const std::string json = (folder / "figures.json").string();
  const ProgramResult result = run_studies({"bench", "--scenes", "S6c", "--tasks", "A", "--frames", "1",
                                            "--peers", "clipping", "--evict", "--json", json});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const nlohmann::json figures = nlohmann::json::parse(read_file(json));
  const nlohmann::json& run = figures.at("runs").at(0);
  CHECK(run.at("evict") == true);
  CHECK(run.at("vertices") == 200 * 200 + 125 * 80 + 2);
  CHECK(contender(run, "clipping").at("found") == contender(run, "graze").at("found"));
  CHECK(std::count_if(run.at("contenders").begin(), run.at("contenders").end(),
                      [](const auto& row) { return !is_graze(row); }) == 3);
}

TEST_CASE("bench: scenes are played in slow motion, through the same places") {
  const TemporaryFolder folder;
  const auto found_at = [&](const char* slow, const char* frames) {
    const std::string json = (folder / "figures.json").string();
    const ProgramResult result = run_studies({"bench", "--scenes", "S1", "--tasks", "A", "--frames", frames,
                                              "--peers", "clipping", "--slow", slow, "--json", json});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const nlohmann::json figures = nlohmann::json::parse(read_file(json));
    const nlohmann::json& run = figures.at("runs").at(0);
    CHECK(std::to_string(run.at("slow").get<int>()) == slow);
    CHECK(contender(run, "clipping").at("found") == contender(run, "graze").at("found"));
    return contender(run, "graze").at("found").get<int>();
  };
  // The last frame is the third after 3 that are not timed, 4 times slower the same place.
  CHECK(found_at("1", "4") == found_at("4", "22"));
}

TEST_CASE("bench: graze takes part with each instruction set asked for") {
  const TemporaryFolder folder;
  const std::string json = (folder / "figures.json").string();
  const ProgramResult result =
      run_studies({"bench", "--scenes", "S1", "--tasks", "B", "--frames", "2", "--peers", "none",
                   "--instruction-set", "baseline,scalar", "--json", json});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const nlohmann::json figures = nlohmann::json::parse(read_file(json));
  CHECK(figures.at("instruction_sets") == "baseline, scalar");
  const nlohmann::json& run = figures.at("runs").at(0);
  REQUIRE(run.at("contenders").size() == 4);
  for (const char* const name : {"graze", "graze, scalar"}) check_times(contender(run, name));
  CHECK(contender(run, "graze, scalar").at("found") == contender(run, "graze").at("found"));
}

TEST_CASE("bench: steps scale as a model and the machine's threads say") {
  const TemporaryFolder folder;
  const std::string csv = (folder / "scaling.csv").string();
  const std::string json = (folder / "scaling.json").string();
  const ProgramResult result =
      run_studies({"bench", "--scaling", "--scenes", "S1,S4", "--tasks", "B,D", "--threads", "1,2",
                   "--frames", "4", "--csv", csv, "--json", json});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const nlohmann::json figures = nlohmann::json::parse(read_file(json));
  REQUIRE(figures.size() == 4);
  for (const nlohmann::json& one : figures) {
    CAPTURE(one.dump());
    REQUIRE(one.at("model").size() == 6);
    // More processors never make a step of the model slower, but for what it costs to wake them.
    CHECK(one.at("model").back().at("wall_ms") < 1.2 * one.at("model").front().at("wall_ms").get<double>());
    REQUIRE(one.at("stages").size() == 5);
    double tasks = 0;
    for (const nlohmann::json& stage : one.at("stages")) {
      CHECK(stage.at("longest_ms") <= stage.at("tasks_ms").get<double>() * 1.5 + 0.1);
      tasks += stage.at("tasks_ms").get<double>();
    }
    CHECK(tasks > 0);
    REQUIRE(one.at("measured").size() == 2);
    for (const nlohmann::json& measured : one.at("measured")) {
      CHECK(measured.at("hash") == one.at("one").at("hash"));
      for (const char* const name : {"wall_ms", "cpu_ms", "first_ms", "thread_mb"})
        CHECK(measured.at(name) > 0);
    }
  }
  CHECK(read_file(csv).starts_with("scene,task,one_ms,serial_ms,rounds,longest_ms,model_2,model_4,model_8,"));
}

TEST_CASE("bench: rays of graze hit, and so do Embree's where that was built in") {
  const TemporaryFolder folder;
  const std::string csv = (folder / "rays.csv").string();
  const ProgramResult result = run_studies(
      {"bench", "--rays", "--scenes", "S1,S2", "--threads", "1,2", "--frames", "2", "--csv", csv});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const auto rows = rows_of(csv, "scene,threads,library,update_ms,ray_ns,hit,missed,mistaken,worst");
  const std::size_t libraries = rows.size() / 4;
  CHECK((libraries == 1 || libraries == 3));
  REQUIRE(rows.size() == 4 * libraries);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<std::string>& row = rows[i];
    CAPTURE(row);
    CHECK((row[2] == "graze") == (i % libraries == 0));
    const double hit = std::stod(row[5]);
    const double missed = std::stod(row[6]);
    const double mistaken = std::stod(row[7]);
    CHECK(std::stod(row[4]) > 0);
    CHECK(hit > 5'000);  // of 20,000
    CHECK(missed + mistaken <= (row[2] == "graze" ? 0 : hit / 100));
    CHECK(std::stod(row[8]) < 1e-3);
    CHECK(row[5] == rows[i % (2 * libraries) < libraries ? i + libraries : i - libraries][5]);
  }
}

TEST_CASE("bench: a cloth that folds is near itself, by graze and where that was built in by Bullet") {
  const TemporaryFolder folder;
  const std::string csv = (folder / "self.csv").string();
  const ProgramResult result = run_studies({"bench", "--self", "--frames", "110", "--csv", csv});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const auto rows = rows_of(csv, "contacts_from,find_ms,slowest_ms,contacts,vertices,most_contacts");
  REQUIRE((rows.size() == 2 || rows.size() == 3));
  for (const std::vector<std::string>& row : rows) {
    CAPTURE(row);
    CHECK(std::stod(row[1]) > 0);
    CHECK(std::stod(row[1]) <= std::stod(row[2]));
    CHECK(std::stod(row[5]) > 50);
    CHECK(std::stod(row[3]) <= std::stod(row[5]));
    CHECK(std::stod(row[4]) <= 1'600);
  }
}

TEST_CASE("bench: soft bodies move under contacts of graze, and of Bullet where that was built in") {
  const TemporaryFolder folder;
  const std::string csv = (folder / "soft_bodies.csv").string();
  const ProgramResult result = run_studies({"bench", "--soft-bodies", "--frames", "12", "--csv", csv});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const std::string lines = read_file(csv);
  INFO(lines);
  CHECK(lines.starts_with("scene,looks,contacts_from,through,most_through,contacts,look_ms,frame_ms\n"));
  const bool has_bullet = result.out.find("No rows of Bullet") == std::string::npos;
  CHECK(std::count(lines.begin(), lines.end(), '\n') == 1 + 6 * (has_bullet ? 3 : 1));
  const std::string bullet = "two soft balls inside each other,5,\"Bullet, margin 10 mm\",";
  const std::size_t row = lines.find(bullet);
  REQUIRE((row != std::string::npos) == has_bullet);
  if (has_bullet) {
    std::istringstream numbers(lines.substr(row + bullet.size()));
    double through = 0, most = 0, contacts = 0;
    char comma = 0;
    numbers >> through >> comma >> most >> comma >> contacts;
    CHECK(most >= through);
    CHECK(contacts > 0);
  }
  CHECK(lines.find("two soft balls inside each other,5,graze,") != std::string::npos);
}

TEST_CASE(
    "bench: rigid bodies move under contacts of graze, of clipped faces, and of Bullet where it is there") {
  const TemporaryFolder folder;
  const std::string csv = (folder / "rigid_bodies.csv").string();
  const ProgramResult result = run_studies({"bench", "--rigid-bodies", "--quick", "--csv", csv});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const std::string lines = read_file(csv);
  INFO(lines);
  CHECK(lines.starts_with("scene,contacts_from,standing,height_error_mm,through,"));
  const bool has_bullet = result.out.find("No rows of Bullet") == std::string::npos;
  CHECK(std::count(lines.begin(), lines.end(), '\n') == 1 + 9 * (has_bullet ? 5 : 3));
  for (const std::string placed : {"one outline", "shifted", "turned by 2.7°", "turned by 45°", "at random"})
    for (const char* const source : {"graze", "clipped faces", "Bullet's boxes"}) {
      if (source[0] == 'B' && !has_bullet) continue;
      const std::string row = "\"three crates, " + placed + "\"," + source + ",";
      INFO(row);
      const std::size_t at = lines.find(row);
      REQUIRE(at != std::string::npos);
      std::istringstream numbers(lines.substr(at + row.size()));
      double standing = 0, error = 0, through = 0;
      char comma = 0;
      numbers >> standing >> comma >> error >> comma >> through;
      CHECK(standing == 3);
      CHECK(error < 2);
      CHECK(through == 0);
    }
}

TEST_CASE("bench: bad arguments are one line") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"bench", "--scenes", "S11"},
        {"bench", "--tasks", "C"},
        {"bench", "--scenes", "S1", "--peers", "nobody"},
        {"bench", "--instruction-set", "abacus"},
        {"bench", "--quick"},
        {"bench", "--scenes", "S1", "--json", "/no/such/folder/file.json"}}) {
    const ProgramResult result = run_studies(arguments);
    INFO(result.err);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
  }
}
