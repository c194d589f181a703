#pragma once

#include <graze/io/scene_file.hpp>
#include <graze/settings_fields.hpp>
#include <tuple>

namespace graze::io {

/// A field of ObjectSettings, and the member of a scene file's entry that says it. The key in the file has
/// the field's name.
template <auto setting, auto described>
struct DescribedField {
  static constexpr auto field = setting;
  static constexpr auto member = described;
};

/// Each field of ObjectSettings but `user_data`, which is for programs.
inline constexpr std::tuple described_fields{
    DescribedField<&ObjectSettings::name, &ObjectDescription::name>{},
    DescribedField<&ObjectSettings::motion, &ObjectDescription::motion>{},
    DescribedField<&ObjectSettings::layer, &ObjectDescription::layer>{},
    DescribedField<&ObjectSettings::collides_with, &ObjectDescription::collides_with>{},
    DescribedField<&ObjectSettings::group, &ObjectDescription::group>{},
    DescribedField<&ObjectSettings::margin, &ObjectDescription::margin>{},
    DescribedField<&ObjectSettings::kind, &ObjectDescription::kind>{},
    DescribedField<&ObjectSettings::solid, &ObjectDescription::solid>{},
    DescribedField<&ObjectSettings::face_groups, &ObjectDescription::face_groups>{},
    DescribedField<&ObjectSettings::hidden_groups, &ObjectDescription::hidden_groups>{},
};
static_assert(std::apply(
                  [](auto... described) {
                    return are_all_fields<ObjectSettings, described.field..., &ObjectSettings::user_data>();
                  },
                  described_fields),
              "name every field of ObjectSettings above, with its key, or as one that files do not have");

}  // namespace graze::io
