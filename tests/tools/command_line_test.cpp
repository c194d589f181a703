// `graze` refuses command lines that cannot be meant: numbers out of their range, misspelt words, files that
// cannot be written. Also the limits of contacts and of threads.

#include <algorithm>
#include <filesystem>
#include <graze/enumerators.hpp>
#include <graze/io/report_json.hpp>
#include <graze/settings_fields.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/bad_calls.hpp"
#include "tools/program.hpp"
#include "tools/program_report.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

using Catch::Matchers::Contains;
using Words = std::vector<std::string>;

void check_graze_refuses(const std::vector<BadCall>& calls) {
  check_refused(run_graze, "graze", calls);
}

/// A spike that stands on a sheet of 4 by 4 quads, and another one beside it: 2 pairs in contact.
struct SpikesOnSheet {
  TemporaryFolder folder;
  std::string sheet_file, scene;

  SpikesOnSheet() {
    sheet_file = folder.write("sheet.obj", obj_text(sheet(4, 0.25, {0, 0, 0}))).string();
    folder.write("spike.obj", obj_text(spike({0, 0, 0}, 0.5)));
    scene = folder
                .write("scene.json", R"({"graze": 1, "contact_distance": 0.3, "objects": [
      {"name": "sheet", "mesh": "sheet.obj", "motion": "fixed"},
      {"name": "left", "mesh": "spike.obj", "transform": {"translate": [0.25, 0.5, 0.125]}, "group": 1},
      {"name": "right", "mesh": "spike.obj", "transform": {"translate": [0.85, 0.6, 0.2]}, "group": 1}]})")
                .string();
  }
  [[nodiscard]] std::string in(const std::string& name) const { return (folder / name).string(); }
};

}  // namespace

TEST_CASE("numbers out of their range are refused with the range") {
  const SpikesOnSheet files;
  const auto run = [&](const char* option, const char* value) {
    return Words{"run", files.scene, option, value};
  };
  const std::string from_1 = "expected a whole number of at least 1, got ";
  const std::string from_0 = "expected a whole number of at least 0, got ";
  check_graze_refuses({
      {run("--frames", "0"), "--frames: " + from_1 + "\"0\""},
      {run("--frames", "-3"), "--frames: " + from_1 + "\"-3\""},
      {run("--frames", "2.5"), "--frames: " + from_1 + "\"2.5\""},
      {run("--frames", "ten"), "--frames: " + from_1 + "\"ten\""},
      {run("--frames", "5000000000"),
       "--frames: expected a whole number of at most 4294967295, got \"5000000000\""},
      {run("--threads", "-1"), "--threads: " + from_0 + "\"-1\""},
      {run("--threads", "many"), "--threads: " + from_0 + "\"many\""},
      {run("--threads", "99999999999999999999"), "--threads: " + from_0 + "\"99999999999999999999\""},
      {run("--contact-distance", "-1"),
       "--contact-distance: expected a number that is not negative, got \"-1\""},
      {run("--contact-distance", "inf"),
       "--contact-distance: expected a number that is not negative, got \"inf\""},
      {run("--contact-distance", "1cm"),
       "--contact-distance: expected a number that is not negative, got \"1cm\""},
      {run("--range", "nan"), "--range: expected a number that is not negative, or inf, got \"nan\""},
      {run("--frames-per-second", "0"), "--frames-per-second: expected a number above 0, got \"0\""},
      {run("--frames-per-second", "inf"), "--frames-per-second: expected a number above 0, got \"inf\""},
      {run("--max-contacts", "0"), "--max-contacts: " + from_1 + "\"0\""},
      {run("--max-contacts-per-pair", "0"), "--max-contacts-per-pair: " + from_1 + "\"0\""},
      {run("--carrying", "-1"), "--carrying: " + from_0 + "\"-1\""},
      {run("--carrying-band", "-0.1"),
       "--carrying-band: expected a number that is not negative, got \"-0.1\""},
      {run("--carrying-band", "inf"), "--carrying-band: expected a number that is not negative, got \"inf\""},
      {run("--picture-frame", "-1"), "--picture-frame: " + from_0 + "\"-1\""},
  });
}

TEST_CASE("misspelt commands and options are told the nearest ones") {
  const SpikesOnSheet files;
  const std::string commands = " the commands are run, inspect";
  check_graze_refuses({
      {{}, "expected a command; the commands are run, inspect"},
      {{"rnu", files.scene}, "there is no command \"rnu\"; did you mean run?" + commands},
      {{"inspcet"}, "there is no command \"inspcet\"; did you mean inspect?" + commands},
      {{"fly"}, "there is no command \"fly\";" + commands},
      {{"run", files.scene, "--frame", "3"},
       "graze run has no option --frame; did you mean --frames? graze run --help lists them"},
      {{"run", files.scene, "--treads=2"}, "graze run has no option --treads; did you mean --threads?"},
      {{"run", files.scene, "--contact-distnace", "1"},
       "graze run has no option --contact-distnace; did you mean --contact-distance?"},
      {{"run", "--pic", "x.png"}, "graze run has no option --pic; did you mean --picture?"},
      {{"run", files.scene, "--quack"}, "graze run has no option --quack; graze run --help lists them"},
      {{"info", "a.graze", "b.graze"}, "\"b.graze\" is one argument too many; graze info --help says"},
      {{"--versoin"}, "graze has no option --versoin; did you mean --version? graze --help lists them"},
  });
}

TEST_CASE("command line: commands that measure graze have moved to graze_studies") {
  check_graze_refuses({
      {{"stress", "--soak"}, "stress has moved to another program: run graze_studies stress\n"},
      {{"bench"}, "bench has moved to another program: run graze_studies bench\n"},
      {{"accuracy"}, "accuracy has moved to another program: run graze_studies accuracy\n"},
      {{"experiment", "all"}, "experiment has moved to another program: run graze_studies experiment\n"},
  });
}

TEST_CASE("files that cannot be written are refused before anything is read") {
  const SpikesOnSheet files;
  const std::string folder = files.folder.path().string();
  const std::string none = files.in("none");
  // The scene is not there, and nothing is said of it: the outputs come first.
  const auto report = [&](const std::string& file) { return Words{"run", "no.json", "--report", file}; };
  const auto picture = [&](const std::string& file) { return Words{"run", "no.json", "--picture", file}; };
  check_graze_refuses({
      {report(none + "/r.jsonl"), "--report: " + none + "/r.jsonl cannot be written: there is no folder " +
                                      none + "; make it, or name a file in another one"},
      {report(folder), "--report: " + folder + " cannot be written: it is a folder; name a file in it"},
      {report("/proc/r.jsonl"), "--report: /proc/r.jsonl cannot be written: "},
      {report(""), "--report: expected the name of a file, got nothing"},
      {picture(none + "/p.png"),
       "--picture: " + none + "/p.png cannot be written: there is no folder " + none},
      {picture(files.in("p.jpg")), "--picture: " + files.in("p.jpg") +
                                       " cannot be written: pictures of the format .jpg are not made here; "
                                       "end it in .png"},
      {picture(files.in("p")),
       "--picture: " + files.in("p") + " cannot be written: it has no ending; end it in .png"},
      {{"run", files.scene, "--report", files.scene},
       "--report: " + files.scene + " cannot be written: it is what the run reads"},
  });
  CHECK_FALSE(std::filesystem::exists(files.in("p.jpg")));
  CHECK(read_file(files.scene).starts_with("{\"graze\": 1"));
}

TEST_CASE("a file that is there is written over, and one whose run fails is left as it was") {
  const SpikesOnSheet files;
  const auto report = files.folder.write("report.jsonl", "mine");
  CHECK(run_graze({"run", "no.json", "--report", report.string()}).exit_code == 2);
  CHECK(read_file(report) == "mine");
  CHECK(run_graze({"run", files.in("no.json"), "--report", files.in("new.jsonl")}).exit_code == 2);
  CHECK_FALSE(std::filesystem::exists(files.in("new.jsonl")));
  CHECK(run_graze({"run", files.scene, "--report", report.string(), "--picture", files.in("P.PNG")})
            .exit_code == 0);
  CHECK(read_report(report).size() == 1);
  CHECK(read_file(files.in("P.PNG")).substr(1, 3) == "PNG");
}

TEST_CASE("more threads than 8 for each processor are a warning, and change nothing") {
  const SpikesOnSheet files;
  const auto run = [&](const char* threads, const char* name) {
    return run_graze({"run", files.scene, "--threads", threads, "--no-times", "--report", files.in(name)});
  };
  const ProgramResult one = run("1", "one.jsonl");
  CHECK(one.err.empty());
  for (const char* const threads : {"5000", "100000", "4294967295"}) {
    const ProgramResult many = run(threads, "many.jsonl");
    CHECK(many.exit_code == 0);
    CHECK(many.err == "warning: " + std::string(threads) + " threads are more than 8 for each processor; " +
                          std::to_string(max_threads()) + " are used\n");
    CHECK(read_file(files.in("many.jsonl")) == read_file(files.in("one.jsonl")));
  }
  CHECK(run(std::to_string(max_threads()).c_str(), "most.jsonl").err.empty());
}

TEST_CASE("limits of contacts from the command line keep the nearest") {
  const SpikesOnSheet files;
  const auto contacts_with = [&](const Words& limits) {
    Words arguments = {"run", files.scene, "--detail", "vertices", "--report", files.in("r.jsonl")};
    arguments.insert(arguments.end(), limits.begin(), limits.end());
    const ProgramResult result = run_graze(arguments);
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    CHECK((result.out.find("limits    left out at least ") != std::string::npos) == !limits.empty());
    const auto frames = read_report(files.in("r.jsonl"));
    REQUIRE(frames.size() == 1);
    std::vector<std::vector<double>> distances;
    for (const auto& pair : frames[0].pairs) {
      distances.emplace_back();
      for (const auto& contact : pair.contacts) distances.back().push_back(contact.contact.distance);
      std::ranges::sort(distances.back());
    }
    return distances;
  };
  const auto all = contacts_with({});
  REQUIRE(all.size() == 2);
  REQUIRE((all[0].size() > 2 && all[1].size() > 2));

  const auto two_each = contacts_with({"--max-contacts-per-pair", "2"});
  CHECK(two_each[0] == std::vector(all[0].begin(), all[0].begin() + 2));
  CHECK(two_each[1] == std::vector(all[1].begin(), all[1].begin() + 2));

  std::vector<double> nearest = all[0];
  nearest.insert(nearest.end(), all[1].begin(), all[1].end());
  std::ranges::sort(nearest);
  nearest.resize(3);
  const auto three = contacts_with({"--max-contacts", "3"});
  std::vector<double> found = three[0];
  found.insert(found.end(), three[1].begin(), three[1].end());
  std::ranges::sort(found);
  CHECK(found == nearest);
}

TEST_CASE("command line: ways out and contacts that carry are settings of a run, over those of the scene") {
  const SpikesOnSheet files;
  const auto settings_with = [&](const Words& options) {
    Words arguments = {"run", files.scene, "--detail", "nearest", "--report", files.in("r.jsonl")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    CHECK(run_graze(arguments).exit_code == 0);
    return io::ReportReader(files.in("r.jsonl")).settings();
  };
  const SceneSettings off = settings_with({});
  CHECK((!off.ways_out && off.carrying == 0 && !off.carrying_band));
  const SceneSettings on = settings_with({"--ways-out", "--carrying", "4", "--carrying-band", "0.25"});
  CHECK((on.ways_out && on.carrying == 4 && on.carrying_band == 0.25));
}

TEST_CASE("command line: help lists every detail and every setting of a run, and each detail is taken") {
  const std::string help = run_graze({"run", "--help"}).out;
  CHECK_THAT(help, Contains(listed_names<ContactDetail>()));
  for_each_field<SceneSettings, &SceneSettings::arena, &SceneSettings::time_budget,
                 &SceneSettings::work_budget>([&](const auto& field) {
    std::string option = "--" + std::string(field.name);
    std::ranges::replace(option, '_', '-');
    CHECK_THAT(help, Contains(option + " "));
  });
  const SpikesOnSheet files;
  for (const ContactDetail detail : enumerators<ContactDetail>)
    CHECK(run_graze({"run", files.scene, "--detail", std::string(name_of(detail))}).exit_code == 0);
}

}  // namespace graze::tests
