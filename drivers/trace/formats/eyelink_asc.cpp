#include "drivers/trace/formats/eyelink_asc.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/trace/bad_cells.h"
#include "drivers/trace/directions.h"
#include "drivers/trace/screen_sidecar.h"
#include "drivers/trace/text/cell_number.h"
#include "drivers/trace/text/line_cells.h"
#include "drivers/trace/trace_builder.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

/// Time, then x, y and pupil of an eye.
constexpr std::size_t kCellsOfEye = 3;

/// What stands between spaces and tabs.
std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = line.find_first_not_of(" \t");
        if (begin == std::string_view::npos) {
            return words;
        }
        const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        line.remove_prefix(end);
    }
}

/// What the lines before the samples say.
struct Settings {
    std::vector<gaze::Eye> eyes;
    std::optional<glm::dvec2> first_px;  ///< of the screen's pixels
    std::optional<glm::dvec2> size_px;
};

class Reader {
  public:
    Reader(TextLines lines, const TraceFile& file)
        : lines_(std::move(lines)),
          file_(file),
          builder_({.file = lines_.name(), .format = kEyelinkAsc, .device = "EyeLink"}),
          cells_(TextLines::kLongestLine) {
        builder_.clock_is("time", 1e6);
    }

    [[nodiscard]] Expected<BuiltTrace> read(const ReadOptions& options) {
        while (true) {
            const Expected<bool> more = lines_.next();
            if (!more) {
                return std::unexpected(more.error());
            }
            if (!*more) {
                break;
            }
            if (const Expected<void> taken = take(lines_.text()); !taken) {
                return std::unexpected(taken.error());
            }
        }
        gaze::TraceReport& report = builder_.report();
        lines_.report_to(report);
        bad_.report_to(report);
        if (cut_line_ > 0) {
            report.rows += 1;
            report.add({.kind = gaze::TraceFindingKind::CutRow,
                        .line = cut_line_,
                        .rows = 1,
                        .dropped = 1,
                        .text = "the last line was not finished: it is not used"});
        }
        return builder_.finish(options);
    }

  private:
    [[nodiscard]] Expected<void> take(std::string_view line) {
        if (line.empty() || line.starts_with("**")) {
            return {};
        }
        if (line.front() >= '0' && line.front() <= '9') {
            return take_sample(line);
        }
        const std::vector<std::string_view> words = words_of(line);
        if (!words.empty() && words[0] == "SAMPLES") {
            return take_samples(words);
        }
        if (!words.empty() && words[0] == "MSG") {
            return take_message(words);
        }
        return {};
    }

    [[nodiscard]] Expected<void> take_samples(const std::vector<std::string_view>& words) {
        if (words.size() < 2 || words[1] != "GAZE") {
            return lines_.error_here(
                "samples that are not GAZE have no geometry: convert the EDF file again with gaze "
                "coordinates (edf2asc without -h, -r)");
        }
        settings_.eyes.clear();
        for (const std::string_view word : words) {
            if (word == "LEFT") {
                settings_.eyes.push_back(gaze::Eye::Left);
            } else if (word == "RIGHT") {
                settings_.eyes.push_back(gaze::Eye::Right);
            }
        }
        return {};
    }

    [[nodiscard]] Expected<void> take_message(const std::vector<std::string_view>& words) {
        for (std::size_t i = 0; i + 4 < words.size(); ++i) {
            if (words[i] != "GAZE_COORDS" && words[i] != "DISPLAY_COORDS") {
                continue;
            }
            std::array<double, 4> edges{};
            for (std::size_t edge = 0; edge < edges.size(); ++edge) {
                NumberSpelling seen;
                const auto number = real_number(words[i + 1 + edge], seen);
                if (!number) {
                    return {};
                }
                edges[edge] = *number;
            }
            settings_.first_px = {edges[0], edges[1]};
            settings_.size_px = {edges[2] - edges[0] + 1.0, edges[3] - edges[1] + 1.0};
        }
        return screen_ ? change_screen() : Expected<void>{};
    }

    /// The pixels are others from here on; the screen is the same.
    [[nodiscard]] Expected<void> change_screen() {
        const glm::dvec2 before_px = screen_->size_px;
        screen_->size_px = settings_.size_px.value_or(before_px);
        if (screen_->size_px == before_px) {
            return {};
        }
        if (const auto right = screen_->check(); !right) {
            return lines_.error_here(right.error());
        }
        builder_.report().add(
            {.kind = gaze::TraceFindingKind::Text,
             .line = lines_.line(),
             .text =
                 fmt::format("the screen has {} x {} pixels from here on, not {} x {}",
                             screen_->size_px.x, screen_->size_px.y, before_px.x, before_px.y)});
        return {};
    }

    /// The geometry, once samples begin.
    [[nodiscard]] Expected<void> find_screen() {
        if (settings_.eyes.empty()) {
            return lines_.error_here("a sample before a line SAMPLES GAZE LEFT or RIGHT");
        }
        Expected<ScreenSidecar> sidecar =
            read_screen_sidecar(file_, lines_.name(), settings_.size_px);
        if (!sidecar) {
            return std::unexpected(sidecar.error());
        }
        screen_ = sidecar->screen;
        parallax_rad_ = combined_parallax_rad(screen_->distance_m());
        return {};
    }

    [[nodiscard]] Expected<void> take_sample(std::string_view line) {
        if (!screen_) {
            if (const Expected<void> found = find_screen(); !found) {
                return found;
            }
        }
        // A quote is a character like any other here.
        (void)cells_.split(line, '\t');
        if (cells_.size() < 1 + kCellsOfEye * settings_.eyes.size()) {
            if (!lines_.ended()) {
                cut_line_ = lines_.line();
                return {};
            }
            return lines_.error_here(fmt::format(
                "{} cells, a sample of {} {} has {}: mend or remove the line", cells_.size(),
                settings_.eyes.size(), settings_.eyes.size() == 1 ? "eye" : "eyes",
                1 + kCellsOfEye * settings_.eyes.size()));
        }
        TraceRow row;
        row.line = lines_.line();
        row.parallax_rad = parallax_rad_;
        NumberSpelling seen;
        row.device_ticks = decimal_number(cells_[0], 6, seen);
        if (!row.device_ticks && !builder_.knows_unread_time()) {
            builder_.unread_time("a sample's first cell is no time in milliseconds");
        }
        for (std::size_t i = 0; i < settings_.eyes.size(); ++i) {
            take_eye(settings_.eyes[i], 1 + kCellsOfEye * i, row);
        }
        builder_.add(row);
        return {};
    }

    void take_eye(gaze::Eye eye, std::size_t first, TraceRow& row) {
        NumberSpelling seen;
        const auto x = real_number(cells_[first], seen);
        const auto y = real_number(cells_[first + 1], seen);
        if (!x || !y) {
            if (!says_no_number(cells_[first]) || !says_no_number(cells_[first + 1])) {
                bad_.add(direction_of(eye), row.line,
                         [] { return std::string{"x or y is no number"}; });
            }
            return;
        }
        const glm::dvec2 origin = settings_.first_px.value_or(glm::dvec2{0.0});
        const glm::dvec2 point = glm::dvec2{*x, *y} - origin + glm::dvec2{0.5};
        if (const std::string_view loss = screen_->loss_at(point); !loss.empty()) {
            bad_.add(direction_of(eye), row.line, [loss] { return std::string{loss}; });
            return;
        }
        const auto direction = gaze::unit(screen_->direction(point));
        if (!direction) {
            bad_.add(direction_of(eye), row.line,
                     [] { return std::string{"a point too far from the screen"}; });
            return;
        }
        gaze::EyeRay& ray = row.eyes[gaze::index(eye)];
        ray.valid = true;
        ray.direction = *direction;
    }

    TextLines lines_;
    TraceFile file_;
    TraceBuilder builder_;
    LineCells cells_;
    BadCells bad_;
    Settings settings_;
    std::optional<ScreenGeometry> screen_;
    double parallax_rad_ = 0.0;
    std::uint64_t cut_line_ = 0;
};

}  // namespace

bool is_eyelink_asc(std::string_view first_line) {
    return first_line.starts_with("** CONVERTED FROM ");
}

Expected<BuiltTrace> read_eyelink_asc(TextLines lines, const TraceFile& file,
                                      const ReadOptions& options) {
    return Reader(std::move(lines), file).read(options);
}

}  // namespace gazeloop::drivers
