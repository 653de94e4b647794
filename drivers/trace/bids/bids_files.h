#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::drivers {

/// A file's name as BIDS has it: "sub-01_task-look_recording-eye1_physio.tsv.gz" has the entities
/// sub, task and recording, the suffix "physio" and the extension ".tsv.gz".
struct BidsName {
    std::map<std::string, std::string, std::less<>> entities{};
    std::string suffix{};
    std::string extension{};
};

/// None where the name has none of BIDS' form: an entity without a label, or no suffix.
[[nodiscard]] std::optional<BidsName> bids_name(const std::filesystem::path& file);

/// Whether a file is a table of physiological recordings, to which eye tracking belongs: a physio
/// .tsv or .tsv.gz.
[[nodiscard]] bool is_bids_physio(const std::filesystem::path& file);

/// What the JSON files with `suffix` say of a data file together, by BIDS' rule of inheritance:
/// those in its folder and the folders above it up to the data set's (with
/// dataset_description.json), whose entities the data file has too. Of a key that several have, the
/// one nearest to the file counts. Empty where there is none. Errors (BadInput): no JSON object.
[[nodiscard]] Expected<nlohmann::json> inherited_json(const std::filesystem::path& file,
                                                      std::string_view suffix);

/// The file's name with another label of the entity `recording` and another suffix.
[[nodiscard]] std::filesystem::path with_recording(const std::filesystem::path& file,
                                                   std::string_view label, std::string_view suffix);

/// The file, or where there is none the same with ".gz" behind its name or without it, if that is
/// there.
[[nodiscard]] std::filesystem::path packed_or_not(const std::filesystem::path& file);

/// The first recording by name in a data set, or a part of one; empty where there is none. Looks at
/// 10,000 entries, four folders down.
[[nodiscard]] std::filesystem::path bids_physio_in(const std::filesystem::path& folder);

}  // namespace gazeloop::drivers
