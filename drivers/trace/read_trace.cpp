#include "drivers/trace/read_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "drivers/trace/csv_table.h"
#include "drivers/trace/htc_vive_pro.h"
#include "drivers/trace/native_trace.h"
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

Error unknown_header(const CsvTable& table, const std::vector<const TraceFormat*>& candidates) {
    const auto share_missing = [&](const TraceFormat* format) {
        return static_cast<double>(table.missing(format->columns).size()) /
               static_cast<double>(format->columns.size());
    };
    const TraceFormat* const nearest = *std::min_element(
        candidates.begin(), candidates.end(), [&](const TraceFormat* a, const TraceFormat* b) {
            return share_missing(a) < share_missing(b);
        });
    std::string message =
        fmt::format("{}:1: unknown header; known formats: {}", table.name(), known_names());
    if (candidates.size() == 1 || share_missing(nearest) < 1.0) {
        message += fmt::format("; for {} it lacks {}", nearest->name,
                               listed(table.missing(nearest->columns)));
    }
    return {ErrorKind::BadInput, message};
}

}  // namespace

Expected<gaze::GazeTrace> read_trace(std::istream& in, const std::string& name,
                                     std::string_view format) {
    std::vector<const TraceFormat*> candidates = formats();
    if (format != kAuto) {
        std::erase_if(candidates, [&](const TraceFormat* f) { return f->name != format; });
        if (candidates.empty()) {
            return std::unexpected(
                Error{ErrorKind::Usage, fmt::format("unknown trace format '{}'; known: {}, {}",
                                                    format, kAuto, known_names())});
        }
    }
    Expected<CsvTable> table = CsvTable::open(in, name);
    if (!table) {
        return std::unexpected(table.error());
    }
    const auto fitting =
        std::find_if(candidates.begin(), candidates.end(),
                     [&](const TraceFormat* f) { return table->missing(f->columns).empty(); });
    if (fitting == candidates.end()) {
        return std::unexpected(unknown_header(*table, candidates));
    }
    Expected<gaze::GazeTrace> trace = (*fitting)->read(*table);
    if (trace) {
        gaze::report_new_origins(trace->samples, trace->report);
    }
    return trace;
}

Expected<gaze::GazeTrace> read_trace(const std::string& file, std::string_view format) {
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
    Expected<gaze::GazeTrace> trace = read_trace(in, file, format);
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
