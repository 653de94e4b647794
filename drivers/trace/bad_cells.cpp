#include "drivers/trace/bad_cells.h"

#include <fmt/format.h>

#include <string_view>

namespace gazeloop::drivers {

void BadCells::report_to(gaze::TraceReport& report) const {
    struct Words {
        std::string_view part;
        std::string_view done;
    };
    constexpr std::array<Words, kRowParts> kWords{
        Words{"left eye", "the eye is invalid there"},
        Words{"right eye", "the eye is invalid there"},
        Words{"left eye, beside its direction", "unknown there"},
        Words{"right eye, beside its direction", "unknown there"},
        Words{"head", "its pose is unknown there"},
        Words{"sequence number or arrival", "unknown there"},
    };
    for (std::size_t part = 0; part < kRowParts; ++part) {
        const Count& count = counts_[part];
        if (count.rows > 0) {
            report.add({.kind = gaze::TraceFindingKind::BadCells,
                        .line = count.first_line,
                        .rows = count.rows,
                        .text = fmt::format("{}: {} ({} {} with such cells: {})", kWords[part].part,
                                            count.first, count.rows,
                                            count.rows == 1 ? "row" : "rows", kWords[part].done)});
        }
    }
    constexpr std::array<std::string_view, kRowDetails> kDetails{
        "left eye's place",  "left eye's openness",  "left eye's confidence",
        "right eye's place", "right eye's openness", "right eye's confidence",
        "head's pose",       "sequence number",      "arrival",
    };
    for (std::size_t detail = 0; detail < kRowDetails; ++detail) {
        const auto& [known, unknown] = details_[detail];
        if (known && unknown.rows > 0) {
            report.add({.kind = gaze::TraceFindingKind::BadCells,
                        .line = unknown.first_line,
                        .rows = unknown.rows,
                        .text = fmt::format("{}: {} is no number, though other rows have one ({} "
                                            "{} with such cells: unknown there)",
                                            kDetails[detail], unknown.first, unknown.rows,
                                            unknown.rows == 1 ? "row" : "rows")});
        }
    }
}

}  // namespace gazeloop::drivers
