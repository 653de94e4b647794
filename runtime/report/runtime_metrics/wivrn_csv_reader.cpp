#include "runtime/report/runtime_metrics/wivrn_csv_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "drivers/trace/text/cell_number.h"
#include "runtime/open_for_reading.h"

namespace gazeloop::report {
namespace {

constexpr std::string_view kRemedy =
    "give the file that WIVRN_DUMP_TIMINGS named when wivrn-server was started";
constexpr std::size_t kColumns = 4;

std::optional<std::int64_t> whole(std::string_view cell) {
    drivers::NumberSpelling seen;
    return drivers::whole_number(cell, seen);
}

}  // namespace

WivrnCsvReader::WivrnCsvReader(std::unique_ptr<std::istream> in, std::string name)
    : in_(std::move(in)),
      lines_(std::make_unique<drivers::TextLines>(*in_, std::move(name))),
      cells_(std::make_unique<drivers::LineCells>(drivers::TextLines::kLongestLine)) {}

Expected<WivrnCsvReader> WivrnCsvReader::open(const std::filesystem::path& file) {
    auto in = open_for_reading(file);
    if (!in) {
        return std::unexpected(Error{
            ErrorKind::BadInput, fmt::format("{}: {}: {}", file.string(), in.error(), kRemedy)});
    }
    return open(std::make_unique<std::ifstream>(std::move(*in)), file.string());
}

Expected<WivrnCsvReader> WivrnCsvReader::open(std::unique_ptr<std::istream> in, std::string name) {
    WivrnCsvReader reader(std::move(in), std::move(name));
    const Expected<bool> any = reader.lines_->next();
    if (!any) {
        return std::unexpected(any.error());
    }
    if (!*any) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: empty: {}", reader.name(), kRemedy)});
    }
    reader.first_ = reader.form_of_line();
    if (reader.first_ == Form::NoRow) {
        return reader.lines_->error_here(
            fmt::format("no row of WiVRn's timings (\"event\",frame,time,stream): {}", kRemedy));
    }
    return reader;
}

WivrnCsvReader::Form WivrnCsvReader::form_of_line() {
    if (cells_->split(lines_->text(), ',') != drivers::LineCells::Problem::None ||
        cells_->size() < kColumns || (*cells_)[0].empty()) {
        return Form::NoRow;
    }
    if ((*cells_)[0] == "event") {
        return Form::Header;
    }
    const bool numbers =
        std::ranges::all_of(cells_->cells().subspan(1, kColumns - 1),
                            [](std::string_view cell) { return whole(cell).has_value(); });
    return numbers ? Form::Row : Form::NoRow;
}

Expected<std::optional<WivrnRow>> WivrnCsvReader::next() {
    while (true) {
        std::optional<Form> form = std::exchange(first_, std::nullopt);
        if (!form) {
            const Expected<bool> more = lines_->next();
            if (!more) {
                return std::unexpected(more.error());
            }
            if (!*more) {
                return std::nullopt;
            }
            form = form_of_line();
        }
        if (!lines_->ended()) {  // WiVRn writes whole lines
            counts_.cut = true;
            continue;
        }
        if (form == Form::NoRow) {
            counts_.first_bad_line = counts_.bad == 0 ? lines_->line() : counts_.first_bad_line;
            ++counts_.bad;
        } else if (form == Form::Row) {
            ++counts_.rows;
            if (const auto row = row_of_cells()) {
                return row;
            }
        }
    }
}

std::optional<WivrnRow> WivrnCsvReader::row_of_cells() {
    constexpr std::int64_t kNoStream = 255;
    const auto* const event = std::ranges::find(kWivrnEventNames, (*cells_)[0]);
    const std::int64_t frame = *whole((*cells_)[1]);
    const std::int64_t ns = *whole((*cells_)[2]);
    const std::int64_t stream = *whole((*cells_)[3]);
    if (event == kWivrnEventNames.end() || stream < 0 || stream > kNoStream) {
        ++counts_.unknown;
        return std::nullopt;
    }
    if (frame < 0 || ns <= 0) {
        ++counts_.untimed;
        return std::nullopt;
    }
    return WivrnRow{.event = static_cast<WivrnEvent>(event - kWivrnEventNames.begin()),
                    .frame = static_cast<std::uint64_t>(frame),
                    .ns = ns,
                    .stream = stream == kNoStream
                                  ? std::nullopt
                                  : std::optional(static_cast<std::uint8_t>(stream))};
}

}  // namespace gazeloop::report
