#include "sim/virtual_tracker.h"

#include <cmath>
#include <limits>

namespace gazeloop::sim {
namespace {

// Items of HID 1.11, 6.2.2; a usage of two bytes takes 0x0A, of one 0x09.
constexpr std::uint8_t kDescriptor[] = {
    0x05, 0x12, 0x09, 0x01, 0xA1, 0x01,  // page Eye and Head Trackers, application Eye Tracker
    0x85, 0x10, 0x09, 0x10, 0xA1, 0x00,  // report 0x10: Tracking Data
    0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x08, 0x09, 0x20, 0x81, 0x03,  // timestamp
    // micrometres, +-2 m
    0x17, 0x80, 0x7B, 0xE1, 0xFF, 0x27, 0x80, 0x84, 0x1E, 0x00, 0x65, 0x11, 0x55, 0x0C, 0x75, 0x20,
    0x09, 0x24, 0xA1, 0x00, 0x09, 0x21, 0x09, 0x22, 0x95, 0x02, 0x81, 0x03, 0xC0,  // Gaze Point
    0x09, 0x25, 0xA1, 0x00, 0x09, 0x21, 0x09, 0x22, 0x09, 0x23, 0x95, 0x03, 0x81, 0x03, 0xC0, 0x09,
    0x26, 0xA1, 0x00, 0x09, 0x21, 0x09, 0x22, 0x09, 0x23, 0x95, 0x03, 0x81, 0x03, 0xC0, 0x95, 0x06,
    0x81, 0x03, 0xC0,                    // padding where others have the head
    0x85, 0x11, 0x09, 0x11, 0xA1, 0x02,  // report 0x11: Capabilities
    0x15, 0x00, 0x26, 0xFF, 0x00, 0x65, 0x00, 0x55, 0x00, 0x75, 0x08, 0x95, 0x01, 0x0A, 0x00, 0x01,
    0xB1, 0x02,  // quality
    0x27, 0xFF, 0xFF, 0xFF, 0x7F, 0x65, 0x11, 0x55, 0x0C, 0x75, 0x20, 0x95, 0x05, 0x0A, 0x01, 0x01,
    0x0A, 0x02, 0x01, 0x0A, 0x03, 0x01, 0x0A, 0x04, 0x01, 0x0A, 0x05, 0x01, 0xB1, 0x02,
    0xC0,                                // distances, screen plane
    0x85, 0x12, 0x09, 0x12, 0xA1, 0x02,  // report 0x12: Configuration
    0x27, 0xFF, 0xFF, 0x00, 0x00, 0x65, 0x00, 0x55, 0x00, 0x75, 0x10, 0x95, 0x02, 0x0A, 0x00, 0x02,
    0x0A, 0x01, 0x02, 0xB1, 0x02,  // manufacturer, product
    0x27, 0xFF, 0xFF, 0xFF, 0x7F, 0x75, 0x20, 0x95, 0x01, 0x0A, 0x02, 0x02, 0xB1, 0x02,  // serial
    0x27, 0xFF, 0xFF, 0x00, 0x00, 0x75, 0x10, 0x0A, 0x03, 0x02, 0xB1, 0x02,              // date
    0x27, 0xFF, 0xFF, 0xFF, 0x7F, 0x65, 0x11, 0x55, 0x0C, 0x75, 0x20, 0x95, 0x02, 0x0A, 0x04, 0x02,
    0x0A, 0x05, 0x02, 0xB1, 0x02, 0xC0,                          // calibrated width, height
    0x85, 0x13, 0x09, 0x13, 0xA1, 0x02, 0x65, 0x00, 0x55, 0x00,  // report 0x13: Status
    0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x01, 0x0A, 0x01, 0x03, 0xB1, 0x02, 0x27, 0xFF, 0xFF, 0x00,
    0x00, 0x75, 0x10, 0x0A, 0x00, 0x03, 0xB1, 0x02, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x0A, 0x01, 0x03,
    0x81, 0x02, 0x27, 0xFF, 0xFF, 0x00, 0x00, 0x75, 0x10, 0x0A, 0x00, 0x03, 0x81, 0x02, 0xC0, 0x85,
    0x14, 0x09, 0x14, 0xA1, 0x02,  // report 0x14: Control
    0x26, 0xFF, 0x00, 0x75, 0x08, 0x0A, 0x00, 0x04, 0xB1, 0x02, 0xC0, 0xC0};

/// Little-endian numbers one after the other.
template <typename Out, typename T>
void put(Out& out, std::size_t& at, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        out[at++] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
    }
}

constexpr std::int32_t kNoData = std::numeric_limits<std::int32_t>::max();

std::int32_t micrometres(double metres) {
    constexpr double kRange_m = 2.0;
    return std::abs(metres) <= kRange_m ? static_cast<std::int32_t>(std::lround(metres * 1e6))
                                        : kNoData;
}

/// Right and down from the screen's top left corner, and towards the viewer.
glm::dvec3 on_screen(const glm::dvec3& in_head_m) {
    return {kVirtualScreenWidth_m / 2.0 + in_head_m.x, kVirtualScreenHeight_m / 2.0 - in_head_m.y,
            kVirtualDistance_m + in_head_m.z};
}

/// Where a ray meets the screen; none if it does not.
std::optional<glm::dvec3> met_by(const gaze::EyeRay& ray) {
    if (!ray.valid || !(ray.direction.z < 0.0)) {
        return std::nullopt;
    }
    const double along = (kVirtualDistance_m + ray.origin_m.z) / -ray.direction.z;
    return on_screen(ray.origin_m + along * ray.direction);
}

}  // namespace

std::span<const std::uint8_t> virtual_tracker_descriptor() { return kDescriptor; }

VirtualReport virtual_tracker_report(const gaze::GazeSample& sample, std::uint64_t time_us,
                                     std::uint8_t modes) {
    VirtualReport report{};
    std::size_t at = 0;
    put(report, at, std::uint8_t{0x10});
    put(report, at, time_us);
    glm::dvec3 point{0.0};
    double points = 0.0;
    for (const gaze::EyeRay& ray : sample.eyes) {
        if (const auto met = met_by(ray)) {
            point += *met;
            points += 1.0;
        }
    }
    const bool has_gaze = points > 0.0 && (modes & kVirtualGaze) != 0;
    const bool has_eyes = (modes & kVirtualEyes) != 0;
    const std::int32_t x = has_gaze ? micrometres(point.x / points) : kNoData;
    const std::int32_t y = has_gaze ? micrometres(point.y / points) : kNoData;
    put(report, at, x);
    put(report, at, y);
    for (const gaze::EyeRay& ray : sample.eyes) {
        const glm::dvec3 eye = on_screen(ray.origin_m);
        for (const double coordinate : {eye.x, eye.y, eye.z}) {
            put(report, at, has_eyes && ray.valid ? micrometres(coordinate) : kNoData);
        }
    }
    return report;
}

std::optional<std::vector<std::uint8_t>> virtual_tracker_feature(std::uint8_t id,
                                                                 std::uint16_t rate_hz) {
    std::vector<std::uint8_t> report;
    std::size_t at = 0;
    switch (id) {
        case 0x11:
            report.resize(22);
            put(report, at, id);
            put(report, at, std::uint8_t{0});
            for (const double metres : {0.45, kVirtualDistance_m, 0.9, 0.6, 0.34}) {
                put(report, at, micrometres(metres));
            }
            return report;
        case 0x12:
            report.resize(19);
            put(report, at, id);
            at = 11;  // of the display nothing is known but its size
            put(report, at, micrometres(kVirtualScreenWidth_m));
            put(report, at, micrometres(kVirtualScreenHeight_m));
            return report;
        case 0x13:
            report.resize(4);
            put(report, at, id);
            put(report, at, std::uint8_t{1});  // ready
            put(report, at, rate_hz);
            return report;
        default:
            return std::nullopt;
    }
}

}  // namespace gazeloop::sim
