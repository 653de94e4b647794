#include "runtime/probe/frame_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

namespace gazeloop::probe {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".png";
constexpr std::string_view kDigits = "0123456789";

/// "frame_0012.png" taken apart.
struct NumberedName {
    std::string prefix;
    std::size_t digits = 0;
    std::uint64_t number = 0;
};

/// None: no number before the suffix, or one beyond 64 bits.
std::optional<NumberedName> numbered(const std::string& name) {
    const std::string stem = name.substr(0, name.size() - kSuffix.size());
    const std::size_t before = stem.find_last_not_of(kDigits);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    NumberedName result{.prefix = stem.substr(0, begin), .digits = stem.size() - begin};
    const char* const end = stem.data() + stem.size();
    const auto [stopped, error] = std::from_chars(stem.data() + begin, end, result.number);
    if (result.digits == 0 || error != std::errc{} || stopped != end) {
        return std::nullopt;
    }
    return result;
}

std::unexpected<Error> refuse(std::string text) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(text)});
}

}  // namespace

std::string FrameFiles::name_of(std::uint64_t number) const {
    return fmt::format("{}{:0{}}{}", prefix_, number, digits_, kSuffix);
}

Expected<FrameFiles> FrameFiles::find(const fs::path& folder) {
    std::error_code failure;
    fs::directory_iterator entries(folder, failure);
    if (failure) {
        return refuse(fmt::format("{}: the frames' folder cannot be read ({})", folder.string(),
                                  failure.message()));
    }
    FrameFiles files;
    files.folder_ = folder;
    std::string some_name;
    std::uint64_t found = 0;
    for (; entries != fs::directory_iterator(); entries.increment(failure)) {
        const std::string name = entries->path().filename().string();
        if (!name.ends_with(kSuffix)) {
            continue;
        }
        const auto one = numbered(name);
        if (!one) {
            return refuse(fmt::format(
                "{}: is not a numbered frame (as 000001.png is); the folder may hold the PNG files "
                "of one video alone",
                entries->path().string()));
        }
        if (found == 0) {
            some_name = name;
            files.prefix_ = one->prefix;
            files.digits_ = one->digits;
            files.first_ = files.last_ = one->number;
        } else if (one->prefix != files.prefix_) {
            return refuse(fmt::format(
                "{}: is of another video than {} beside it; the folder may hold the PNG files of "
                "one video alone",
                entries->path().string(), some_name));
        }
        files.digits_ = std::min(files.digits_, one->digits);
        files.first_ = std::min(files.first_, one->number);
        files.last_ = std::max(files.last_, one->number);
        ++found;
    }
    if (failure) {
        return refuse(fmt::format("{}: the frames' folder cannot be read to its end ({})",
                                  folder.string(), failure.message()));
    }
    if (found == 0) {
        return refuse(fmt::format("{}: has no PNG files: frames are named as 000001.png is",
                                  folder.string()));
    }
    // Only now the shortest number is known, and with it every name.
    for (std::uint64_t number = files.first_;; ++number) {
        if (!fs::is_regular_file(folder / files.name_of(number), failure)) {
            return refuse(fmt::format(
                "{}: is missing between {} and {}, so that times would be wrong: make all frames "
                "again",
                (folder / files.name_of(number)).string(), files.name_of(files.first_),
                files.name_of(files.last_)));
        }
        if (number == files.last_) {
            break;
        }
    }
    if (found != files.count()) {
        return refuse(fmt::format(
            "{}: has {} numbered PNG files for the {} numbers from {} to {}: a number is there "
            "twice",
            folder.string(), found, files.count(), files.first_, files.last_));
    }
    return files;
}

}  // namespace gazeloop::probe
