#include "drivers/hid/eye_tracker_reports.h"

#include <algorithm>
#include <array>
#include <limits>

namespace gazeloop::drivers::hid {
namespace {

using Payload = std::span<const std::uint8_t>;

std::optional<std::uint32_t> count_of(const std::optional<ReportValue>& value, Payload payload) {
    const auto number = value ? value->number(payload) : std::nullopt;
    if (!number || *number < 0 || *number > std::numeric_limits<std::uint32_t>::max()) {
        return std::nullopt;
    }
    return static_cast<std::uint32_t>(*number);
}

/// Zero of what there is says nothing.
std::optional<std::uint32_t> nonzero(std::optional<std::uint32_t> count) {
    return count == 0U ? std::nullopt : count;
}

std::optional<glm::dvec3> position_of(const PositionFields& fields, std::size_t axes,
                                      Payload payload) {
    glm::dvec3 position{0.0};
    for (std::size_t axis = 0; axis < axes; ++axis) {
        const auto value = fields[axis] ? fields[axis]->si(payload) : std::nullopt;
        if (!value) {
            return std::nullopt;
        }
        position[static_cast<int>(axis)] = *value;
    }
    return position;
}

TrackerStatus status_of(std::uint32_t number) {
    constexpr auto kLast = static_cast<std::uint32_t>(TrackerStatus::UserCalibrationNeeded);
    return number <= kLast ? static_cast<TrackerStatus>(number) : TrackerStatus::Unknown;
}

StatusReport decode_status(const StatusLayout& layout, std::uint8_t id, Payload payload) {
    StatusReport report;
    if (layout.status && layout.status->report_id == id) {
        if (const auto number = count_of(layout.status, payload)) {
            report.status = status_of(*number);
        }
    }
    if (layout.sampling_hz && layout.sampling_hz->report_id == id) {
        report.sampling_hz = nonzero(count_of(layout.sampling_hz, payload));
    }
    return report;
}

TrackingReport decode_tracking(const TrackingLayout& layout, Payload payload) {
    TrackingReport report;
    report.report_id = layout.report_id;
    if (layout.timestamp) {
        report.ticks = layout.timestamp->ticks(payload);
    }
    if (const auto gaze = position_of(layout.gaze_point, 2, payload)) {
        report.gaze_m = glm::dvec2(*gaze);
    }
    for (const gaze::Eye eye : gaze::kEyes) {
        report.eye_m[gaze::index(eye)] =
            position_of(layout.eye_position[gaze::index(eye)], 3, payload);
    }
    return report;
}

Payload payload_of(const std::vector<FeatureReport>::value_type& report) {
    return Payload(report.bytes).subspan(std::min<std::size_t>(1, report.bytes.size()));
}

/// Finds the feature report that a value stands in.
class FeatureReader {
  public:
    explicit FeatureReader(std::span<const FeatureReport> reports) : reports_(reports) {}

    [[nodiscard]] std::optional<std::uint32_t> count(
        const std::optional<ReportValue>& value) const {
        return value ? count_of(value, payload(value->report_id)) : std::nullopt;
    }

    [[nodiscard]] std::optional<double> length_m(const std::optional<ReportValue>& value) const {
        const auto metres = value ? value->si(payload(value->report_id)) : std::nullopt;
        return metres && *metres > 0.0 ? metres : std::nullopt;
    }

    [[nodiscard]] Payload payload(std::uint8_t id) const {
        const auto found = std::ranges::find(reports_, id, &FeatureReport::id);
        return found == reports_.end() ? Payload{} : payload_of(*found);
    }

  private:
    std::span<const FeatureReport> reports_;
};

struct StatedLength {
    std::string_view of;
    std::optional<double>* metres;
};

/// Trackers work, and screens measure, between 1 cm and 10 m.
bool is_plausible(double metres) {
    constexpr double kLeast_m = 0.01;
    constexpr double kGreatest_m = 10.0;
    return metres >= kLeast_m && metres <= kGreatest_m;
}

/// Multiplies the lengths by the one factor that makes most of them plausible, and leaves out those
/// that even so are not. Returns the factor.
double correct(std::span<const StatedLength> lengths, std::vector<ImplausibleLength>& left_out) {
    const auto plausible_by = [&](double factor) {
        return std::ranges::count_if(lengths, [&](const StatedLength& length) {
            return *length.metres && is_plausible(**length.metres * factor);
        });
    };
    const double factor = std::ranges::max(std::array{1.0, 1e3, 1e-3}, {}, plausible_by);
    for (const auto& [of, metres] : lengths) {
        if (!*metres) {
            continue;
        }
        if (is_plausible(**metres * factor)) {
            **metres *= factor;
        } else {
            left_out.push_back({of, **metres});
            metres->reset();
        }
    }
    return factor;
}

void correct(TrackerFeatures& features) {
    const std::array<StatedLength, 5> capabilities{
        {{"its least distance", &features.minimum_distance_m},
         {"its best distance", &features.optimum_distance_m},
         {"its greatest distance", &features.maximum_distance_m},
         {"its screen's greatest width", &features.maximum_width_m},
         {"its screen's greatest height", &features.maximum_height_m}}};
    const std::array<StatedLength, 2> screen{{{"its screen's width", &features.screen_width_m},
                                              {"its screen's height", &features.screen_height_m}}};
    features.capability_correction = correct(capabilities, features.implausible);
    features.screen_correction = correct(screen, features.implausible);
}

}  // namespace

std::string_view text_of(TrackerStatus status) {
    switch (status) {
        case TrackerStatus::Ready:
            return "ready";
        case TrackerStatus::Configuring:
            return "configuring: wait until it is ready";
        case TrackerStatus::ScreenSetupNeeded:
            return "needs its screen set up: run the maker's set-up tool";
        case TrackerStatus::UserCalibrationNeeded:
            return "needs to be calibrated to its user: run the maker's calibration";
        case TrackerStatus::Unknown:
            break;
    }
    return "unknown";
}

InputReport decode_input(const EyeTrackerLayout& layout, std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) {
        return OtherReport{};
    }
    const std::uint8_t id = layout.numbered ? bytes.front() : std::uint8_t{0};
    const Payload payload = layout.numbered ? bytes.subspan(1) : bytes;
    const StatusReport status = decode_status(layout.status_input, id, payload);
    const auto found = std::ranges::find(layout.tracking, id, &TrackingLayout::report_id);
    if (found != layout.tracking.end()) {
        TrackingReport report = decode_tracking(*found, payload);
        report.status = status;
        const ReportSize* const size = find_report(layout.reports, ReportKind::Input, id);
        report.truncated = size != nullptr && payload.size() < size->payload_bytes();
        return report;
    }
    if (status.status || status.sampling_hz) {
        return status;
    }
    return OtherReport{};
}

TrackerFeatures decode_features(const EyeTrackerLayout& layout,
                                std::span<const FeatureReport> reports) {
    const FeatureReader read(reports);
    TrackerFeatures features;
    features.quality = nonzero(read.count(layout.quality));
    features.minimum_distance_m = read.length_m(layout.minimum_distance);
    features.optimum_distance_m = read.length_m(layout.optimum_distance);
    features.maximum_distance_m = read.length_m(layout.maximum_distance);
    features.maximum_width_m = read.length_m(layout.maximum_width);
    features.maximum_height_m = read.length_m(layout.maximum_height);
    features.display_manufacturer = nonzero(read.count(layout.display_manufacturer));
    features.display_product = nonzero(read.count(layout.display_product));
    features.display_serial = nonzero(read.count(layout.display_serial));
    features.screen_width_m = read.length_m(layout.screen_width);
    features.screen_height_m = read.length_m(layout.screen_height);
    correct(features);
    if (const auto number = read.count(layout.status_feature.status)) {
        features.status.status = status_of(*number);
    }
    features.status.sampling_hz = nonzero(read.count(layout.status_feature.sampling_hz));
    return features;
}

std::optional<std::vector<std::uint8_t>> encode_mode_request(const EyeTrackerLayout& layout,
                                                             std::uint8_t modes) {
    if (!layout.mode_request) {
        return std::nullopt;
    }
    const ReportValue& value = *layout.mode_request;
    const ReportSize* const size =
        find_report(layout.reports, ReportKind::Feature, value.report_id);
    if (size == nullptr) {
        return std::nullopt;
    }
    std::vector<std::uint8_t> bytes(1 + size->payload_bytes(), 0);
    bytes.front() = value.report_id;
    write_bits(std::span(bytes).subspan(1), value.bit_offset, value.bits, modes);
    return bytes;
}

}  // namespace gazeloop::drivers::hid
