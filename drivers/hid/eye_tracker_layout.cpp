#include "drivers/hid/eye_tracker_layout.h"

#include <algorithm>
#include <utility>

#include "drivers/hid/eye_tracker_usages.h"

namespace gazeloop::drivers::hid {
namespace {

using namespace eye_tracker;

constexpr std::uint32_t kWidestTimestamp = 64;
/// More elements than any of the usages can need; a field may claim 65,535.
constexpr std::uint32_t kMostElements = 256;

/// What a counter in one element of the field runs through.
time::TickRange counter_range(const ReportField& field) {
    const bool is_signed = field.logical_minimum < 0;
    const time::TickRange held = is_signed ? time::TickRange::of_signed_bits(field.bits)
                                           : time::TickRange::of_bits(field.bits);
    const auto least = static_cast<std::uint64_t>(field.logical_minimum);
    const auto greatest = static_cast<std::uint64_t>(field.logical_maximum);
    if (field.logical_minimum >= field.logical_maximum || !held.holds(least) ||
        !held.holds(greatest)) {
        return time::TickRange::of_bits(field.bits);
    }
    // -2^n + 1 to 2^n - 1: two's complement, written so that zero is in the middle.
    const bool but_one = is_signed && (greatest & (greatest + 1)) == 0 && greatest == 0 - least;
    const std::uint64_t missing = but_one ? 1 : 0;
    return {.least = field.logical_minimum - static_cast<std::int64_t>(missing),
            .span = greatest - least + missing};
}

/// Reads the fields one after the other into the layout. The first of several numbers with the same
/// meaning is kept.
class LayoutFinder {
  public:
    explicit LayoutFinder(const ReportDescriptor& descriptor) : descriptor_(descriptor) {
        layout_.numbered = descriptor.numbered;
        layout_.reports = descriptor.reports;
    }

    EyeTrackerLayout find() {
        for (const ReportField& field : descriptor_.fields) {
            if (field.usages.empty() || !descriptor_.inside(field, kEyeTracker)) {
                continue;
            }
            switch (field.kind) {
                case ReportKind::Input:
                    input(field);
                    break;
                case ReportKind::Feature:
                    feature(field);
                    break;
                case ReportKind::Output:
                    break;
            }
        }
        std::erase_if(layout_.tracking, [](const TrackingLayout& tracking) {
            return !tracking.has_gaze() && !tracking.has_eye(gaze::Eye::Left) &&
                   !tracking.has_eye(gaze::Eye::Right);
        });
        return std::move(layout_);
    }

  private:
    void input(const ReportField& field) {
        const std::uint32_t elements = std::min(field.count, kMostElements);
        for (std::uint32_t element = 0; element < elements; ++element) {
            const Usage usage = field.usage_of(element);
            switch (usage) {
                case kSensorTimestamp:
                    element += timestamp(field, element) - 1;
                    break;
                case kPositionX:
                case kPositionY:
                case kPositionZ:
                    position(field, element, point_of(field), usage - kPositionX);
                    break;
                case kGazePoint:
                case kLeftEyePosition:
                case kRightEyePosition:
                    // The point itself as one field: its elements are x, y, z.
                    position(field, element, usage, element);
                    break;
                case kConfigurationStatus:
                    keep(layout_.status_input.status, field, element, Quantity::Count);
                    break;
                case kSamplingFrequency:
                    keep(layout_.status_input.sampling_hz, field, element, Quantity::Count);
                    break;
                default:
                    break;
            }
        }
    }

    void feature(const ReportField& field) {
        const std::uint32_t elements = std::min(field.count, kMostElements);
        for (std::uint32_t element = 0; element < elements; ++element) {
            switch (field.usage_of(element)) {
                case kTrackerQuality:
                    keep(layout_.quality, field, element, Quantity::Count);
                    break;
                case kMinimumTrackingDistance:
                    keep(layout_.minimum_distance, field, element, Quantity::Length);
                    break;
                case kOptimumTrackingDistance:
                    keep(layout_.optimum_distance, field, element, Quantity::Length);
                    break;
                case kMaximumTrackingDistance:
                    keep(layout_.maximum_distance, field, element, Quantity::Length);
                    break;
                case kMaximumScreenPlaneWidth:
                    keep(layout_.maximum_width, field, element, Quantity::Length);
                    break;
                case kMaximumScreenPlaneHeight:
                    keep(layout_.maximum_height, field, element, Quantity::Length);
                    break;
                case kDisplayManufacturerId:
                    keep(layout_.display_manufacturer, field, element, Quantity::Count);
                    break;
                case kDisplayProductId:
                    keep(layout_.display_product, field, element, Quantity::Count);
                    break;
                case kDisplaySerialNumber:
                    keep(layout_.display_serial, field, element, Quantity::Count);
                    break;
                case kCalibratedScreenWidth:
                    keep(layout_.screen_width, field, element, Quantity::Length);
                    break;
                case kCalibratedScreenHeight:
                    keep(layout_.screen_height, field, element, Quantity::Length);
                    break;
                case kConfigurationStatus:
                    keep(layout_.status_feature.status, field, element, Quantity::Count);
                    break;
                case kSamplingFrequency:
                    keep(layout_.status_feature.sampling_hz, field, element, Quantity::Count);
                    break;
                case kDeviceModeRequest:
                    keep(layout_.mode_request, field, element, Quantity::Count);
                    break;
                default:
                    break;
            }
        }
    }

    static void keep(std::optional<ReportValue>& slot, const ReportField& field,
                     std::uint32_t element, Quantity quantity) {
        if (!slot) {
            slot = value_of(field, element, quantity, false);
        }
    }

    TrackingLayout& tracking(const ReportField& field) {
        const auto found =
            std::ranges::find(layout_.tracking, field.report_id, &TrackingLayout::report_id);
        if (found != layout_.tracking.end()) {
            return *found;
        }
        TrackingLayout& added = layout_.tracking.emplace_back();
        added.report_id = field.report_id;
        return added;
    }

    /// Takes all elements from here on that are parts of the timestamp; gives their number.
    std::uint32_t timestamp(const ReportField& field, std::uint32_t element) {
        std::uint32_t parts = 1;
        while (element + parts < field.count && (parts + 1) * field.bits <= kWidestTimestamp &&
               field.usage_of(element + parts) == kSensorTimestamp) {
            ++parts;
        }
        std::optional<TimestampField>& slot = tracking(field).timestamp;
        if (!slot && parts * field.bits <= kWidestTimestamp) {
            constexpr double kNsPerSecond = 1e9;
            slot = {.bit_offset = field.bit_offset + element * field.bits,
                    .bits = parts * field.bits,
                    .range = parts > 1 ? time::TickRange::of_bits(parts * field.bits)
                                       : counter_range(field),
                    .tick_ns = unit_size(field, Quantity::Time) * kNsPerSecond};
        }
        return parts;
    }

    void position(const ReportField& field, std::uint32_t element, Usage point,
                  std::uint32_t axis) {
        if (axis >= std::tuple_size_v<PositionFields>) {
            return;
        }
        PositionFields* fields = nullptr;
        switch (point) {
            case kGazePoint:
                fields = &tracking(field).gaze_point;
                break;
            case kLeftEyePosition:
                fields = &tracking(field).eye_position[gaze::index(gaze::Eye::Left)];
                break;
            case kRightEyePosition:
                fields = &tracking(field).eye_position[gaze::index(gaze::Eye::Right)];
                break;
            default:
                return;  // of the head, say
        }
        if (!(*fields)[axis]) {
            (*fields)[axis] = value_of(field, element, Quantity::Length, true);
        }
    }

    /// What a position inside collections is the position of.
    [[nodiscard]] Usage point_of(const ReportField& field) const {
        constexpr Usage kLastPoint = usage(kPage, 0x28);  // Head Direction Point
        for (auto at = field.collection; at; at = descriptor_.collections[*at].parent) {
            const Usage usage = descriptor_.collections[*at].usage;
            if (usage >= kGazePoint && usage <= kLastPoint) {
                return usage;
            }
        }
        return 0;
    }

    const ReportDescriptor& descriptor_;
    EyeTrackerLayout layout_;
};

}  // namespace

std::optional<std::uint64_t> TimestampField::ticks(std::span<const std::uint8_t> payload) const {
    const std::optional<std::uint64_t> read = read_bits(payload, bit_offset, bits);
    if (!read || range.least >= 0) {
        return read;
    }
    const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
    return (*read ^ sign) - sign;
}

std::vector<std::uint8_t> EyeTrackerLayout::feature_ids() const {
    std::vector<std::uint8_t> ids;
    for (const auto* value :
         {&screen_width, &screen_height, &status_feature.status, &status_feature.sampling_hz,
          &display_manufacturer, &display_product, &display_serial, &quality, &minimum_distance,
          &optimum_distance, &maximum_distance, &maximum_width, &maximum_height}) {
        if (*value && std::ranges::find(ids, (*value)->report_id) == ids.end()) {
            ids.push_back((*value)->report_id);
        }
    }
    return ids;
}

bool describes_eye_tracker(const ReportDescriptor& descriptor) {
    return std::ranges::any_of(descriptor.collections, [](const Collection& collection) {
        return collection.usage == kEyeTracker &&
               collection.type == static_cast<std::uint8_t>(CollectionType::Application);
    });
}

Expected<EyeTrackerLayout> find_eye_tracker(const ReportDescriptor& descriptor) {
    if (!describes_eye_tracker(descriptor)) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  "the HID device has no eye tracker (usage page 0x12, usage 1) in its report "
                  "descriptor"});
    }
    EyeTrackerLayout layout = LayoutFinder(descriptor).find();
    const bool any_gaze = std::ranges::any_of(layout.tracking, &TrackingLayout::has_gaze);
    if (!any_gaze) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  "the eye tracker's report descriptor has no input report with a gaze point "
                  "(usages 0x24 with 0x21 and 0x22)"});
    }
    return layout;
}

}  // namespace gazeloop::drivers::hid
