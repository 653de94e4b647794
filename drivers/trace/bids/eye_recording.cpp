#include "drivers/trace/bids/eye_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "drivers/trace/bids/bids_files.h"
#include "drivers/trace/bids/bids_rules.h"
#include "drivers/trace/directions.h"
#include "drivers/trace/json_file.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kTimestamp = 0;
constexpr std::size_t kX = 1;
constexpr std::size_t kY = 2;

std::unexpected<Error> bad_input(const fs::path& file, std::string_view what) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)});
}

std::string unit_of(const Json& physio, std::string_view column) {
    const auto found = physio.find(column);
    return found != physio.end() && found->is_object() ? text_in(*found, "Units") : std::string{};
}

/// How many decimals of the unit a nanosecond is.
std::optional<int> decimals_of(std::string_view unit) {
    struct Known {
        std::string_view name;
        int decimals;
    };
    for (const Known& known :
         {Known{"s", 9}, Known{"sec", 9}, Known{"second", 9}, Known{"seconds", 9}, Known{"ms", 6},
          Known{"millisecond", 6}, Known{"milliseconds", 6}, Known{"us", 3}, Known{"\xC2\xB5s", 3},
          Known{"\xCE\xBCs", 3}, Known{"microsecond", 3}, Known{"microseconds", 3}, Known{"ns", 0},
          Known{"nanosecond", 0}, Known{"nanoseconds", 0}}) {
        if (unit == known.name) {
            return known.decimals;
        }
    }
    return std::nullopt;
}

/// Metres of a unit of length, radians of one of angles.
std::optional<double> size_of(std::string_view unit, bool angle) {
    struct Known {
        std::string_view name;
        double size;
    };
    if (angle) {
        for (const Known& known :
             {Known{"deg", glm::radians(1.0)}, Known{"degree", glm::radians(1.0)},
              Known{"degrees", glm::radians(1.0)}, Known{"rad", 1.0}, Known{"radian", 1.0},
              Known{"radians", 1.0}}) {
            if (unit == known.name) {
                return known.size;
            }
        }
        return std::nullopt;
    }
    for (const Known& known : {Known{"m", 1.0}, Known{"cm", 1e-2}, Known{"mm", 1e-3}}) {
        if (unit == known.name) {
            return known.size;
        }
    }
    return std::nullopt;
}

bool is_pixel(std::string_view unit) { return unit == "pixel" || unit == "pixels" || unit == "px"; }

Expected<ScreenGeometry> screen_of(const fs::path& file, const Json& events) {
    const Json& screen = events.at("StimulusPresentation");
    const auto size_m = *numbers_in<2>(screen, "ScreenSize");
    const auto size_px = *numbers_in<2>(screen, "ScreenResolution");
    const Json& origin = screen.at("ScreenOrigin");
    ScreenGeometry geometry{.size_m = {size_m[0], size_m[1]},
                            .size_px = {size_px[0], size_px[1]},
                            .from_left = origin[1] == "left",
                            .from_top = origin[0] == "top"};
    if (const auto distance_m = number_in(screen, "ScreenDistance")) {
        geometry.middle_m = {0.0, 0.0, -*distance_m};
    } else {
        return bad_input(file,
                         "ScreenDistance with three numbers is not read: nobody says along which "
                         "axes they count; write the distance to the screen's middle");
    }
    if (const auto right = geometry.check(); !right) {
        return bad_input(file, "StimulusPresentation: " + right.error());
    }
    return geometry;
}

std::vector<std::string> columns_of(const Json& physio) {
    return physio.at("Columns").get<std::vector<std::string>>();
}

std::unique_ptr<std::ifstream> opened(const fs::path& file) {
    auto in = std::make_unique<std::ifstream>(file, std::ios::binary);
    return *in ? std::move(in) : nullptr;
}

}  // namespace

Expected<EyeRecording> EyeRecording::open(const fs::path& file) {
    const Expected<Json> physio = inherited_json(file, "physio");
    if (!physio) {
        return std::unexpected(physio.error());
    }
    if (physio->empty()) {
        return bad_input(file, "no sidecar *_physio.json beside it, which names the columns");
    }
    const Expected<Json> events = inherited_json(with_recording(file, "none", "events"), "events");
    if (!events) {
        return std::unexpected(events.error());
    }
    if (const std::vector<std::string> broken = broken_bids_rules(*physio, *events);
        !broken.empty()) {
        return bad_input(file, fmt::format("its JSON breaks BIDS' rules for eye tracking: {}",
                                           fmt::join(broken, "; ")));
    }
    auto in = opened(file);
    if (in == nullptr) {
        return bad_input(file, "cannot be opened");
    }
    Expected<CsvTable> table =
        CsvTable::without_header(TextLines{*in, file.string()}, '\t', columns_of(*physio));
    if (!table) {
        return std::unexpected(table.error());
    }
    EyeRecording recording(std::move(in), std::move(*table));
    const std::string eye = text_in(*physio, "RecordedEye");
    recording.of_ = {eye != "right", eye != "left"};
    recording.device_ = fmt::format("{} {}", text_in(*physio, "Manufacturer"),
                                    text_in(*physio, "ManufacturersModelName"));
    if (recording.device_ == " ") {
        recording.device_ = "unknown device";
    }
    if (const Expected<void> units = recording.take_units(*physio, *events); !units) {
        return std::unexpected(units.error());
    }
    recording.rate_hz_ = *number_in(*physio, "SamplingFrequency");
    recording.find_columns();
    if (const Expected<void> blinks = recording.read_blinks(file); !blinks) {
        return std::unexpected(blinks.error());
    }
    return recording;
}

Expected<void> EyeRecording::take_units(const Json& physio, const Json& events) {
    const fs::path file = table_.name();
    time_unit_ = unit_of(physio, "timestamp");
    const std::optional<int> decimals = decimals_of(time_unit_);
    if (!decimals) {
        return bad_input(file,
                         fmt::format("timestamp/Units is '{}': write s, ms, us or ns", time_unit_));
    }
    time_decimals_ = *decimals;
    const std::string unit = unit_of(physio, "x_coordinate");
    if (unit_of(physio, "y_coordinate") != unit) {
        return bad_input(file, "x_coordinate and y_coordinate have different Units");
    }
    const std::string system = text_in(physio, "SampleCoordinateSystem");
    if (system == "gaze-on-screen") {
        Expected<ScreenGeometry> screen = screen_of(file, events);
        if (!screen) {
            return std::unexpected(screen.error());
        }
        screen_ = *screen;
        system_ = is_pixel(unit) ? System::Screen_px : System::Screen_m;
        const std::optional<double> metres = size_of(unit, false);
        if (system_ == System::Screen_m && !metres) {
            return bad_input(
                file, fmt::format("gaze on the screen in '{}': write pixel, m, cm or mm", unit));
        }
        per_unit_ = metres.value_or(1.0);
        return {};
    }
    if (system != "eye-in-head") {
        return bad_input(file, fmt::format("SampleCoordinateSystem \"{}\" says no direction in the "
                                           "head: write gaze-on-screen or eye-in-head",
                                           system));
    }
    const std::optional<double> radians = size_of(unit, true);
    if (!radians) {
        return bad_input(file, fmt::format("an eye's direction in '{}': write deg or rad", unit));
    }
    system_ = System::Head;
    per_unit_ = *radians;
    table_.note(0, "eye-in-head: x is the azimuth, positive right, y the elevation, positive up");
    return {};
}

double EyeRecording::time_unit_ns() const { return std::pow(10.0, time_decimals_); }

void EyeRecording::find_columns() {
    openness_ = table_.column("eye_openness");
    confidence_ = table_.column("confidence");
    origin_ = table_.columns(
        std::array<std::string_view, 3>{"origin_x_m", "origin_y_m", "origin_z_m"}, "origin");
    head_ =
        table_.columns(std::array<std::string_view, 7>{"head_x_m", "head_y_m", "head_z_m",
                                                       "head_qx", "head_qy", "head_qz", "head_qw"},
                       "head");
}

Expected<void> EyeRecording::read_blinks(const fs::path& file) {
    const fs::path events_file = [&] {
        const std::optional<BidsName> name = bids_name(file);
        const auto recording = name->entities.find("recording");
        return packed_or_not(with_recording(
            file, recording != name->entities.end() ? recording->second : std::string{},
            "physioevents"));
    }();
    const auto in = opened(events_file);
    if (in == nullptr) {
        return {};
    }
    const Expected<Json> json = inherited_json(events_file, "physioevents");
    if (!json) {
        return std::unexpected(json.error());
    }
    const auto columns = json->find("Columns");
    const bool named = columns != json->end() && columns->is_array() &&
                       std::ranges::all_of(*columns, [](const Json& c) { return c.is_string(); });
    const std::string source = text_in(*json, "OnsetSource");
    blinks_by_row_ = source == "n/a";
    if (!named || (source != "timestamp" && !blinks_by_row_)) {
        table_.note(0, fmt::format("{}: not read, its OnsetSource is neither \"timestamp\" nor "
                                   "\"n/a\", or it names no Columns",
                                   events_file.filename().string()));
        return {};
    }
    Expected<CsvTable> table = CsvTable::without_header(TextLines{*in, events_file.string()}, '\t',
                                                        columns->get<std::vector<std::string>>());
    if (!table) {
        return std::unexpected(table.error());
    }
    const auto onset = table->column("onset");
    const auto duration = table->column("duration");
    const auto type = table->column("trial_type");
    const auto blink = table->column("blink");
    if (!onset || !duration || (!type && !blink)) {
        return {};
    }
    while (true) {
        const Expected<bool> more = table->next();
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            break;
        }
        const bool is_blink = (type && table->text(*type) == "blink") ||
                              (blink && table->whole(*blink) == std::int64_t{1});
        const auto begin =
            blinks_by_row_ ? table->whole(*onset) : table->decimal(*onset, time_decimals_);
        const auto lasts_s = table->real(*duration);
        constexpr double kMost_s = 1e6;
        constexpr double kFarthest = 9e18;
        if (is_blink && begin && lasts_s && *lasts_s >= 0.0 && *lasts_s <= kMost_s) {
            const double lasts = *lasts_s * (blinks_by_row_ ? rate_hz_ : 1e9);
            if (std::abs(static_cast<double>(*begin)) + lasts < kFarthest) {
                blinks_.push_back({*begin, *begin + std::llround(lasts)});
            }
        }
    }
    std::ranges::sort(blinks_, {}, &Blink::begin);
    return {};
}

bool EyeRecording::in_blink() const {
    const std::optional<std::int64_t> now =
        blinks_by_row_ ? std::optional{row_number_} : row_.device_ticks;
    const auto later = std::ranges::upper_bound(blinks_, now.value_or(0), {}, &Blink::begin);
    return now && later != blinks_.begin() && *now <= (later - 1)->end;
}

glm::dvec3 EyeRecording::direction(double x, double y) const {
    switch (system_) {
        case System::Screen_px:
            return screen_.direction({x, y});
        case System::Screen_m:
            return screen_.direction(glm::dvec2{x, y} * per_unit_ / screen_.size_m *
                                     screen_.size_px);
        case System::Head:
            break;
    }
    return of_azimuth_elevation(x * per_unit_, y * per_unit_);
}

double EyeRecording::fraction(std::optional<std::size_t> column, RowDetail detail, gaze::Eye eye,
                              BadCells& bad) {
    constexpr double kUnknown = -1.0;
    if (!column) {
        return kUnknown;
    }
    const auto value = table_.real(*column);
    if (value && ((*value >= 0.0 && *value <= 1.0) || *value == kUnknown)) {
        bad.has(detail);
        return *value;
    }
    if (table_.is_missing(*column)) {
        bad.lacks(detail, table_.line(), [&] { return table_.described(*column); });
    } else {
        bad.add(other_of(eye), table_.line(), [&] {
            return fmt::format("{} is neither 0 to 1 nor -1 (unknown)", table_.described(*column));
        });
    }
    return kUnknown;
}

glm::dvec3 EyeRecording::place(gaze::Eye eye, BadCells& bad) {
    glm::dvec3 origin_m{0.0};
    for (const int i : {0, 1, 2}) {
        const std::size_t column = (*origin_)[static_cast<std::size_t>(i)];
        if (const auto value = table_.real(column)) {
            origin_m[i] = *value;
            continue;
        }
        if (table_.is_missing(column)) {
            bad.lacks(origin_of(eye), table_.line(), [&] { return table_.described(column); });
        } else {
            bad.add(other_of(eye), table_.line(),
                    [&] { return fmt::format("{} is no number", table_.described(column)); });
        }
        return glm::dvec3{0.0};
    }
    bad.has(origin_of(eye));
    return origin_m;
}

void EyeRecording::read_head(BadCells& bad) {
    std::array<double, 7> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t column = (*head_)[i];
        const auto number = table_.real(column);
        if (!number && table_.is_missing(column)) {
            bad.lacks(RowDetail::Head, table_.line(), [&] { return table_.described(column); });
            return;
        }
        if (!number) {
            bad.add(RowPart::Head, table_.line(),
                    [&] { return fmt::format("{} is no number", table_.described(column)); });
            return;
        }
        numbers[i] = *number;
    }
    const auto [x, y, z, qx, qy, qz, qw] = numbers;
    const glm::dquat turn{qw, qx, qy, qz};
    const double length = glm::length(turn);
    if (!std::isnormal(length)) {
        bad.add(RowPart::Head, table_.line(), [&] {
            return fmt::format("{} ends an orientation without length",
                               table_.described(head_->back()));
        });
        return;
    }
    bad.has(RowDetail::Head);
    row_.head = gaze::Pose{turn / length, {x, y, z}};
}

void EyeRecording::read_eye(BadCells& bad) {
    const gaze::Eye eye = of_[0] ? gaze::Eye::Left : gaze::Eye::Right;
    gaze::EyeRay ray;
    const auto x = table_.real(kX);
    const auto y = table_.real(kY);
    const std::string_view loss =
        x && y && system_ == System::Screen_px ? screen_.loss_at({*x, *y}) : std::string_view{};
    if (!loss.empty()) {
        bad.add(direction_of(eye), table_.line(), [loss] { return std::string{loss}; });
    } else if (x && y) {
        if (const auto unit = gaze::unit(direction(*x, *y))) {
            ray.valid = true;
            ray.direction = *unit;
        } else {
            bad.add(direction_of(eye), table_.line(),
                    [] { return std::string{"a point without a direction"}; });
        }
    } else if (const std::size_t column = x ? kY : kX;
               !table_.is_missing(column) || (x.has_value() != y.has_value())) {
        bad.add(direction_of(eye), table_.line(),
                [&] { return fmt::format("{} is no number", table_.described(column)); });
    }
    if (ray.valid) {
        ray.openness = fraction(openness_, openness_of(eye), eye, bad);
        ray.confidence = fraction(confidence_, confidence_of(eye), eye, bad);
        ray.origin_m = origin_ ? place(eye, bad) : glm::dvec3{0.0};
    } else {
        BadCells not_counted;  // of an eye without a direction nothing is missed
        ray.openness = fraction(openness_, openness_of(eye), eye, not_counted);
        ray.confidence = fraction(confidence_, confidence_of(eye), eye, not_counted);
        ray.origin_m = origin_ ? place(eye, not_counted) : glm::dvec3{0.0};
    }
    if (in_blink()) {
        first_in_blink_ = in_blinks_++ == 0 ? table_.line() : first_in_blink_;
        ray.valid = false;
    }
    for (const gaze::Eye each : gaze::kEyes) {
        if (is_of(each)) {
            row_.eyes[gaze::index(each)] = ray;
        }
    }
}

Expected<bool> EyeRecording::next(BadCells& bad) {
    const Expected<bool> more = table_.next();
    if (!more || !*more) {
        return more;
    }
    row_ = {};
    ++row_number_;
    row_.line = table_.line();
    row_.device_ticks = table_.decimal(kTimestamp, time_decimals_);
    if (!row_.device_ticks && unread_time_.empty()) {
        unread_time_ = fmt::format("{} is no time in {}", table_.described(kTimestamp), time_unit_);
    }
    read_eye(bad);
    // A point on a screen is seen from the middle between the eyes here.
    if (system_ != System::Head) {
        row_.parallax_rad = combined_parallax_rad(screen_.distance_m());
    } else if (of_[0] && of_[1]) {
        row_.parallax_rad = combined_parallax_rad();
    }
    if (head_) {
        read_head(bad);
    }
    return true;
}

void EyeRecording::report_to(gaze::TraceReport& report) const {
    table_.report_to(report);
    if (in_blinks_ > 0) {
        report.add({.kind = gaze::TraceFindingKind::RefusedByBit,
                    .line = first_in_blink_,
                    .rows = in_blinks_,
                    .text = fmt::format("gaze not vouched for in {} {}: a blink (physioevents)",
                                        in_blinks_, in_blinks_ == 1 ? "row" : "rows")});
    }
}

}  // namespace gazeloop::drivers
