#include "drivers/trace/read_trace.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "drivers/trace/axes_correction.h"
#include "drivers/trace/htc_vive_pro.h"
#include "drivers/trace/native_trace.h"
#include "drivers/trace/text/csv_table.h"
#include "drivers/trace/trace_format.h"
#include "runtime/gaze/new_origins.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kAuto = "auto";

std::vector<const TraceFormat*> formats() { return {&native_trace(), &htc_vive_pro()}; }

std::string known_names() {
    std::vector<std::string_view> names;
    for (const TraceFormat* format : formats()) {
        names.push_back(format->name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

/// "'a', 'b' and 12 more"
std::string listed(const std::vector<std::string_view>& names) {
    constexpr std::size_t kMost = 8;
    const std::size_t shown = std::min(names.size(), kMost);
    std::string text;
    for (std::size_t i = 0; i < shown; ++i) {
        text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
    }
    if (names.size() > shown) {
        text += fmt::format(" and {} more", names.size() - shown);
    }
    return text;
}

/// What the table lacks of what a format needs: of alternatives, those of the nearest.
struct Lack {
    std::vector<std::string_view> columns;
    std::size_t needed = 0;

    [[nodiscard]] double share() const {
        return static_cast<double>(columns.size()) / static_cast<double>(needed);
    }
};

Lack lacking(const CsvTable& table, const TraceFormat& format) {
    Lack lack;
    for (const std::span<const ColumnNames> alternatives : format.needed) {
        std::vector<std::string_view> least;
        std::size_t needed = 0;
        for (const ColumnNames columns : alternatives) {
            std::vector<std::string_view> missing = table.missing(columns);
            if (needed == 0 || missing.size() < least.size()) {
                least = std::move(missing);
                needed = columns.size();
            }
        }
        lack.needed += needed;
        lack.columns.insert(lack.columns.end(), least.begin(), least.end());
    }
    return lack;
}

Error unknown_header(const CsvTable& table, const std::vector<const TraceFormat*>& candidates) {
    const TraceFormat* const nearest = *std::min_element(
        candidates.begin(), candidates.end(), [&](const TraceFormat* a, const TraceFormat* b) {
            return lacking(table, *a).share() < lacking(table, *b).share();
        });
    std::string message = fmt::format("{}:{}: unknown header; known formats: {}", table.name(),
                                      table.header_line(), known_names());
    const Lack lack = lacking(table, *nearest);
    if (candidates.size() == 1 || lack.share() < 1.0) {
        message += fmt::format("; for {} it lacks {}", nearest->name, listed(lack.columns));
    }
    if (table.header_line() > 1) {
        message += "; the lines before it are blank, comments or 'sep='";
    }
    return {ErrorKind::BadInput, message};
}

}  // namespace

Expected<gaze::GazeTrace> read_trace(std::istream& in, const std::string& name,
                                     const ReadOptions& options) {
    std::vector<const TraceFormat*> candidates = formats();
    if (options.format != kAuto) {
        std::erase_if(candidates, [&](const TraceFormat* f) { return f->name != options.format; });
        if (candidates.empty()) {
            return std::unexpected(
                Error{ErrorKind::Usage, fmt::format("unknown trace format '{}'; known: {}, {}",
                                                    options.format, kAuto, known_names())});
        }
    }
    Expected<CsvTable> table = CsvTable::open(in, name);
    if (!table) {
        return std::unexpected(table.error());
    }
    const auto fitting =
        std::find_if(candidates.begin(), candidates.end(),
                     [&](const TraceFormat* f) { return lacking(*table, *f).columns.empty(); });
    if (fitting == candidates.end()) {
        return std::unexpected(unknown_header(*table, candidates));
    }
    Expected<gaze::GazeTrace> trace = (*fitting)->read(*table, options);
    if (trace) {
        if (auto held = hold_against_anatomy(*trace, options.axes); !held) {
            return std::unexpected(std::move(held.error()));
        }
        gaze::report_new_origins(trace->samples, trace->report);
    }
    return trace;
}

Expected<gaze::GazeTrace> read_trace(const std::string& file, const ReadOptions& options) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: a directory, not a trace", file)});
    }
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: cannot be opened: {}", file, std::generic_category().message(errno))});
    }
    Expected<gaze::GazeTrace> trace = read_trace(in, file, options);
    if (trace && trace->format == native_trace().name) {
        Expected<std::string> device = read_native_sidecar(file);
        if (!device) {
            return std::unexpected(device.error());
        }
        if (!device->empty()) {
            trace->device = *device;
        }
    }
    return trace;
}

}  // namespace gazeloop::drivers
