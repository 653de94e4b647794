#include "drivers/trace/bids/bids_files.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "drivers/trace/json_file.h"

namespace gazeloop::drivers {
namespace {

namespace fs = std::filesystem;

/// From the data set's folder down to the file's; the file's alone where no data set is found.
std::vector<fs::path> folders_of(const fs::path& file) {
    constexpr std::size_t kMost = 6;  // session, subject, data type and a few to spare
    std::error_code ignored;
    const fs::path own = fs::absolute(file, ignored).parent_path();
    std::vector<fs::path> folders{own};
    while (!fs::exists(folders.back() / "dataset_description.json", ignored)) {
        const fs::path above = folders.back().parent_path();
        if (folders.size() == kMost || above == folders.back()) {
            return {own};
        }
        folders.push_back(above);
    }
    std::ranges::reverse(folders);
    return folders;
}

bool has_all_of(const BidsName& whole, const BidsName& part) {
    return std::ranges::all_of(part.entities, [&](const auto& entity) {
        const auto found = whole.entities.find(entity.first);
        return found != whole.entities.end() && found->second == entity.second;
    });
}

struct Applicable {
    std::size_t entities;
    fs::path file;
    bool operator<(const Applicable& other) const {
        return std::tie(entities, file) < std::tie(other.entities, other.file);
    }
};

}  // namespace

std::optional<BidsName> bids_name(const fs::path& file) {
    const std::string whole = file.filename().string();
    const std::size_t dot = whole.find('.');
    BidsName name{.extension = dot == std::string::npos ? "" : whole.substr(dot)};
    std::string_view rest{whole.data(), std::min(dot, whole.size())};
    while (true) {
        const std::size_t end = rest.find('_');
        const std::string_view part = rest.substr(0, end);
        if (end == std::string_view::npos) {
            name.suffix = part;
            break;
        }
        const std::size_t dash = part.find('-');
        if (dash == 0 || dash == std::string_view::npos || dash + 1 == part.size()) {
            return std::nullopt;
        }
        name.entities.emplace(part.substr(0, dash), part.substr(dash + 1));
        rest.remove_prefix(end + 1);
    }
    return name.suffix.empty() || name.suffix.find('-') != std::string::npos
               ? std::nullopt
               : std::optional{std::move(name)};
}

bool is_bids_physio(const fs::path& file) {
    const std::optional<BidsName> name = bids_name(file);
    return name && name->suffix == "physio" && !name->entities.empty() &&
           (name->extension == ".tsv.gz" || name->extension == ".tsv");
}

Expected<nlohmann::json> inherited_json(const fs::path& file, std::string_view suffix) {
    nlohmann::json all = nlohmann::json::object();
    const std::optional<BidsName> name = bids_name(file);
    if (!name) {
        return all;
    }
    for (const fs::path& folder : folders_of(file)) {
        std::vector<Applicable> applicable;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder, ignored)) {
            const std::optional<BidsName> other = bids_name(entry.path());
            if (other && other->suffix == suffix && other->extension == ".json" &&
                has_all_of(*name, *other)) {
                applicable.push_back({other->entities.size(), entry.path()});
            }
        }
        std::ranges::sort(applicable, std::less{});
        for (const Applicable& one : applicable) {
            auto json = read_json_object(one.file);
            if (!json) {
                return std::unexpected(json.error());
            }
            if (*json) {
                all.update(**json);
            }
        }
    }
    return all;
}

fs::path with_recording(const fs::path& file, std::string_view label, std::string_view suffix) {
    const std::string whole = file.filename().string();
    constexpr std::string_view kEntity = "_recording-";
    std::string changed = whole;
    if (const std::size_t at = changed.find(kEntity); at != std::string::npos) {
        const std::size_t begin = at + kEntity.size();
        changed.replace(begin, changed.find('_', begin) - begin, label);
    }
    const std::size_t dot = changed.find('.');
    const std::size_t last = changed.rfind('_', dot);
    changed.replace(last + 1, dot - last - 1, suffix);
    return file.parent_path() / changed;
}

fs::path packed_or_not(const fs::path& file) {
    constexpr std::string_view kPacked = ".gz";
    std::error_code ignored;
    if (fs::exists(file, ignored)) {
        return file;
    }
    const std::string name = file.string();
    const fs::path other =
        name.ends_with(kPacked) ? name.substr(0, name.size() - kPacked.size()) : name + ".gz";
    return fs::exists(other, ignored) ? other : file;
}

fs::path bids_physio_in(const fs::path& folder) {
    constexpr int kDeepest = 4;  // sub-, ses-, beh and the file
    constexpr int kMost = 10'000;
    std::error_code error;
    fs::path first;
    int seen = 0;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (++seen > kMost) {
            break;
        }
        if (entry.depth() >= kDeepest) {
            entry.disable_recursion_pending();
        }
        if (is_bids_physio(entry->path()) && (first.empty() || entry->path() < first)) {
            first = entry->path();
        }
    }
    return first;
}

}  // namespace gazeloop::drivers
