// Texts that name the details, the settings of a scene file or the options of `graze run` name all of them.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <graze/settings_fields.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string_view>;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The pages, and the sources that users read or whose words they see.
std::vector<fs::path> files_with_texts() {
  const fs::path root = GRAZE_SOURCE;
  std::vector<fs::path> files = {root / "README.md"};
  for (const char* const folder :
       {"docs", "core/include", "scheduler/include", "io/include", "io/src", "tools", "tests/contract"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".md" || extension == ".hpp" || extension == ".cpp") files.push_back(entry.path());
    }
  return files;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Goes through the words of a text and gathers names of details between which nothing stands but commas,
/// bars, quotes, comment signs and the words "and" and "or".
class Runs {
 public:
  explicit Runs(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      if (!is_letter(text[at])) {
        if (std::string_view(" ,|`\"/\n").find(text[at]) == std::string_view::npos) end();
        ++at;
        continue;
      }
      const std::size_t begin = at;
      while (at < text.size() && is_letter(text[at])) ++at;
      add(std::string_view(text).substr(begin, at - begin));
    }
    end();
  }
  [[nodiscard]] const std::vector<Names>& all() const { return runs_; }

 private:
  void add(std::string_view word) {
    if (word == "and" || word == "or") return;
    if (const auto detail = enumerator_named<ContactDetail>(word))
      run_.insert(name_of(*detail));
    else
      end();
  }
  void end() {
    if (!run_.empty()) runs_.push_back(run_);
    run_.clear();
  }

  Names run_;
  std::vector<Names> runs_;
};

template <typename Details>
Names names_of(const Details& details, bool with_none) {
  Names names;
  for (const ContactDetail detail : details)
    if (with_none || detail != ContactDetail::none) names.insert(name_of(detail));
  return names;
}

/// Whether these names are meant as a list of something, and are not all of it: of the details, or of those
/// about surfaces, each with `none` or without.
bool has_forgotten(const Names& names) {
  constexpr std::size_t few = 3;
  if (names.size() < few || (names.size() == few && !names.contains("none"))) return false;
  const auto is = [&](const Names& whole) { return names == whole; };
  return !is(names_of(all_details, true)) && !is(names_of(all_details, false)) &&
         !is(names_of(surface_details, true)) && !is(names_of(surface_details, false));
}

/// Whether a row of a table of the page is about this key or option: the row's first cell has it.
bool has_row(const std::string& page, const std::string& name) {
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t found = line.find("`" + name);
    if (line.starts_with("| `") && found < line.find('|', 1) && !is_letter(line[found + 1 + name.size()]))
      return true;
  }
  return false;
}

std::string dashed(std::string_view name) {
  std::string option(name);
  std::ranges::replace(option, '_', '-');
  return option;
}

}  // namespace

TEST_CASE("texts: a list of details that lacks one is found") {
  const auto forgotten = [](const std::string& text) {
    const Runs runs(text);
    return std::ranges::count_if(runs.all(), has_forgotten);
  };
  CHECK(forgotten("write none, closest, regions, vertices or features") == 1);
  CHECK(forgotten("(details `none`, `closest` and\n  `features`);") == 1);
  CHECK(forgotten("| `closest` | `regions` | `vertices` | `features` |") == 1);
  CHECK(forgotten(listed_names<ContactDetail>()) == 0);
  CHECK(forgotten("`none`, `closest`, `features` and `nearest`") == 0);
  CHECK(forgotten("take `features`, or `nearest`. `none` lists nothing.") == 0);
}

TEST_CASE("texts: lists of details have every detail") {
  std::size_t lists = 0;
  for (const fs::path& file : files_with_texts()) {
    const Runs runs(text_of(file));
    for (const Names& names : runs.all()) {
      std::string list;
      for (const std::string_view name : names) list += " " + std::string(name);
      INFO(file.string() << ":" << list);
      CHECK_FALSE(has_forgotten(names));
      lists += names.size() >= surface_details.size() ? 1U : 0U;
    }
  }
  CHECK(lists > 8);
}

TEST_CASE("texts: the page of formats has each key of scene files and each option of a run") {
  const std::string page = text_of(fs::path(GRAZE_SOURCE) / "docs" / "formats.md");
  for_each_field<SceneSettings, &SceneSettings::threads, &SceneSettings::arena, &SceneSettings::time_budget,
                 &SceneSettings::work_budget, &SceneSettings::region_distances>([&](const auto& field) {
    INFO(field.name);
    CHECK(has_row(page, std::string(field.name)));
  });
  for_each_field<ObjectSettings, &ObjectSettings::user_data>([&](const auto& field) {
    INFO(field.name);
    CHECK(has_row(page, std::string(field.name)));
  });
  for_each_field<SceneSettings, &SceneSettings::arena, &SceneSettings::time_budget,
                 &SceneSettings::work_budget>([&](const auto& field) {
    INFO(field.name);
    CHECK(has_row(page, "--" + dashed(field.name)));
  });
}

// A struct that has a field more than its list, wherever it stands and of whatever type.
namespace forgotten {

struct Listed {
  int first = 0;
  std::string second = {};
  std::optional<std::size_t> third = {};
};
constexpr std::tuple listed{SettingsField<&Listed::first>{"first"}, SettingsField<&Listed::second>{"second"},
                            SettingsField<&Listed::third>{"third"}};
constexpr std::tuple twice{SettingsField<&Listed::first>{"first"}, SettingsField<&Listed::second>{"second"},
                           SettingsField<&Listed::second>{"second"}};
static_assert(has_every_member<Listed>(listed));
static_assert(!has_every_member<Listed>(twice));

struct AtTheEnd {
  int first = 0;
  bool last = false;
};
struct AtTheBegin {
  std::vector<double> begin = {};
  int first = 0;
};
class Locked {  // no value of another type becomes one
 public:
  Locked() = default;
  template <typename Other>
  Locked(Other) = delete;
};
struct Strange {
  int first = 0;
  Locked last;
};
static_assert(!has_every_member<AtTheEnd>(std::tuple{SettingsField<&AtTheEnd::first>{"first"}}));
static_assert(!has_every_member<AtTheBegin>(std::tuple{SettingsField<&AtTheBegin::first>{"first"}}));
static_assert(!has_every_member<Strange>(std::tuple{SettingsField<&Strange::first>{"first"}}));

}  // namespace forgotten

TEST_CASE("texts: each part that leaves a setting out must name it") {
  static_assert(
      are_all_fields<PairRule, &PairRule::range, &PairRule::epsilon, &PairRule::contact_distance>());
  static_assert(!are_all_fields<PairRule, &PairRule::range, &PairRule::epsilon>());
  static_assert(!are_all_fields<PairRule, &PairRule::range, &PairRule::range, &PairRule::epsilon>());
  CHECK(field_name<ObjectSettings, &ObjectSettings::kind>() == "kind");
  std::size_t fields = 0;
  for_each_field<SceneCapacity, &SceneCapacity::reports>([&](const auto&) { ++fields; });
  CHECK(fields == 5);
}

}  // namespace graze::tests
