#include "drivers/trace/text/file_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gazeloop::drivers {
namespace {

using namespace std::string_view_literals;

struct Beginning {
    std::string_view bytes;
    std::string_view kind;
};

constexpr std::string_view kUtf16 = "UTF-16 text: save it as UTF-8";
constexpr std::string_view kArchive =
    "a zip archive, as Excel's .xlsx is one: save the table in it as CSV, or unpack it";

/// The longer of two that begin alike stands first.
constexpr std::array kBeginnings{
    Beginning{"\xFF\xFE\0\0"sv, "UTF-32 text: save it as UTF-8"},
    Beginning{"\0\0\xFE\xFF"sv, "UTF-32 text: save it as UTF-8"},
    Beginning{"\xFF\xFE"sv, kUtf16},
    Beginning{"\xFE\xFF"sv, kUtf16},
    Beginning{"PK\x03\x04"sv, kArchive},
    Beginning{"PK\x05\x06"sv, kArchive},
    Beginning{"\xD0\xCF\x11\xE0"sv, "a workbook of an old Excel (.xls): save it as CSV"},
    Beginning{"\xFD"
              "7zXZ"sv,
              "compressed by xz: decompress it with xz -d"},
    Beginning{"\x28\xB5\x2F\xFD"sv, "compressed by zstd: decompress it with zstd -d"},
    Beginning{"BZh"sv, "compressed by bzip2: decompress it with bzip2 -d"},
    Beginning{"7z\xBC\xAF"sv, "a 7z archive: unpack it"},
    Beginning{"\x89HDF"sv, "an HDF5 file: export the table in it as CSV"},
    Beginning{"MATLAB 5.0 MAT-file"sv, "a MATLAB file: export the table in it as CSV"},
    Beginning{"PAR1"sv, "a Parquet file: export it as CSV"},
    Beginning{"ARROW1"sv, "a Feather file: export it as CSV"},
    Beginning{"\x89PNG"sv, "a picture: export the table as CSV"},
    Beginning{"%PDF"sv, "a PDF document: export the table as CSV"},
    Beginning{"SQLite format 3\0"sv, "an SQLite file, perhaps a session: gazeloop replay FILE"},
};

/// Text of mostly ASCII in 16 bits: every other byte is zero.
bool has_zero_beside_each_letter(std::string_view start) {
    constexpr std::size_t kLooked = 16;
    if (start.size() < 4) {
        return false;
    }
    const std::size_t pairs = std::min(start.size(), kLooked) / 2;
    std::size_t low = 0;
    std::size_t high = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
        low += start[2 * i] == '\0' ? 1U : 0U;
        high += start[2 * i + 1] == '\0' ? 1U : 0U;
    }
    return (low == pairs && high == 0) || (high == pairs && low == 0);
}

bool is_tar(std::string_view start) {
    constexpr std::size_t kMagicAt = 257;
    return start.size() > kMagicAt && start.substr(kMagicAt).starts_with("ustar");
}

}  // namespace

std::string_view kind_of_no_table(std::string_view start) {
    for (const Beginning& beginning : kBeginnings) {
        if (start.starts_with(beginning.bytes)) {
            return beginning.kind;
        }
    }
    if (has_zero_beside_each_letter(start)) {
        return kUtf16;
    }
    if (is_tar(start)) {
        return "a tar archive: unpack it, and read the table in it";
    }
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (start.starts_with(kByteOrderMark)) {
        start.remove_prefix(kByteOrderMark.size());
    }
    const std::size_t first = start.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && start[first] == '<') {
        return "an HTML or XML page, not a table: download the file that the page offers";
    }
    if (first != std::string_view::npos && start[first] == '[') {
        const std::size_t second = start.find_first_not_of(" \t\r\n", first + 1);
        if (second != std::string_view::npos &&
            "[{\"0123456789-"sv.find(start[second]) != std::string_view::npos) {
            return "a JSON array: write each of its objects on a line of its own (jq -c '.[]')";
        }
    }
    return {};
}

}  // namespace gazeloop::drivers
